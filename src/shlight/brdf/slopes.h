#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "shlight/sh/vec.h"

// What models of the half vector share. Not installed.

namespace shlight {

// Cosines that stand below a fraction line are taken as at least this, an angle of 89.9994°, so that f_r stays finite.
inline constexpr double kMinCosine = 1e-5;

inline constexpr double clamped(double cosine) {
  return cosine > kMinCosine ? cosine : kMinCosine;
}

inline constexpr Rgb times(Rgb a, Rgb b) {
  return {a.r * b.r, a.g * b.g, a.b * b.b};
}

inline constexpr bool is_grey(Rgb c) {
  return c.r == c.g && c.g == c.b;
}

// What light of `v` becomes when it is mirrored by the facet of normal `h`.
inline Vec3d mirrored_at(Vec3d h, Vec3d v) {
  return 2 * dot(v, h) * h - v;
}

// Facets whose slopes are spread by a Gaussian exp(−(t_x²/w_x² + t_y²/w_y²)) / (π w_x w_y): Ward's and Beckmann's.
// Mirrors v at one of them.
inline Vec3d sample_gaussian_slopes(double wx, double wy, Vec3d v, double u1, double u2) {
  const double radius = std::sqrt(-std::log(1 - u1)), psi = 2 * std::numbers::pi * u2;
  const double tx = wx * radius * std::cos(psi), ty = wy * radius * std::sin(psi);
  const double cosine = 1 / std::sqrt(1 + tx * tx + ty * ty);
  return mirrored_at({cosine * tx, cosine * ty, cosine}, v);
}

// The density of that in 1/sr: slopes to facets is 1/cos³, facets to directions 1/(4 v·h).
inline double gaussian_slopes_pdf(double wx, double wy, Vec3d s, Vec3d v) {
  const Vec3d sum = s + v;
  const double length = std::sqrt(dot(sum, sum)), cosine = sum.z / length;
  const double tx = sum.x / (sum.z * wx), ty = sum.y / (sum.z * wy);
  return std::exp(-(tx * tx + ty * ty)) / (std::numbers::pi * wx * wy * cosine * cosine * cosine * 2 * length);
}

}  // namespace shlight
