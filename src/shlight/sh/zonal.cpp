#include "shlight/sh/zonal.h"

#include <cassert>
#include <cmath>
#include <numbers>
#include <vector>

#include "shlight/sh/basis.h"

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
  RgbCoefficients irradiance = radiance;
  for (int l = 0; l < radiance.bands(); ++l)
    for (int m = -l; m <= l; ++m) irradiance.at(l, m) = cosine_lobe_hat(l) * radiance.at(l, m);
  return irradiance;
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
  const int bands = coefficients.bands();
  std::vector<double> basis(coefficients.size());
  eval_basis(bands, axis, std::span<double>(basis));
  const double c = std::cos(half_angle);
  // P_{l−1}, P_l and P_{l+1} at cos α; the l = 0 integral is 1 − cos α, written so that small discs keep their digits.
  double before = 1, here = c;
  for (int l = 0; l < bands; ++l) {
    double integral = 2 * std::pow(std::sin(half_angle / 2), 2);
    if (l > 0) {
      const double after = ((2 * l + 1) * c * here - l * before) / (l + 1);
      integral = (before - after) / (2 * l + 1);
      before = here;
      here = after;
    }
    // Zonal coefficient 2π K_l^0 ∫ P_l, times √(4π/(2l+1)) Y_lm(axis) to turn it there; K_l^0 √(4π/(2l+1)) = 1.
    for (int m = -l; m <= l; ++m)
      coefficients.at(l, m) += 2 * pi * integral * basis[static_cast<std::size_t>(coefficient_index(l, m))] * radiance;
  }
}

}  // namespace shlight
