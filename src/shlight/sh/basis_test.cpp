#include "shlight/sh/basis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "shlight/sh/project.h"
#include "shlight/sh/sphere_samples.h"

namespace shlight {
namespace {

using std::numbers::pi;

// Unit directions all over the sphere, the poles and axes of every frame included.
std::vector<Vec3d> test_directions() {
  std::vector<Vec3d> directions = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0},      {0, -1, 0},
                                   {0, 0, 1}, {0, 0, -1}, {.36, .48, .80}};
  for (const Vec3d d : make_sphere_samples(0, 12, 1).directions) directions.push_back(d);
  return directions;
}

template <class T>
std::vector<T> basis(int bands, Vec3<T> d) {
  std::vector<T> values(static_cast<std::size_t>(num_coefficients(bands)));
  eval_basis(bands, d, std::span<T>(values));
  return values;
}

TEST(Basis, FirstNineAreTheConventionsPolynomials) {
  for (const auto [x, y, z] : test_directions()) {
    const double expected[9] = {std::sqrt(1 / (4 * pi)),
                                std::sqrt(3 / (4 * pi)) * y,
                                std::sqrt(3 / (4 * pi)) * z,
                                std::sqrt(3 / (4 * pi)) * x,
                                std::sqrt(15 / (4 * pi)) * x * y,
                                std::sqrt(15 / (4 * pi)) * y * z,
                                std::sqrt(5 / (16 * pi)) * (3 * z * z - 1),
                                std::sqrt(15 / (4 * pi)) * x * z,
                                std::sqrt(15 / (16 * pi)) * (x * x - y * y)};
    const auto values = basis(3, Vec3d{x, y, z});
    for (std::size_t i = 0; i < 9; ++i) EXPECT_NEAR(values[i], expected[i], 1e-15) << "coefficient " << i;
  }
}

TEST(Basis, GoldenValue) {
  const double golden[9] = {.282095, .234529, .390882, .175897, .188792, .419539, .290160, .314654, -.055064};
  const auto values = basis(3, Vec3d{.36, .48, .80});
  for (std::size_t i = 0; i < 9; ++i) EXPECT_NEAR(values[i], golden[i], 5e-7) << "coefficient " << i;
}

TEST(Basis, AgreesWithTheStandardLibrarysLegendreFunctions) {
  // std::sph_legendre has the phase (−1)^m and K; only √2 and the azimuth are left to us.
  for (const Vec3d d : test_directions()) {
    const auto values = basis(12, d);
    const double theta = std::acos(d.z), phi = std::atan2(d.y, d.x);
    for (int l = 0; l < 12; ++l)
      for (int m = -l; m <= l; ++m) {
        const int am = std::abs(m);
        double expected = std::sph_legendre(static_cast<unsigned>(l), static_cast<unsigned>(am), theta);
        expected *= (am % 2 ? -1 : 1) * (m ? std::sqrt(2.0) : 1) * (m < 0 ? std::sin(am * phi) : std::cos(m * phi));
        EXPECT_NEAR(values[static_cast<std::size_t>(coefficient_index(l, m))], expected, 2e-13)
            << "l " << l << " m " << m << " at " << d.x << " " << d.y << " " << d.z;
      }
  }
}

TEST(Basis, UnrolledEqualsRecursiveInBothPrecisions) {
  for (const Vec3d d : test_directions())
    for (int bands = 0; bands <= 8; ++bands) {
      const auto fast = basis(bands, d);
      const auto fast_float = basis(bands, vec_cast<float>(d));
      std::vector<double> slow(fast.size());
      eval_basis_recursive(bands, d, std::span<double>(slow));
      for (std::size_t i = 0; i < slow.size(); ++i) {
        EXPECT_NEAR(fast[i], slow[i], 1e-14) << bands << " bands, coefficient " << i;
        EXPECT_NEAR(fast_float[i], slow[i], 2e-6) << bands << " bands, coefficient " << i;
      }
    }
}

// The addition theorem: Σ_m Y_lm(d)² = (2l+1)/4π for each degree, anywhere.
TEST(Basis, AdditionTheoremHoldsTo128Bands) {
  for (const Vec3d d : test_directions()) {
    const auto values = basis(128, d);
    for (int l = 0; l < 128; ++l) {
      double sum = 0;
      for (int m = -l; m <= l; ++m) sum += std::pow(values[static_cast<std::size_t>(coefficient_index(l, m))], 2);
      EXPECT_NEAR(sum / ((2 * l + 1) / (4 * pi)), 1, 2e-12) << "degree " << l;
    }
  }
}

// Orthonormality by quadrature that is exact for the products: Gauss-Legendre in z, equal steps in azimuth.
TEST(Basis, OrthonormalTo64Bands) {
  constexpr int kBands = 64;
  const GaussLegendre rule = make_gauss_legendre(kBands);
  const int azimuths = 2 * kBands;
  // All pairs of 4096 functions are too many to look at: of each degree, three functions of different kind.
  std::vector<std::size_t> chosen;
  for (int l = 0; l < kBands; l += 7)
    for (const int m : {-l, 0, l / 2}) chosen.push_back(static_cast<std::size_t>(coefficient_index(l, m)));
  chosen.push_back(static_cast<std::size_t>(coefficient_index(kBands - 1, 1 - kBands)));
  std::vector<double> products(chosen.size() * chosen.size());
  for (std::size_t k = 0; k < rule.nodes.size(); ++k)
    for (int j = 0; j < azimuths; ++j) {
      const double z = rule.nodes[k], s = std::sqrt(1 - z * z), phi = 2 * pi * j / azimuths;
      const auto values = basis(kBands, Vec3d{s * std::cos(phi), s * std::sin(phi), z});
      for (std::size_t a = 0; a < chosen.size(); ++a)
        for (std::size_t b = 0; b < chosen.size(); ++b)
          products[a * chosen.size() + b] +=
              rule.weights[k] * 2 * pi / azimuths * values[chosen[a]] * values[chosen[b]];
    }
  for (std::size_t a = 0; a < chosen.size(); ++a)
    for (std::size_t b = 0; b < chosen.size(); ++b)
      EXPECT_NEAR(products[a * chosen.size() + b], chosen[a] == chosen[b] ? 1 : 0, 1e-12)
          << "coefficients " << chosen[a] << " and " << chosen[b];
}

TEST(Basis, FloatIsRightTo1e5UpTo16Bands) {
  constexpr int kBands = 16;
  const auto directions = test_directions();
  std::vector<float> x, y, z;
  for (const Vec3d d : directions) {
    const Vec3f f = vec_cast<float>(d);
    x.push_back(f.x), y.push_back(f.y), z.push_back(f.z);
  }
  std::vector<float> many(directions.size() * num_coefficients(kBands));
  eval_basis(kBands, x, y, z, many);
  double worst = 0;
  for (std::size_t j = 0; j < directions.size(); ++j) {
    // Against double at the very direction that float stores: its rounding is the input's, not the evaluation's.
    const Vec3d d = {x[j], y[j], z[j]};
    const double length = std::sqrt(dot(d, d));
    const auto exact = basis(kBands, 1 / length * d);
    const auto single = basis(kBands, vec_cast<float>(d));
    for (std::size_t i = 0; i < exact.size(); ++i) {
      worst = std::max({worst, std::abs(single[i] - exact[i]), std::abs(many[i * directions.size() + j] - exact[i])});
    }
  }
  EXPECT_LT(worst, 1e-5);
}

TEST(Basis, ManyAtOnceEqualsOneByOne) {
  const auto directions = test_directions();
  std::vector<float> x, y, z;
  for (const Vec3d d : directions) {
    x.push_back(static_cast<float>(d.x)), y.push_back(static_cast<float>(d.y)), z.push_back(static_cast<float>(d.z));
  }
  for (int bands = 0; bands <= 9; ++bands) {
    std::vector<float> many(directions.size() * num_coefficients(bands));
    eval_basis(bands, x, y, z, many);
    for (std::size_t j = 0; j < directions.size(); ++j) {
      const auto one = basis(bands, vec_cast<float>(directions[j]));
      for (std::size_t i = 0; i < one.size(); ++i)
        EXPECT_NEAR(many[i * directions.size() + j], one[i], 2e-6) << bands << " bands, coefficient " << i;
    }
  }
}

TEST(Basis, ReconstructionOfADeltaPeaksThere) {
  const Vec3d d = {.36, .48, .80};
  RgbCoefficients delta(10);
  add_delta(d, {1, 2, 0}, delta);
  // Σ Y_i(d)² = n²/4π, the most that any direction can reach.
  const Rgb peak = reconstruct(delta, d);
  EXPECT_NEAR(peak.r, 100 / (4 * pi), 1e-12);
  EXPECT_NEAR(peak.g, 200 / (4 * pi), 1e-12);
  EXPECT_EQ(peak.b, 0);
  for (const Vec3d other : test_directions())
    if (dot(other, d) < 0.999) {
      EXPECT_LT(reconstruct(delta, other).r, peak.r);
    }
}

}  // namespace
}  // namespace shlight
