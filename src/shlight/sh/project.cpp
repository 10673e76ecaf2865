#include "shlight/sh/project.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "shlight/sh/basis.h"
#include "shlight/sh/rotation.h"
#include "shlight/sh/separable.h"

namespace shlight {

using std::numbers::pi;

MonteCarloProjection project_monte_carlo(const SphereFunction& f, const SphereSamples& samples) {
  const std::size_t count = samples.directions.size();
  assert(samples.strata >= 3);
  MonteCarloProjection result{RgbCoefficients(samples.bands), RgbCoefficients(samples.bands)};

  // Of three neighbouring strata along the azimuth with values a, b and c, of one variance and with means on a line,
  // a − 2b + c has six times that variance.
  std::vector<Rgb> row(static_cast<std::size_t>(samples.strata));
  RgbCoefficients variance(samples.bands);
  const auto squared = [](Rgb c) { return Rgb{c.r * c.r, c.g * c.g, c.b * c.b}; };
  for (std::size_t first = 0; first < count; first += row.size()) {
    for (std::size_t j = 0; j < row.size(); ++j) row[j] = f(samples.directions[first + j]);
    for (std::size_t i = 0; i < result.coefficients.size(); ++i) {
      const auto value = [&](std::size_t j) { return samples.basis_of(first + j)[i] * row[j]; };
      Rgb before = value(row.size() - 1);
      for (std::size_t j = 0; j < row.size(); ++j) {
        const Rgb here = value(j), after = value((j + 1) % row.size());
        result.coefficients[i] += here;
        variance[i] += 1.0 / 6 * squared(before - 2 * here + after);
        before = here;
      }
    }
  }
  const double weight = 4 * pi / static_cast<double>(count);
  for (std::size_t i = 0; i < variance.size(); ++i) {
    result.coefficients[i] = weight * result.coefficients[i];
    const Rgb v = variance[i];
    result.standard_error[i] = weight * Rgb{std::sqrt(v.r), std::sqrt(v.g), std::sqrt(v.b)};
  }
  return result;
}

GaussLegendre make_gauss_legendre(int count) {
  assert(count > 0);
  GaussLegendre rule{std::vector<double>(static_cast<std::size_t>(count)),
                     std::vector<double>(static_cast<std::size_t>(count))};
  for (int i = 0; i < (count + 1) / 2; ++i) {
    // Newton's iteration on P_count from Tricomi's estimate of its i-th root.
    double x = std::cos(pi * (i + 0.75) / (count + 0.5)), derivative = 1;
    for (int iteration = 0; iteration < 100; ++iteration) {
      double before = 0, here = 1;
      for (int l = 0; l < count; ++l) {
        const double after = ((2 * l + 1) * x * here - l * before) / (l + 1);
        before = here;
        here = after;
      }
      derivative = count * (x * here - before) / (x * x - 1);
      const double step = here / derivative;
      x -= step;
      if (std::abs(step) < 1e-15) break;
    }
    const double weight = 2 / ((1 - x * x) * derivative * derivative);
    const auto low = static_cast<std::size_t>(i), high = static_cast<std::size_t>(count - 1 - i);
    rule.nodes[low] = -x, rule.nodes[high] = x;
    rule.weights[low] = rule.weights[high] = weight;
  }
  return rule;
}

namespace {

// One refinement: about the vertical as polar axis, in the frame of separable.h.
RgbCoefficients quadrature_once(const SphereFunction& f, int bands, int rows) {
  const int columns = 2 * rows;
  const GaussLegendre rule = make_gauss_legendre(rows / 2);
  SeparableSum sum(bands);
  std::vector<Rgb> moments(static_cast<std::size_t>(2 * bands));
  std::vector<double> cosines(static_cast<std::size_t>(columns)), sines(cosines.size());
  for (int x = 0; x < columns; ++x) {
    const double phi = 2 * pi * (x + 0.5) / columns - pi;
    cosines[static_cast<std::size_t>(x)] = std::cos(phi), sines[static_cast<std::size_t>(x)] = std::sin(phi);
  }
  const NormalizedLegendre normalized_legendre(bands);
  std::vector<double> legendre(normalized_legendre.size());
  for (const double hemisphere : {1.0, -1.0})
    for (std::size_t k = 0; k < rule.nodes.size(); ++k) {
      const double up = hemisphere * 0.5 * (1 + rule.nodes[k]);
      const double s = std::sqrt(1 - up * up);
      std::fill(moments.begin(), moments.end(), Rgb{});
      for (std::size_t x = 0; x < cosines.size(); ++x) {
        const Rgb value = f({s * sines[x], up, -s * cosines[x]});
        double c = 1, sn = 0;  // of mφ
        for (std::size_t m = 0; m < static_cast<std::size_t>(bands); ++m) {
          moments[2 * m] += c * value;
          moments[2 * m + 1] += sn * value;
          const double next = c * cosines[x] - sn * sines[x];
          sn = sn * cosines[x] + c * sines[x];
          c = next;
        }
      }
      normalized_legendre.eval(up, s, legendre);
      for (double& p : legendre) p *= 0.5 * rule.weights[k] * 2 * pi / columns;
      sum.add_row(legendre, moments);
    }
  return sum.to_world();
}

double largest_channel(Rgb c) {
  return std::max({std::abs(c.r), std::abs(c.g), std::abs(c.b)});
}

}  // namespace

QuadratureProjection project_quadrature(const SphereFunction& f, int bands, const QuadratureParams& params) {
  int rows = std::max(params.first_rows, 2 * bands);
  rows += rows % 2;
  QuadratureProjection result{quadrature_once(f, bands, rows), 0};
  do {
    rows *= 2;
    const RgbCoefficients finer = quadrature_once(f, bands, rows);
    double largest = 0;
    result.change = 0;
    for (std::size_t i = 0; i < finer.size(); ++i) {
      largest = std::max(largest, largest_channel(finer[i]));
      result.change = std::max(result.change, largest_channel(finer[i] - result.coefficients[i]));
    }
    result.coefficients = finer;
    if (result.change <= params.tolerance * largest) break;
  } while (2 * rows <= params.last_rows);
  return result;
}

}  // namespace shlight
