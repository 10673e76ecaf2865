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

// F*(v) by brute force over polar angle and azimuth of the light, knowing nothing of lobes: Gauss's rule with `nodes`
// nodes on both sides of the view's polar angle, and on both sides of its mirrored azimuth π + φ_v, from there as the
// cube, for highlights at grazing angles are slimmer than a thousandth there.
inline RgbCoefficients project_by_brute_force(const Brdf& brdf, Vec3d v, int bands, int nodes) {
  using std::numbers::pi;
  const GaussLegendre rule = make_gauss_legendre(nodes);
  const double theta_v = std::acos(v.z), phi_v = std::atan2(v.y, v.x), cuts[] = {0, theta_v, pi / 2};
  RgbCoefficients sum(bands);
  std::vector<double> basis(sum.size());
  for (int part = 0; part < 2; ++part) {
    const double span = 0.5 * (cuts[part + 1] - cuts[part]);
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
      const double theta = cuts[part] + span * (1 + rule.nodes[i]);
      for (std::size_t j = 0; j < 2 * rule.nodes.size(); ++j) {
        const double side = j % 2 == 0 ? 1 : -1, t = 0.5 * (1 + rule.nodes[j / 2]);
        const double phi = phi_v + pi + side * pi * t * t * t, phi_weight = 0.5 * rule.weights[j / 2] * 3 * pi * t * t;
        const Vec3d s = {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
        const Rgb value = span * rule.weights[i] * std::sin(theta) * phi_weight * s.z * brdf.eval(s, v);
        eval_basis(bands, s, std::span<double>(basis));
        for (std::size_t k = 0; k < basis.size(); ++k) sum[k] += basis[k] * value;
      }
    }
  }
  return sum;
}

}  // namespace shlight
