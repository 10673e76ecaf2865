#include "shlight/sh/project.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "shlight/sh/basis.h"

namespace shlight {
namespace {

using std::numbers::pi;

Rgb thesis_light(Vec3d d) {
  const double theta = std::acos(d.z), phi = std::atan2(d.y, d.x);
  const double value =
      std::max(0.0, 5 * std::cos(theta) - 4) + std::max(0.0, -4 * std::sin(theta - pi) * std::cos(phi - 2.5) - 3);
  return {value, value, value};
}

RgbCoefficients some_light(int bands) {
  RgbCoefficients light(bands);
  for (std::size_t i = 0; i < light.size(); ++i) light[i] = {std::sin(3.7 * double(i)), std::cos(1.3 * double(i)), 1};
  return light;
}

TEST(GaussLegendre, IntegratesPolynomialsExactly) {
  for (const int count : {1, 2, 5, 16, 33, 128}) {
    const GaussLegendre rule = make_gauss_legendre(count);
    for (const int power : {0, 1, 2, 2 * count - 2, 2 * count - 1}) {
      if (power > 2 * count - 1) continue;
      double integral = 0;
      for (std::size_t k = 0; k < rule.nodes.size(); ++k) integral += rule.weights[k] * std::pow(rule.nodes[k], power);
      EXPECT_NEAR(integral, power % 2 ? 0 : 2.0 / (power + 1), 1e-13) << count << " nodes, power " << power;
    }
  }
}

TEST(Project, QuadratureGivesBackCoefficients) {
  const RgbCoefficients light = some_light(12);
  QuadratureParams coarse;
  coarse.first_rows = 32;
  const auto projection = project_quadrature([&](Vec3d d) { return reconstruct(light, d); }, 12, coarse);
  for (std::size_t i = 0; i < light.size(); ++i) {
    EXPECT_NEAR(projection.coefficients[i].r, light[i].r, 1e-12) << "coefficient " << i;
    EXPECT_NEAR(projection.coefficients[i].g, light[i].g, 1e-12) << "coefficient " << i;
  }
  EXPECT_LT(projection.change, 1e-12);
}

TEST(Project, MonteCarloIsWithinItsStandardError) {
  const auto exact = project_quadrature(thesis_light, 4);
  const auto sampled = project_monte_carlo(thesis_light, make_sphere_samples(4, 100, 11));
  int beyond_one = 0, beyond_four = 0;
  for (std::size_t i = 0; i < exact.coefficients.size(); ++i) {
    const double error = std::abs(sampled.coefficients[i].r - exact.coefficients[i].r);
    const double sigma = sampled.standard_error[i].r;
    EXPECT_LT(sigma, 2e-2);  // plain Monte Carlo with 10 000 samples would have about 1e-2
    beyond_one += error > sigma;
    beyond_four += error > 4 * sigma;
  }
  // A normal error is beyond one sigma once in three, beyond four once in 16 000.
  EXPECT_LE(beyond_one, 10);
  EXPECT_EQ(beyond_four, 0);
}

TEST(Project, StandardErrorIsHonestOverManySeeds) {
  const auto exact = project_quadrature(thesis_light, 3);
  double squared_error = 0, squared_sigma = 0;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const auto sampled = project_monte_carlo(thesis_light, make_sphere_samples(3, 30, seed));
    for (std::size_t i = 0; i < 9; ++i) {
      squared_error += std::pow(sampled.coefficients[i].r - exact.coefficients[i].r, 2);
      squared_sigma += std::pow(sampled.standard_error[i].r, 2);
    }
  }
  // Means of neighbouring strata bend as well, so that the estimate errs to the large side; by less than half.
  const double ratio = std::sqrt(squared_sigma / squared_error);
  EXPECT_GT(ratio, 0.9);
  EXPECT_LT(ratio, 1.5);
}

TEST(SphereSamples, SameSeedSameSamplesOneInEachCell) {
  const auto a = make_sphere_samples(2, 17, 5), b = make_sphere_samples(2, 17, 5), c = make_sphere_samples(2, 17, 6);
  EXPECT_EQ(a.directions, b.directions);
  EXPECT_NE(a.directions, c.directions);
  ASSERT_EQ(a.directions.size(), 17u * 17u);
  for (std::size_t j = 0; j < a.directions.size(); ++j) {
    const Vec3d d = a.directions[j];
    EXPECT_NEAR(dot(d, d), 1, 1e-12);
    EXPECT_EQ(static_cast<std::size_t>((1 - d.z) / 2 * 17), j / 17);
    const double phi = std::atan2(d.y, d.x) / (2 * pi);
    EXPECT_EQ(static_cast<std::size_t>((phi < 0 ? phi + 1 : phi) * 17), j % 17);
    EXPECT_NEAR(a.basis_of(j)[3], std::sqrt(3 / (4 * pi)) * d.x, 1e-15);
  }
}

TEST(SphereSamples, StrataCoverTheWantedNumber) {
  EXPECT_EQ(strata_for(1), 1);
  EXPECT_EQ(strata_for(10000), 100);
  EXPECT_EQ(strata_for(10001), 101);
}

}  // namespace
}  // namespace shlight
