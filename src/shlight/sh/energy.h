#pragma once

#include <optional>
#include <span>
#include <vector>

#include "shlight/sh/coefficients.h"

// How much of a function lies in which degree. By Parseval's theorem, ∫ f² is the sum of the squares of all of its
// coefficients.
//
// [1] Basri & Jacobs 2003, Lambertian Reflectance and Linear Subspaces, IEEE TPAMI 25(2).

namespace shlight {

// Σ_m c_lm² of each degree, of all channels together.
std::vector<double> energy_per_band(const RgbCoefficients& coefficients);

// The same of a function of the angle to an axis, given as its kernel (zonal.h): (2l+1)/4π k̂_l².
std::vector<double> energy_per_band(std::span<const double> kernel);

// How many bands hold `share` of `total`; nothing where all of them together do not.
std::optional<int> bands_for_energy(std::span<const double> energy, double share, double total);

}  // namespace shlight
