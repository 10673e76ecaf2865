#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "shlight/sh/vec.h"

// What every reflection model is: f_r(s, v) in 1/sr of a direction s to the light and v to the eye, both of unit length
// in the local frame of the surface: the normal is +z, the tangent, along which anisotropic models are turned, +x.
//
// A model says besides how it lies over the hemisphere, as a sum of lobes, each in the coordinates in which it is
// smooth: that is what makes its projection (project_brdf.h) quick and free of noise, and it is sampled lobe by lobe.
//
// [1] Rusinkiewicz 1998, A New Change of Variables for Efficient BRDF Representation, EGWR.

namespace shlight {

// The coordinates in which a lobe is smooth.
enum class LobeShape {
  kLambert,     // constant: its coefficients have a closed form
  kHemisphere,  // polar angle and azimuth of s; kinks only where s is as steep as v, and at ±90° from its azimuth
  kHalfVector,  // slopes of the half vector (s+v)/|s+v| [1], by the lobe's widths
  kGrooves,     // the same, with the kinks that Cook and Torrance's G has
};

struct BrdfLobe {
  LobeShape shape = LobeShape::kLambert;
  // Of kHalfVector and kGrooves: slopes h_x/h_z and h_y/h_z at which the lobe has fallen to about half of its height or
  // less.
  double width_x = 1, width_y = 1;
  double weight = 1;  // how often sampling takes this lobe, relative to the others
};

// What turning and mirroring both directions leaves as it is.
enum class BrdfSymmetry {
  kIsotropic,  // turns about the normal, and mirroring
  kMirrored,   // x -> −x and y -> −y, each by itself: an anisotropic model along the axes of the frame
  kNone,
};

struct BrdfTraits {
  BrdfSymmetry symmetry = BrdfSymmetry::kNone;
  bool grey = false;  // red, green and blue are always the same
  std::vector<BrdfLobe> lobes;
};

class Brdf {
 public:
  explicit Brdf(BrdfTraits traits) : traits_(std::move(traits)) {}
  Brdf(const Brdf&) = delete;
  Brdf& operator=(const Brdf&) = delete;
  virtual ~Brdf() = default;

  const BrdfTraits& traits() const { return traits_; }
  const std::vector<BrdfLobe>& lobes() const { return traits_.lobes; }

  // f_r(s, v), the sum of the lobes; zero where s or v is not above the horizon.
  Rgb eval(Vec3d s, Vec3d v) const;

  // One lobe of it. Both directions are above the horizon.
  virtual Rgb eval_lobe(std::size_t lobe, Vec3d s, Vec3d v) const = 0;

  // A direction s for the eye at v from two numbers in [0, 1), with a density about that of the lobe times s·n; it may
  // lie below the horizon, where no light comes from. And that density, in 1/sr, of an s above the horizon. Without an
  // own one, a model is sampled by the cosine to the normal.
  virtual Vec3d sample_lobe(std::size_t lobe, Vec3d v, double u1, double u2) const;
  virtual double sample_lobe_pdf(std::size_t lobe, Vec3d s, Vec3d v) const;

 private:
  BrdfTraits traits_;
};

// Samples the whole of it: `u` chooses a lobe by weight, the rest is sample_lobe. All three in [0, 1).
Vec3d sample_brdf(const Brdf& brdf, Vec3d v, double u, double u1, double u2);
double sample_brdf_pdf(const Brdf& brdf, Vec3d s, Vec3d v);

// One's own model, as a plain function of s and v, called with both above the horizon and from several threads at once.
// `width` says how slim its highlight is (BrdfLobe::width_x); a guess that is off by ten costs time, not accuracy.
using BrdfFunction = std::function<Rgb(Vec3d s, Vec3d v)>;
std::unique_ptr<Brdf> make_function_brdf(BrdfFunction f, BrdfSymmetry symmetry, bool grey, double width = 0.3);

}  // namespace shlight
