#include "shlight/brdf/oren_nayar.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "shlight/brdf/brdf_test_util.h"

namespace shlight {
namespace {

using std::numbers::pi;

TEST(OrenNayar, SmoothIsLambert) {
  const auto qualitative = make_oren_nayar({0.8, 0.5, 0.2}, 0), full = make_oren_nayar_full({0.8, 0.5, 0.2}, 0);
  for (const double degrees : {0.0, 30.0, 80.0})
    for (const auto* brdf : {qualitative.get(), full.get()}) {
      const Rgb f = brdf->eval(direction_at(60, 10), direction_at(degrees, 130));
      EXPECT_NEAR(f.r, 0.8 / pi, 1e-15);
      EXPECT_NEAR(f.g, 0.5 / pi, 1e-15);
      EXPECT_NEAR(f.b, 0.2 / pi, 1e-15);
    }
}

// The thesis prints σ² − 0.33 and σ² − 0.09 below the lines, a factor n·s and no 1/π: each would show here.
TEST(OrenNayar, HasTheConstantsOfThePaper) {
  const double sigma = 0.4, variance = sigma * sigma;
  const double a = 1 - 0.5 * variance / (variance + 0.33), b = 0.45 * variance / (variance + 0.09);
  const auto brdf = make_oren_nayar({1, 1, 1}, sigma);
  // From the normal, tan β is zero.
  EXPECT_NEAR(brdf->eval(direction_at(50, 0), {0, 0, 1}).g, a / pi, 1e-15);
  // Back where the light comes from, α = β.
  const double theta = 50 * pi / 180;
  EXPECT_NEAR(brdf->eval(direction_at(50, 20), direction_at(50, 20)).g,
              (a + b * std::sin(theta) * std::tan(theta)) / pi, 1e-14);
  // On the other side there is no second term.
  EXPECT_NEAR(brdf->eval(direction_at(50, 20), direction_at(70, 200)).g, a / pi, 1e-15);
}

// α is the larger of the polar angles, β the smaller.
TEST(OrenNayar, FullModelIsItsFormula) {
  const double sigma = 0.5, variance = 0.25, rho = 0.6;
  const auto brdf = make_oren_nayar_full({rho, rho, rho}, sigma);
  for (const double delta : {0.0, 60.0, 150.0}) {
    const double alpha = 70 * pi / 180, beta = 25 * pi / 180, c = std::cos(delta * pi / 180);
    const double part = 2 * beta / pi, slope = variance / (variance + 0.09);
    const double c1 = 1 - 0.5 * variance / (variance + 0.33);
    const double c2 = 0.45 * slope * (c >= 0 ? std::sin(alpha) : std::sin(alpha) - std::pow(part, 3));
    const double c3 = 0.125 * slope * std::pow(4 * alpha * beta / (pi * pi), 2);
    const double single = c1 + c * c2 * std::tan(beta) + (1 - std::abs(c)) * c3 * std::tan((alpha + beta) / 2);
    const double twice = 0.17 * rho * rho * variance / (variance + 0.13) * (1 - c * part * part);
    EXPECT_NEAR(brdf->eval(direction_at(70, 10), direction_at(25, 10 + delta)).g, (rho * single + twice) / pi, 1e-14);
  }
}

}  // namespace
}  // namespace shlight
