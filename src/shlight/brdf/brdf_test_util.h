#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "shlight/brdf/brdf.h"
#include "shlight/sh/basis.h"
#include "shlight/sh/coefficients.h"
#include "shlight/sh/project.h"

namespace shlight {

// A direction from degrees.
inline Vec3d direction_at(double theta_degrees, double phi_degrees) {
  const double theta = theta_degrees * std::numbers::pi / 180, phi = phi_degrees * std::numbers::pi / 180;
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

inline double largest_value(const RgbCoefficients& coefficients) {
  double result = 0;
  for (const Rgb c : coefficients.values()) result = std::max({result, std::abs(c.r), std::abs(c.g), std::abs(c.b)});
  return result;
}

inline double largest_error(const RgbCoefficients& a, const RgbCoefficients& b) {
  RgbCoefficients difference(a.bands());
  for (std::size_t i = 0; i < a.size(); ++i) difference[i] = a[i] - b[i];
  return largest_value(difference);
}

// F*(v) by brute force: rows x 2 rows nodes over polar angle and azimuth of the light, knowing nothing of lobes.
// Gauss's rule along the polar angle, cut at the view's, the trapezoid rule around.
inline RgbCoefficients project_by_brute_force(const Brdf& brdf, Vec3d v, int bands, int rows) {
  const GaussLegendre rule = make_gauss_legendre(rows / 2);
  const double theta_v = std::acos(v.z), cuts[] = {0, theta_v, std::numbers::pi / 2};
  RgbCoefficients sum(bands);
  std::vector<double> basis(sum.size());
  for (int part = 0; part < 2; ++part) {
    const double span = 0.5 * (cuts[part + 1] - cuts[part]);
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
      const double theta = cuts[part] + span * (1 + rule.nodes[i]);
      for (int j = 0; j < 2 * rows; ++j) {
        const double phi = (j + 0.5) * std::numbers::pi / rows;
        const Vec3d s = {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
        const double weight = span * rule.weights[i] * std::sin(theta) * std::numbers::pi / rows;
        const Rgb value = weight * s.z * brdf.eval(s, v);
        eval_basis(bands, s, std::span<double>(basis));
        for (std::size_t k = 0; k < basis.size(); ++k) sum[k] += basis[k] * value;
      }
    }
  }
  return sum;
}

}  // namespace shlight
