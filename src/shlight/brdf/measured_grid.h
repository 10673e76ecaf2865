#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "shlight/brdf/brdf.h"

// An isotropic measured model on a grid over the angles of half and difference vector [1]. Not installed.
//
// [1] Rusinkiewicz 1998, A New Change of Variables for Efficient BRDF Representation, EGWR.

namespace shlight {

// θ_h: half vector to normal. θ_d, φ_d: s, seen from the half vector.
struct HalfDifference {
  double theta_h = 0, theta_d = 0, phi_d = 0;  // φ_d in [0, π): swapping s and v adds π, and changes nothing
};
HalfDifference half_difference(Vec3d s, Vec3d v);

// The s and v of some angles, with the half vector in the half plane +x.
struct DirectionPair {
  Vec3d s, v;
};
DirectionPair directions_of(const HalfDifference& angles);

// Cells over θ_h ∝ k² (fine at the highlight), θ_d and φ_d; those of φ_d follow each other, then those of θ_d.
struct MeasuredGrid {
  std::size_t theta_h = 0, theta_d = 0, phi_d = 0;
  std::vector<Rgb> values;  // at the cells' centres; missing ones are negative

  std::size_t size() const { return theta_h * theta_d * phi_d; }
  std::size_t index(std::size_t h, std::size_t d, std::size_t phi) const { return (h * theta_d + d) * phi_d + phi; }
  HalfDifference centre(std::size_t h, std::size_t d, std::size_t phi) const;
};

// Makes the grid the same on both sides of the plane of half vector and normal, as isotropic surfaces are: each value
// is the mean with its mirror image, or the one of the two that is not missing. Between the centres, f_r is
// interpolated linearly, missing cells left out. Sampled half by the cosine, half by the width of the highlight.
std::unique_ptr<Brdf> make_measured_brdf(MeasuredGrid grid);

}  // namespace shlight
