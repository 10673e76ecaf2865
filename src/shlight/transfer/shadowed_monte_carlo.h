#pragma once

#include <cstddef>
#include <span>

#include "shlight/sh/sphere_samples.h"
#include "shlight/transfer/sites.h"
#include "shlight/transfer/tracer.h"

namespace shlight {

// The classic way to shadowed transfer: 4π/N Σ V(s_j) max(0, n·s_j)/π Y_i(s_j), the same directions for all sites [1].
// Slow and easy to believe: what the quick way is held to. Writes bands² values for each of the sites begin … end − 1;
// returns the number of rays.
//
// [1] Green 2003, Spherical Harmonic Lighting: The Gritty Details.
std::size_t sample_shadowed_transfer(const Tracer& tracer, const Sites& sites, std::size_t begin, std::size_t end,
                                     const SphereSamples& samples, std::span<float> coefficients);

}  // namespace shlight
