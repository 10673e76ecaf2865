#include "shlight/sh/product.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "shlight/sh/basis.h"
#include "shlight/sh/project.h"

namespace shlight {
namespace {

using std::numbers::pi;

// ∫ over φ of three of the functions cos(mφ) for m >= 0 and sin(|m|φ) for m < 0.
double azimuthal_integral(int m1, int m2, int m3) {
  const int a = std::abs(m1), b = std::abs(m2), c = std::abs(m3);
  const int sines = (m1 < 0) + (m2 < 0) + (m3 < 0);
  if (sines % 2 == 1) return 0;
  // The product of three cosines is a quarter of the sum of cos((±a ± b + c)φ) over the four signs, and only those of
  // frequency zero have an integral. A pair of sines turns the sign where their frequencies are added.
  double sum = 0;
  for (const int sa : {1, -1})
    for (const int sb : {1, -1}) {
      if (sa * a + sb * b + c != 0) continue;
      double sign = 1;
      if (sines == 2) {
        // sin u sin v = −½ (cos(u + v) − cos(u − v)): the sign is − the product of the signs of the two.
        const int s1 = m1 < 0 ? sa : 1, s2 = m2 < 0 ? sb : 1;
        sign = -s1 * s2;
      }
      sum += sign;
    }
  return 2 * pi * sum / 4;
}

// p_lm at all quadrature nodes, [(l(l+1)/2 + m) · nodes + node].
struct LegendreAtNodes {
  std::size_t nodes;
  std::vector<double> values;

  LegendreAtNodes(int bands, const GaussLegendre& rule) : nodes(rule.nodes.size()) {
    const NormalizedLegendre legendre(bands);
    std::vector<double> p(legendre.size());
    values.resize(p.size() * nodes);
    for (std::size_t k = 0; k < nodes; ++k) {
      const double z = rule.nodes[k];
      legendre.eval(z, std::sqrt(1 - z * z), p);
      for (std::size_t i = 0; i < p.size(); ++i) values[i * nodes + k] = p[i];
    }
  }
  const double* at(int l, int m) const {
    return &values[static_cast<std::size_t>(l * (l + 1) / 2 + std::abs(m)) * nodes];
  }
};

}  // namespace

TripleProducts::TripleProducts(int first_bands, int second_bands, int product_bands)
    : first_bands_(first_bands), second_bands_(second_bands), product_bands_(product_bands) {
  assert(first_bands >= 0 && second_bands >= 0 && product_bands >= 0);
  const int bands = std::max({first_bands, second_bands, product_bands, 1});
  // Where the azimuthal integral is not zero, the powers of sin θ add up to an even number: what is left is a
  // polynomial in z of degree l1 + l2 + l3, which the rule integrates exactly.
  const GaussLegendre rule = make_gauss_legendre((first_bands + second_bands + product_bands) / 2 + 1);
  const LegendreAtNodes p(bands, rule);
  for (int l3 = 0; l3 < product_bands; ++l3)
    for (int m3 = -l3; m3 <= l3; ++m3)
      for (int l1 = 0; l1 < first_bands; ++l1)
        for (int m1 = -l1; m1 <= l1; ++m1)
          for (int l2 = std::abs(l1 - l3); l2 < second_bands && l2 <= l1 + l3; ++l2) {
            if ((l1 + l2 + l3) % 2 == 1) continue;
            for (int m2 = -l2; m2 <= l2; ++m2) {
              const double azimuthal = azimuthal_integral(m1, m2, m3);
              if (azimuthal == 0) continue;
              const double *p1 = p.at(l1, m1), *p2 = p.at(l2, m2), *p3 = p.at(l3, m3);
              double polar = 0;
              for (std::size_t k = 0; k < p.nodes; ++k) polar += rule.weights[k] * p1[k] * p2[k] * p3[k];
              const double value = azimuthal * polar;
              // Some vanish beyond these rules; what rounding leaves of them is no term.
              if (std::abs(value) < 1e-13) continue;
              terms_.push_back({static_cast<std::uint32_t>(coefficient_index(l1, m1)),
                                static_cast<std::uint32_t>(coefficient_index(l2, m2)),
                                static_cast<std::uint32_t>(coefficient_index(l3, m3)), value});
            }
          }
}

RgbCoefficients multiply(const TripleProducts& products, const RgbCoefficients& first, const RgbCoefficients& second) {
  assert(first.bands() == products.first_bands() && second.bands() == products.second_bands());
  RgbCoefficients result(products.product_bands());
  for (const auto& [i, j, k, value] : products.terms()) {
    const Rgb a = first[i], b = second[j];
    result[k] += value * Rgb{a.r * b.r, a.g * b.g, a.b * b.b};
  }
  return result;
}

}  // namespace shlight
