#pragma once

#include <cstdint>
#include <span>

#include "shlight/sh/vec.h"

namespace shlight {

// Unshadowed transfer, max(0, n·s)/π, of unit normals: bands² coefficients of each, one normal after the other in
// `coefficients`. What depends on neighbours' shadows starts from it.
//
// [1] Green 2003, Spherical Harmonic Lighting: The Gritty Details.

// In closed form, a zonal lobe turned to the normal: A_lm = Â_l/π Y_lm(n). No samples.
void eval_cosine_transfer(int bands, std::span<const Vec3f> normals, std::span<float> coefficients, int threads = 0);

// The classic way: 4π/N Σ max(0, n·s_j)/π Y_i(s_j) over at least `samples` jittered directions, uniform on the sphere
// and the same for every normal [1]. The next square number is taken.
void sample_cosine_transfer(int bands, std::span<const Vec3f> normals, int samples, std::uint64_t seed,
                            std::span<float> coefficients, int threads = 0);

}  // namespace shlight
