#include "shlight/image/clamp.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "shlight/image/pixels.h"

namespace shlight {
namespace {

constexpr double kPi = std::numbers::pi;

Rgb integral(const Environment& environment) {
  Rgb sum;
  const Image& image = environment.image;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      sum += pixel_solid_angle(environment.layout, environment.size(), {x, y}) * image.rgb(x, y);
  return sum;
}

void expect_near(Rgb a, Rgb b, double tolerance) {
  EXPECT_NEAR(a.r, b.r, tolerance);
  EXPECT_NEAR(a.g, b.g, tolerance);
  EXPECT_NEAR(a.b, b.b, tolerance);
}

Environment some_environment(Layout layout, int width, int height) {
  Environment environment{Image(width, height), layout};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      environment.image.set_rgb(x, y,
                                {std::exp(3 * std::sin(0.3 * x + y)), 2 + std::cos(0.2 * x), 3 * std::sin(0.5 * y)});
  return environment;
}

// What is left, what was lost and what negative values had taken make up what there was.
TEST(Clamp, LightIsLostButNotMislaid) {
  for (const Layout layout : all_layouts()) {
    const auto [width, height] = picture_size(layout, size_from_horizon(layout, 64));
    Environment environment = some_environment(layout, width, height);
    clear_unused(environment);
    const Rgb before = integral(environment);
    const ClampReport report = clamp_radiance(environment, 2.5);
    const Rgb after = integral(environment);
    expect_near(report.total, before, 1e-12);
    expect_near(after + report.lost - report.gained, before, 1e-5);  // pixels are floats
    EXPECT_GT(report.lost.r, 0);
    EXPECT_GT(report.gained.b, 0);
    EXPECT_EQ(report.gained.r, 0);
    for (const float value : environment.image.values) {
      EXPECT_LE(value, 2.5f);
      EXPECT_GE(value, 0);
    }
    const ClampReport again = clamp_radiance(environment, 2.5);
    EXPECT_EQ(again.above + again.negative, 0u);
    expect_near(again.lost, {}, 0);
  }
}

// Half of the sphere at 3, clamped to 1, loses 2 · 2π of 4π · 2.
TEST(Clamp, HalfTheSphere) {
  Environment environment{Image(8, 4), Layout::kLatLong};
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 8; ++x) environment.image.set_rgb(x, y, y < 2 ? Rgb{3, 3, 3} : Rgb{1, 1, 1});
  environment.image.set_rgb(0, 3, {1, 1, -1});
  const ClampReport report = clamp_radiance(environment, 1);
  EXPECT_EQ(report.above, 16u);
  EXPECT_EQ(report.negative, 1u);
  expect_near(report.lost, {4 * kPi, 4 * kPi, 4 * kPi}, 1e-12);
  EXPECT_NEAR(report.total.r, 8 * kPi, 1e-12);
  EXPECT_NEAR(report.gained.b, pixel_solid_angle(Layout::kLatLong, {8, 4}, {0, 3}), 1e-12);
  EXPECT_NEAR(report.lost_share(), 0.5, 0.01);
}

TEST(Clamp, NothingAboveLosesNothing) {
  Environment environment{Image(8, 4), Layout::kLatLong};
  for (float& value : environment.image.values) value = 0.75f;
  const Image before = environment.image;
  const ClampReport report = clamp_radiance(environment, 1);
  EXPECT_EQ(report.above + report.negative, 0u);
  EXPECT_EQ(report.lost_share(), 0);
  EXPECT_EQ(environment.image.values, before.values);
  Environment black{Image(8, 4), Layout::kLatLong};
  EXPECT_EQ(clamp_radiance(black, 1).lost_share(), 0);
}

}  // namespace
}  // namespace shlight
