#pragma once

#include <vector>

#include "shlight/light/light.h"
#include "shlight/sh/coefficients.h"
#include "shlight/truth/band_error.h"

// What measures of bands share (band_error.h). Not installed.

namespace shlight {

// A light as its coefficients, and the same as points and coefficients of what is left without them.
struct LightPoint {
  Vec3d direction;
  Rgb irradiance;
};
struct ReferenceLight {
  RgbCoefficients all, rest;
  std::vector<LightPoint> points;
};
ReferenceLight make_reference_light(const Light& light, int bands, int threads);

// What is compared with the truth: the light with 1 … max_bands bands, and after them the same shaped.
std::vector<RgbCoefficients> make_approximations(const ReferenceLight& light, const BandErrorParams& params);

// The radiance of one normal and view: the truth, what the upper half of its bands has in it, and approximations.
struct BandSample {
  Vec3d normal, view;
  double weight = 0;
  Rgb truth, upper_half;
  std::vector<Rgb> approximations;
};

// Fills in all of `errors` that is about samples. Returns whether any of them has light.
bool summarise_samples(const std::vector<BandSample>& samples, int max_bands, BandErrors& errors);

// Fills in the energies of the light and of what reflects it, by degree, the first max_bands of them and their sums.
void summarise_energy(const ReferenceLight& light, std::vector<double> reflectance, int max_bands, BandErrors& errors);

inline Rgb times(Rgb a, Rgb b) {
  return {a.r * b.r, a.g * b.g, a.b * b.b};
}

}  // namespace shlight
