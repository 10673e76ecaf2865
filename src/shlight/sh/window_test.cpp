#include "shlight/sh/window.h"

#include <gtest/gtest.h>

#include <cmath>

#include "shlight/sh/basis.h"
#include "shlight/sh/sphere_samples.h"
#include "shlight/sh/zonal.h"

namespace shlight {
namespace {

constexpr Window kWindows[] = {Window::kHann, Window::kLanczos, Window::kLaplacian};

RgbCoefficients directional_light(int bands) {
  RgbCoefficients c(bands);
  add_delta({.36, .48, .80}, {1, 0.5, 2}, c);
  return c;
}

double smallest_sample(const RgbCoefficients& c) {
  double smallest = 1e9;
  for (const Vec3d d : make_sphere_samples(0, 200, 5).directions) {
    const Rgb value = reconstruct(c, d);
    smallest = std::min({smallest, value.r, value.g, value.b});
  }
  return smallest;
}

TEST(Window, FactorsFallFromOne) {
  for (const Window window : kWindows) {
    EXPECT_EQ(window_factor(window, 0, 7), 1);
    EXPECT_EQ(window_factor(window, 0.3, 0), 1);
    for (int l = 0; l < 10; ++l) {
      EXPECT_GE(window_factor(window, 0.05, l), window_factor(window, 0.05, l + 1));
      EXPECT_GE(window_factor(window, 0.05, l), window_factor(window, 0.06, l));
      EXPECT_GE(window_factor(window, 0.3, l), 0);
    }
  }
  EXPECT_NEAR(window_factor(Window::kHann, 0.25, 2), 0.5, 1e-15);
  EXPECT_NEAR(window_factor(Window::kLaplacian, 0.5, 1), 1.0 / 3, 1e-15);
}

// Non-negative everywhere, and no more windowing than needed: with 2 % less a negative value can be shown.
TEST(Window, AutoIsJustEnoughForADirectionalLight) {
  for (const Window window : kWindows)
    for (const Positive positive : {Positive::kIrradiance, Positive::kRadiance})
      for (const int bands : {3, 5, 8}) {
        SCOPED_TRACE(testing::Message() << "window " << int(window) << ", " << bands << " bands, irradiance "
                                        << (positive == Positive::kIrradiance));
        const RgbCoefficients light = directional_light(bands);
        const auto shown = [&](const RgbCoefficients& c) {
          return positive == Positive::kIrradiance ? irradiance_from_radiance(c) : c;
        };
        const AutoWindow result = make_auto_window(window, positive, light);
        EXPECT_GT(result.strength, 0);
        EXPECT_GE(result.lower_bound, 0);
        EXPECT_GE(smallest_sample(shown(result.coefficients)), result.lower_bound);
        EXPECT_LT(result.contrast_kept, 1);
        EXPECT_GT(result.contrast_kept, 0.05);
        EXPECT_EQ(result.coefficients, apply_window(window, result.strength, light));
        const AutoWindow again = make_auto_window(window, positive, result.coefficients);
        EXPECT_EQ(again.strength, 0);
        EXPECT_LT(smallest_sample(shown(apply_window(window, 0.98 * result.strength, light))), 0);
      }
}

TEST(Window, AutoLeavesAPositiveLightAlone) {
  RgbCoefficients light(3);
  light[0] = {4, 4, 4};
  light[2] = {1, 0.5, 0};
  const AutoWindow result = make_auto_window(Window::kLaplacian, Positive::kRadiance, light);
  EXPECT_EQ(result.strength, 0);
  EXPECT_EQ(result.coefficients, light);
  EXPECT_EQ(result.contrast_kept, 1);
}

TEST(Window, AutoEndsForBlackAndNegativeLights) {
  RgbCoefficients light(3);
  EXPECT_EQ(make_auto_window(Window::kLaplacian, Positive::kRadiance, light).strength, 0);
  light[0] = {-1, 0, 1};
  light[6] = {0.3, 0.3, 5};
  EXPECT_GE(make_auto_window(Window::kLaplacian, Positive::kRadiance, light).lower_bound, 0);
}

}  // namespace
}  // namespace shlight
