#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "shlight/sh/vec.h"

// [1] Green 2003, Spherical Harmonic Lighting: The Gritty Details, section "Monte Carlo integration".

namespace shlight {

// √N x √N jittered directions, uniform on the sphere, with their basis values kept beside them so that many functions
// can be projected on the same samples [1].
struct SphereSamples {
  int bands = 0;
  int strata = 0;  // a side of the grid: strata² samples
  std::vector<Vec3d> directions;
  std::vector<double> basis;  // num_coefficients(bands) values a sample, sample by sample

  std::span<const double> basis_of(std::size_t sample) const {
    const std::size_t n = static_cast<std::size_t>(bands) * static_cast<std::size_t>(bands);
    return {basis.data() + n * sample, n};
  }
};

// One jittered point in each cell of a strata x strata grid on the square, taken to the sphere by cos θ = 1 − 2ξ_x,
// φ = 2πξ_y (θ from +Z). The same seed gives the same samples everywhere.
SphereSamples make_sphere_samples(int bands, int strata, std::uint64_t seed);

// The side of the smallest grid with at least `samples` cells.
int strata_for(std::int64_t samples);

}  // namespace shlight
