#include "shlight/sh/product.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "shlight/sh/basis.h"
#include "shlight/sh/project.h"
#include "shlight/sh/sphere_samples.h"

namespace shlight {
namespace {

RgbCoefficients some_function(int bands, double seed) {
  RgbCoefficients c(bands);
  for (std::size_t i = 0; i < c.size(); ++i) {
    const double t = seed + double(i);
    c[i] = {std::sin(3.7 * t), std::cos(1.3 * t * t), std::sin(0.4 * t) - 0.5};
  }
  return c;
}

// With enough bands the product is that of the values, everywhere.
TEST(Product, MultipliesTheFunctions) {
  for (const auto& [a, b] : {std::pair{1, 4}, {2, 2}, {3, 3}, {5, 3}, {6, 7}}) {
    const RgbCoefficients f = some_function(a, 0.3), g = some_function(b, 7.1);
    const RgbCoefficients product = multiply(TripleProducts(a, b, a + b - 1), f, g);
    for (const Vec3d d : make_sphere_samples(0, 9, 4).directions) {
      const Rgb u = reconstruct(f, d), v = reconstruct(g, d), w = reconstruct(product, d);
      EXPECT_NEAR(w.r, u.r * v.r, 1e-11) << a << " and " << b << " bands";
      EXPECT_NEAR(w.g, u.g * v.g, 1e-11);
      EXPECT_NEAR(w.b, u.b * v.b, 1e-11);
    }
  }
}

TEST(Product, FewerBandsAreTheFirstOfTheExactOnes) {
  const RgbCoefficients f = some_function(5, 1), g = some_function(5, 2);
  const RgbCoefficients exact = multiply(TripleProducts(5, 5, 9), f, g);
  EXPECT_EQ(multiply(TripleProducts(5, 5, 5), f, g).bands(), 5);
  const RgbCoefficients cut = multiply(TripleProducts(5, 5, 5), f, g);
  for (std::size_t i = 0; i < cut.size(); ++i) EXPECT_NEAR(cut[i].g, exact[i].g, 1e-13);
}

// Every Γ, the zero ones too, against brute-force quadrature that is exact for it.
TEST(Product, TermsAreTheTripleIntegrals) {
  constexpr int kBands = 4;
  constexpr std::size_t kSize = kBands * kBands;
  std::vector<double> brute(kSize * kSize * kSize), basis(kSize);
  const GaussLegendre rule = make_gauss_legendre(8);
  for (std::size_t n = 0; n < rule.nodes.size(); ++n)
    for (int a = 0; a < 16; ++a) {
      const double z = rule.nodes[n], s = std::sqrt(1 - z * z), phi = 2 * std::numbers::pi * a / 16;
      eval_basis(kBands, Vec3d{s * std::cos(phi), s * std::sin(phi), z}, std::span<double>(basis));
      const double weight = rule.weights[n] * 2 * std::numbers::pi / 16;
      for (std::size_t i = 0; i < kSize; ++i)
        for (std::size_t j = 0; j < kSize; ++j)
          for (std::size_t k = 0; k < kSize; ++k)
            brute[(i * kSize + j) * kSize + k] += weight * basis[i] * basis[j] * basis[k];
    }
  const TripleProducts products(kBands, kBands, kBands);
  for (const auto& term : products.terms()) {
    double& expected = brute[(term.i * kSize + term.j) * kSize + term.k];
    EXPECT_NEAR(term.value, expected, 1e-13);
    expected = 0;
  }
  for (const double left : brute) EXPECT_NEAR(left, 0, 1e-13);
}

TEST(Product, TheTableIsSparse) {
  EXPECT_EQ(TripleProducts(3, 3, 3).terms().size(), 83u);
}

}  // namespace
}  // namespace shlight
