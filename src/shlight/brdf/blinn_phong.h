#pragma once

#include <memory>

#include "shlight/brdf/brdf.h"

namespace shlight {

// Blinn's form of Phong's highlight, a power of the half vector's cosine, normalised so that at normal incidence ρ_s of
// the light is reflected, exactly, and less at any other angle:
//
//     f_r = ρ_d/π + ρ_s (n+2)(n+4) / (8π (2^{−n/2} + n)) (n·h)^n.
//
// ρ_d, ρ_s in [0, 1], n >= 0. In circulation is (n+8)/8π, which is the same for large n and up to 7.5 % more, at n = 9.
// The factor is 1/∫ (n·h)^n n·s ds with v at the normal, where n·h = cos(θ/2).
//
// [1] Blinn 1977, Models of Light Reflection for Computer Synthesized Pictures, SIGGRAPH.
std::unique_ptr<Brdf> make_blinn_phong(Rgb rd, Rgb rs, double n);

}  // namespace shlight
