#pragma once

#include <array>

#include "shlight/sh/coefficients.h"
#include "shlight/sh/vec.h"

// Functions of the angle to one axis, and convolution with them.
//
// [1] Ramamoorthi & Hanrahan 2001, On the relationship between radiance and irradiance, JOSA A 18(10).
// [2] Ramamoorthi & Hanrahan 2001, An Efficient Representation for Irradiance Environment Maps, SIGGRAPH.

namespace shlight {

// The coefficient of degree l of the clamped cosine max(0, z), A_l = ∫ max(0, z) Y_l0 [1, eq. 19]:
//
//     A_0 = √π/2,   A_1 = √(π/3),   A_l = 0 for odd l > 1,
//     A_l = 2π √((2l+1)/4π) (−1)^{l/2−1} / ((l+2)(l−1)) · l! / (2^l ((l/2)!)²) for even l.
double cosine_lobe(int l);

// Â_l = √(4π/(2l+1)) A_l, by which degree l of radiance is multiplied to give irradiance [1, eq. 22]: π, 2π/3, π/4, 0,
// −π/24, 0, …
double cosine_lobe_hat(int l);

// The coefficients of irradiance E(n) = ∫ L(s) max(0, n·s) ds as a function of the normal, from those of radiance.
RgbCoefficients irradiance_from_radiance(const RgbCoefficients& radiance);

// Irradiance at a unit normal from the first nine coefficients of radiance by the polynomial of [2, eq. 13], in its own
// terms: the slow twin of the shader. `radiance` has at least 3 bands.
Rgb eval_irradiance_polynomial(const RgbCoefficients& radiance, Vec3d normal);

// The constants c1 … c5 of [2, eq. 12], with the digits that its print leaves out. c1 = Â_2 √15/16π and so on.
std::array<double, 5> irradiance_polynomial_constants();

// Adds the coefficients of a disc of uniform `radiance`: all directions within `half_angle` radians of the unit `axis`.
// In closed form: ∫_{cos α}^1 P_l = (P_{l−1}(cos α) − P_{l+1}(cos α)) / (2l+1).
void add_disc(Vec3d axis, double half_angle, Rgb radiance, RgbCoefficients& coefficients);

}  // namespace shlight
