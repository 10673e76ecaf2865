#pragma once

#include <array>
#include <span>
#include <vector>

#include "shlight/sh/coefficients.h"
#include "shlight/sh/vec.h"

// Functions of the angle to one axis, and convolution with them. Such a function k(cos θ) is given by a factor a
// degree, its kernel
//
//     k̂_l = 2π ∫ k(z) P_l(z) dz = √(4π/(2l+1)) k_l,     k_l its coefficient of Y_l0 about +Z,
//
// for then everything is a product: degree l of a convolution is k̂_l L_lm (Funk and Hecke), and the lobe turned to an
// axis d has the coefficients k̂_l Y_lm(d). kernel.h makes kernels.
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

// ∫ L(s) k(n·s) ds as a function of n. The kernel has at least as many degrees as the coefficients.
RgbCoefficients convolve(std::span<const double> kernel, const RgbCoefficients& coefficients);

// Adds the lobe `value` · k(cos of the angle to the unit `axis`). The kernel has a factor for every band.
void add_zonal(std::span<const double> kernel, Vec3d axis, Rgb value, RgbCoefficients& coefficients);

// The zonal function about the unit `axis` that is nearest to the given one in the least-squares sense, as a kernel a
// channel: its part of m = 0 seen from there, (4π/(2l+1)) Σ_m c_lm Y_lm(axis).
std::vector<Rgb> zonal_part(Vec3d axis, const RgbCoefficients& coefficients);

// The axis about which the zonal part keeps most of ∫ (luminance)², found from a grid of directions by ascent; of the
// two ends of it the one where degree 1 shines from. +Z where there is nothing but a mean.
Vec3d best_zonal_axis(const RgbCoefficients& coefficients);

// Adds the coefficients of a disc of uniform `radiance`: all directions within `half_angle` radians of the unit `axis`.
void add_disc(Vec3d axis, double half_angle, Rgb radiance, RgbCoefficients& coefficients);

}  // namespace shlight
