#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "shlight/brdf/brdf.h"
#include "shlight/light/light.h"
#include "shlight/sh/coefficients.h"

// How far a light's first n bands are from the whole of it, as a surface reflects it.
//
// What is true is known to many more bands, with what such series converge slowest on taken out beforehand: the pixels
// that shine most, and suns. Those are points, reflected by the model itself. The clamped cosine has a kink at the
// horizon, so that a point's irradiance by n bands is off by about 0.3/n of its peak there, while what many pixels add
// up to is smooth. The disc of a built-in sun is taken for a point on both sides.
//
// [1] Ramamoorthi & Hanrahan 2001, An Efficient Representation for Irradiance Environment Maps, SIGGRAPH.
// [2] Basri & Jacobs 2003, Lambertian Reflectance and Linear Subspaces, IEEE TPAMI 25(2).

namespace shlight {

// What is done to the coefficients of n bands before they light: a window.
using BandShape = std::function<RgbCoefficients(const RgbCoefficients&)>;

// A surface that is looked at: its unit normal, and how large a part of all it is.
struct WeightedNormal {
  Vec3d normal;
  double weight = 1;  // > 0
};

struct BandErrorParams {
  int max_bands = 10;                        // errors of 1 … max_bands, 1 to kMaxErrorBands
  std::vector<WeightedNormal> normals = {};  // empty: evenly over the sphere
  BandShape shape = {};                      // errors with it, too, where there is one
  int threads = 0;                           // 0: all there are; the result has the same bits with any number
};
inline constexpr int kMaxErrorBands = 20;

// A direction's error is taken against the local radiance where that is more than this part of the largest, against
// this part where it is less: where there is nothing, any error would be infinite.
inline constexpr double kDarkest = 1e-3;

// The errors of one number of bands, over all normals, views and channels. Each is a fraction: of the largest radiance
// that the channel has anywhere, or, where it says local, of what there is in that direction.
struct BandError {
  int bands = 0;
  double mean = 0, rms = 0;  // mean of the absolute value, root of the mean square
  double p99 = 0;            // 99 % of the directions are off by this or less
  double max = 0;
  double mean_local = 0, rms_local = 0, p99_local = 0, max_local = 0;
  Vec3d worst_normal, worst_view;              // of max; the view is the normal itself for Lambertian surfaces
  Vec3d worst_local_normal, worst_local_view;  // of max_local
};

struct BandErrors {
  std::vector<BandError> bands;   // of the coefficients as they are
  std::vector<BandError> shaped;  // with params.shape; empty without one
  Rgb largest;                    // true radiance where it is largest, a channel each; irradiance ρ/π for Lambert
  // How well the truth is known, as a fraction of the largest: what the upper half of the reference's bands adds,
  // where that is most. What is missing above them is less wherever series converge as 1/n or quicker.
  double reference_error = 0;
  // ∫ of the square, degree by degree, of the light (all channels) and of f_r max(0, n·s) (mean over views), of which
  // the first max_bands degrees are listed; and their sums over all degrees of the reference. Points of the light have
  // no finite one.
  std::vector<double> light_energy, reflectance_energy;
  double light_total = 0, reflectance_total = 0;
};

// Of a light and a reflection model. Lambertian models are looked at along their normals, at 4096 of them. Others are
// seen from 48 sides of each of 192 normals: as those of a sphere are by eyes all around it, sin²θ evenly from 0 to 1,
// their tangents along the circles of latitude about +Y. Nothing for a light that gives no radiance in any direction.
// Of a map of 1024 x 512 pixels, one core takes about 0.6 s for Lambertian models and 1 to 2 s for others.
std::optional<BandErrors> measure_band_errors(const Light& light, const Brdf& brdf, const BandErrorParams& params = {});

// What a tolerance can be about: a member of BandError, its name, as `p99_local`, and what it means in words.
struct BandMeasure {
  std::string name, meaning;
  double BandError::*value = nullptr;
};
const std::vector<BandMeasure>& band_measures();
const BandMeasure& band_measure(const std::string& name);  // one of those names

// The smallest number of bands from which on `measure` stays within `tolerance`; nothing where the last one is not.
std::optional<int> find_enough_bands(const std::vector<BandError>& errors, double BandError::*measure,
                                     double tolerance);

}  // namespace shlight
