#include "shlight/sh/zonal.h"

#include <cassert>
#include <cmath>
#include <numbers>
#include <vector>

#include "shlight/sh/basis.h"
#include "shlight/sh/kernel.h"

namespace shlight {

using std::numbers::pi;

double cosine_lobe_hat(int l) {
  assert(l >= 0);
  if (l == 0) return pi;
  if (l == 1) return 2 * pi / 3;
  if (l % 2 == 1) return 0;
  // central = (l choose l/2) / 2^l = l! / (2^l ((l/2)!)²), which neither overflows nor cancels.
  double central = 1;
  for (int k = 1; k <= l / 2; ++k) central *= (2.0 * k - 1) / (2.0 * k);
  const double sign = (l / 2) % 2 == 1 ? 1 : -1;
  return 2 * pi * sign / ((l + 2.0) * (l - 1.0)) * central;
}

double cosine_lobe(int l) {
  return cosine_lobe_hat(l) / std::sqrt(4 * pi / (2 * l + 1));
}

RgbCoefficients irradiance_from_radiance(const RgbCoefficients& radiance) {
  return convolve(make_cosine_power_kernel(radiance.bands(), 1), radiance);
}

RgbCoefficients convolve(std::span<const double> kernel, const RgbCoefficients& coefficients) {
  assert(static_cast<int>(kernel.size()) >= coefficients.bands());
  RgbCoefficients result = coefficients;
  for (int l = 0; l < coefficients.bands(); ++l)
    for (int m = -l; m <= l; ++m) result.at(l, m) = kernel[static_cast<std::size_t>(l)] * coefficients.at(l, m);
  return result;
}

void add_zonal(std::span<const double> kernel, Vec3d axis, Rgb value, RgbCoefficients& coefficients) {
  const int bands = coefficients.bands();
  assert(static_cast<int>(kernel.size()) >= bands);
  std::vector<double> basis(coefficients.size());
  eval_basis(bands, axis, std::span<double>(basis));
  for (int l = 0; l < bands; ++l)
    for (int m = -l; m <= l; ++m)
      coefficients.at(l, m) +=
          kernel[static_cast<std::size_t>(l)] * basis[static_cast<std::size_t>(coefficient_index(l, m))] * value;
}

std::vector<Rgb> zonal_part(Vec3d axis, const RgbCoefficients& coefficients) {
  const int bands = coefficients.bands();
  std::vector<double> basis(coefficients.size());
  eval_basis(bands, axis, std::span<double>(basis));
  std::vector<Rgb> kernel(static_cast<std::size_t>(bands));
  for (int l = 0; l < bands; ++l)
    for (int m = -l; m <= l; ++m)
      kernel[static_cast<std::size_t>(l)] +=
          4 * pi / (2 * l + 1) * basis[static_cast<std::size_t>(coefficient_index(l, m))] * coefficients.at(l, m);
  return kernel;
}

namespace {

// ∫ (luminance)² of the zonal part about an axis, without the mean, which every axis keeps: Σ_l (2l+1)/4π k̂_l².
double zonal_power(Vec3d axis, const RgbCoefficients& coefficients) {
  const std::vector<Rgb> kernel = zonal_part(axis, coefficients);
  double power = 0;
  for (std::size_t l = 1; l < kernel.size(); ++l)
    power += static_cast<double>(2 * l + 1) / (4 * pi) * std::pow(luminance(kernel[l]), 2);
  return power;
}

}  // namespace

Vec3d best_zonal_axis(const RgbCoefficients& coefficients) {
  const auto normalized = [](Vec3d v) { return 1 / std::sqrt(dot(v, v)) * v; };
  // The power is a harmonic function of twice the degree, the same at both ends of an axis: a hemisphere sampled some
  // times finer than its highest degree turns cannot miss the top's surroundings.
  const int rows = 4 * coefficients.bands();
  Vec3d best = {0, 0, 1};
  double best_power = zonal_power(best, coefficients);
  const auto attempt = [&](Vec3d axis) {
    const double power = zonal_power(axis, coefficients);
    if (!(power > best_power)) return false;
    best = axis, best_power = power;
    return true;
  };
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < 4 * rows; ++j) {
      const double z = (i + 0.5) / rows, s = std::sqrt(1 - z * z), phi = 2 * pi * j / (4 * rows);
      attempt({s * std::cos(phi), s * std::sin(phi), z});
    }
  // Then steps to the sides, halved where none leads up. At the top the power is flat, so that half of its digits,
  // about 1e-8 radians, are all that it can tell.
  for (double step = 1.0 / (rows + 1); step > 1e-9;) {
    const Vec3d x = normalized(cross(best, std::abs(best.x) < 0.6 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0}));
    const Vec3d y = cross(best, x), here = best;
    bool better = false;
    for (const Vec3d side : {x, y, -x, -y}) better = better || attempt(normalized(here + step * side));
    if (!better) step /= 2;
  }
  if (coefficients.bands() < 2) return best;
  const Vec3d linear = {luminance(coefficients.at(1, 1)), luminance(coefficients.at(1, -1)),
                        luminance(coefficients.at(1, 0))};
  return dot(linear, best) < 0 ? -best : best;
}

std::array<double, 5> irradiance_polynomial_constants() {
  const double a0 = cosine_lobe_hat(0), a1 = cosine_lobe_hat(1), a2 = cosine_lobe_hat(2);
  const double y0 = std::sqrt(1 / (4 * pi)), y1 = std::sqrt(3 / (4 * pi));
  const double y20 = std::sqrt(5 / (16 * pi)), y22 = std::sqrt(15 / (16 * pi));
  return {a2 * y22, a1 * y1 / 2, 3 * a2 * y20, a0 * y0, a2 * y20};
}

Rgb eval_irradiance_polynomial(const RgbCoefficients& radiance, Vec3d n) {
  assert(radiance.bands() >= 3);
  const auto [c1, c2, c3, c4, c5] = irradiance_polynomial_constants();
  const auto& L = radiance;
  return c1 * (n.x * n.x - n.y * n.y) * L.at(2, 2) + c3 * n.z * n.z * L.at(2, 0) + c4 * L.at(0, 0) - c5 * L.at(2, 0) +
         2 * c1 * (n.x * n.y * L.at(2, -2) + n.x * n.z * L.at(2, 1) + n.y * n.z * L.at(2, -1)) +
         2 * c2 * (n.x * L.at(1, 1) + n.y * L.at(1, -1) + n.z * L.at(1, 0));
}

void add_disc(Vec3d axis, double half_angle, Rgb radiance, RgbCoefficients& coefficients) {
  add_zonal(make_cap_kernel(coefficients.bands(), half_angle), axis, radiance, coefficients);
}

}  // namespace shlight
