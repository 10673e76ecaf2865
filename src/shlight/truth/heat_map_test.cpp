#include "shlight/truth/heat_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "shlight/image/tone_map.h"
#include "shlight/truth/truth_test_util.h"

namespace shlight {
namespace {

// OKLab's lightness [1].
double lightness(Rgb c) {
  return 0.2104542553 * std::cbrt(0.4122214708 * c.r + 0.5363325363 * c.g + 0.0514459929 * c.b) +
         0.7936177850 * std::cbrt(0.2119034982 * c.r + 0.6806995451 * c.g + 0.1073969566 * c.b) -
         0.0040720468 * std::cbrt(0.0883024619 * c.r + 0.2817188376 * c.g + 0.6299787005 * c.b);
}

TEST(HeatMap, EveryStepIsAsMuchLighter) {
  const double dark = lightness(heat_color(0)), light = lightness(heat_color(1));
  EXPECT_LT(dark, 0.15);
  EXPECT_GT(light, 0.95);
  for (double t = 0; t <= 1; t += 1.0 / 64) {
    const Rgb c = heat_color(t);
    EXPECT_NEAR(lightness(c), std::lerp(dark, light, t), 1e-6) << t;
    EXPECT_GE(std::min({c.r, c.g, c.b}), 0) << t;
    EXPECT_LE(std::max({c.r, c.g, c.b}), 1) << t;
  }
  EXPECT_EQ(heat_color(-1), heat_color(0));
  EXPECT_EQ(heat_color(7), heat_color(1));
}

TEST(HeatMap, ShowsThePlaneBesideItsScale) {
  Plane plane(30, 80);
  plane.at(3, 5) = 2;
  plane.at(4, 5) = 1;
  const Image8 image = make_heat_map(plane, 2);
  EXPECT_EQ(image.width, 30 + kScaleWidth);
  EXPECT_EQ(image.height, 80);
  const auto red = [&](int x, int y) { return int{image.values[static_cast<std::size_t>(4 * (y * image.width + x))]}; };
  const auto byte = [](double v) { return static_cast<int>(std::lround(255 * encode_srgb(v))); };
  EXPECT_EQ(red(3, 5), byte(heat_color(1).r));
  EXPECT_EQ(red(4, 5), byte(heat_color(0.5).r));
  EXPECT_EQ(red(5, 5), byte(heat_color(0).r));
  // The scale holds white numbers, and its bar the lightest and the darkest color.
  int white = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = plane.width; x < image.width; ++x) white += red(x, y) == 255;
  EXPECT_GT(white, 100);
}

TEST(HeatMap, SmallPlanesHaveAScaleToo) {
  const Image8 image = make_heat_map(Plane(1, 1), 0.01);
  EXPECT_EQ(image.height, kScaleHeight);
  EXPECT_EQ(image.values.size(), static_cast<std::size_t>(4 * image.width * image.height));
}

}  // namespace
}  // namespace shlight
