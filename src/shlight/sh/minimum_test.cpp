#include "shlight/sh/minimum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "shlight/sh/basis.h"
#include "shlight/sh/sphere_samples.h"

namespace shlight {
namespace {

std::vector<double> some_coefficients(int bands, double seed) {
  std::vector<double> c(static_cast<std::size_t>(num_coefficients(bands)));
  for (std::size_t i = 0; i < c.size(); ++i) c[i] = std::sin(seed + 3.7 * double(i * i));
  return c;
}

double value_at(const std::vector<double>& c, int bands, Vec3d d) {
  std::vector<double> basis(c.size());
  eval_basis(bands, d, std::span<double>(basis));
  double sum = 0;
  for (std::size_t i = 0; i < c.size(); ++i) sum += c[i] * basis[i];
  return sum;
}

TEST(Minimum, ValueAndGradientAreTheFunctions) {
  for (const int bands : {1, 2, 3, 6, 12}) {
    const auto c = some_coefficients(bands, 0.2);
    GradientEvaluator evaluate(c, bands);
    for (const Vec3d d : make_sphere_samples(0, 6, 3).directions) {
      const auto [value, gradient] = evaluate(d);
      EXPECT_NEAR(value, value_at(c, bands, d), 1e-12);
      EXPECT_NEAR(dot(gradient, d), 0, 1e-11);
      // Along two tangents, by central differences on the great circle.
      const Vec3d u = std::abs(d.x) < 0.8 ? cross(d, {1, 0, 0}) : cross(d, {0, 1, 0});
      for (const Vec3d tangent : {u, cross(d, u)}) {
        const double length = std::sqrt(dot(tangent, tangent)), h = 1e-5;
        const Vec3d t = 1 / length * tangent;
        const double slope = (value_at(c, bands, std::cos(h) * d + std::sin(h) * t) -
                              value_at(c, bands, std::cos(h) * d - std::sin(h) * t)) /
                             (2 * h);
        EXPECT_NEAR(dot(gradient, t), slope, 1e-6 * bands * bands) << bands << " bands";
      }
    }
  }
}

TEST(Minimum, BracketsTheSmallestOfManySamples) {
  const auto samples = make_sphere_samples(0, 300, 5);
  for (const int bands : {1, 2, 3, 5, 8, 12})
    for (const double seed : {0.1, 1.7, 4.2}) {
      const auto c = some_coefficients(bands, seed);
      const CertifiedMinimum minimum = find_minimum(c, bands);
      double smallest = 1e9, norm = 0;
      for (const Vec3d d : samples.directions) smallest = std::min(smallest, value_at(c, bands, d));
      for (const double v : c) norm += v * v;
      // No sample is below the bound; the value found is a value of the function, and the two are close.
      EXPECT_LE(minimum.lower_bound, smallest);
      EXPECT_LE(minimum.value, smallest + 1e-12);
      EXPECT_NEAR(value_at(c, bands, minimum.direction), minimum.value, 1e-12);
      EXPECT_LE(minimum.value - minimum.lower_bound, 1.01e-5 * std::sqrt(norm));
    }
}

// A dent so narrow that coarse samples miss it: −Y_l0's delta of 40 bands, one degree or so across.
TEST(Minimum, DoesNotMissANarrowDent) {
  constexpr int kBands = 40;
  std::vector<double> c(kBands * kBands);
  const Vec3d d = {.36, .48, .80};
  eval_basis(kBands, d, std::span<double>(c));
  for (double& v : c) v = -v;
  const CertifiedMinimum minimum = find_minimum(c, kBands, 1e-3);
  EXPECT_NEAR(minimum.value, -kBands * kBands / (4 * std::numbers::pi), 0.1);
  EXPECT_GT(dot(minimum.direction, d), 0.9999);
}

TEST(Minimum, SignIsThatOfTheMinimum) {
  for (const double mean : {-1.0, 0.0, 3.0, 8.0, 30.0}) {
    auto c = some_coefficients(6, 0.4);
    c[0] = mean;
    const CertifiedMinimum minimum = find_minimum(c, 6), sign = find_sign_of_minimum(c, 6);
    EXPECT_EQ(sign.value < 0, minimum.value < 0) << mean;
    EXPECT_EQ(sign.lower_bound >= 0, minimum.lower_bound >= 0) << mean;
    EXPECT_LE(sign.lower_bound, minimum.value) << mean;
  }
}

TEST(Minimum, AConstantIsItsOwnMinimum) {
  const std::vector<double> c = {2};
  EXPECT_NEAR(find_minimum(c, 1).lower_bound, 2 / std::sqrt(4 * std::numbers::pi), 1e-15);
}

}  // namespace
}  // namespace shlight
