#include "shlight/light/window_name.h"

#include <gtest/gtest.h>

#include <cmath>

#include "shlight/core/error.h"

namespace shlight {
namespace {

// A point light from +Z, which rings with few bands.
RgbCoefficients point(int bands) {
  RgbCoefficients light(bands);
  for (int l = 0; l < bands; ++l) {
    const double y = std::sqrt((2 * l + 1) / 12.566370614359172);
    light.at(l, 0) = {y, y, y};
  }
  return light;
}

TEST(WindowName, NamesTheWindowsOfTheLibrary) {
  const RgbCoefficients light = point(5);
  EXPECT_EQ(apply_named_window("none", light).coefficients, light);
  EXPECT_EQ(apply_named_window("hann:6", light).coefficients, apply_window(Window::kHann, 1.0 / 6, light));
  EXPECT_EQ(apply_named_window("lanczos:4.5", light).coefficients, apply_window(Window::kLanczos, 1 / 4.5, light));
  EXPECT_EQ(apply_named_window("laplacian:0.01", light).coefficients, apply_window(Window::kLaplacian, 0.01, light));
  EXPECT_FALSE(apply_named_window("hann:6", light).automatic.has_value());
}

TEST(WindowName, AutomaticOnesSayWhatTheyDid) {
  const RgbCoefficients light = point(5);
  const NamedWindowResult irradiance = apply_named_window("auto", light);
  const NamedWindowResult radiance = apply_named_window("auto-radiance", light);
  ASSERT_TRUE(irradiance.automatic && radiance.automatic);
  EXPECT_GT(irradiance.automatic->strength, 0);
  EXPECT_GT(radiance.automatic->strength, irradiance.automatic->strength) << "radiance rings more";
  EXPECT_GE(radiance.automatic->lower_bound, 0);
}

TEST(WindowName, RefusesWhatIsNone) {
  for (const char* name : {"", "hann", "hann:", "hann:0", "hann:-1", "hann:nan", "hann:inf", "hann:6x", "box:3", "Auto",
                           "laplacian:1e999"}) {
    EXPECT_FALSE(is_window_name(name)) << name;
    EXPECT_THROW(apply_named_window(name, point(3)), Error) << name;
  }
}

}  // namespace
}  // namespace shlight
