// Which way is up, left and forward, from a file of each layout to the picture.
//
// The light builtin:axes has a disc of 25° half angle on each axis: +X red, −X cyan, +Y green, −Y magenta, +Z blue, −Z
// yellow. What a camera must see of it is computed here anew, from the documentation alone: --camera AZ,EL stands at
// (sin AZ cos EL, sin EL, cos AZ cos EL) and looks at the origin.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "shlight/image/layout.h"
#include "shlight/light/builtin_light.h"
#include "tool_test_util.h"

namespace shlight {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr int kWidth = 321, kHeight = 121;
const double kTanY = std::tan(17.5 * kDegree), kTanX = kTanY * kWidth / kHeight;
constexpr double kZoom = 0.5;  // the sphere takes half of the picture's height, its light is seen around

struct Spot {
  const char* name;
  Vec3d axis;
  Rgb color;
};
constexpr std::array<Spot, 6> kSpots = {{{"red", {1, 0, 0}, {6, 0.2, 0.2}},
                                         {"cyan", {-1, 0, 0}, {0.2, 6, 6}},
                                         {"green", {0, 1, 0}, {0.2, 6, 0.2}},
                                         {"magenta", {0, -1, 0}, {6, 0.2, 6}},
                                         {"blue", {0, 0, 1}, {0.2, 0.2, 6}},
                                         {"yellow", {0, 0, -1}, {6, 6, 0.2}}}};
constexpr double kGrey = 0.04;  // between the spots, and added to them
constexpr double kHalfAngle = 25 * kDegree;

struct View {
  double azimuth, elevation;  // degrees

  std::string text() const { return std::to_string(azimuth) + "," + std::to_string(elevation); }
  Vec3d toward() const {
    const double a = azimuth * kDegree, e = elevation * kDegree;
    return {std::sin(a) * std::cos(e), std::sin(e), std::cos(a) * std::cos(e)};
  }
  Vec3d right() const { return {std::cos(azimuth * kDegree), 0, -std::sin(azimuth * kDegree)}; }
  Vec3d up() const { return cross(toward(), right()); }
  // Where the light comes from that is seen at u to the right and v up, both in [-1, 1].
  Vec3d direction_seen(double u, double v) const {
    const Vec3d d = (u * kTanX) * right() + (v * kTanY) * up() - toward();
    return 1 / std::sqrt(dot(d, d)) * d;
  }
};

// The spot that is within 30° of a direction.
const Spot* spot_near(Vec3d direction) {
  for (const Spot& spot : kSpots)
    if (dot(spot.axis, direction) > std::cos(30 * kDegree)) return &spot;
  return nullptr;
}

// The radiance from a direction; nothing within 1.5° of a spot's edge, which a picture blurs.
std::optional<Rgb> light_from(Vec3d direction) {
  Rgb sum = {kGrey, kGrey, kGrey};
  for (const Spot& spot : kSpots) {
    const double angle = std::acos(std::clamp(dot(spot.axis, direction), -1.0, 1.0));
    if (std::abs(angle - kHalfAngle) < 1.5 * kDegree) return {};
    if (angle < kHalfAngle) sum += spot.color;
  }
  return sum;
}

// The name of the spot whose hue is nearest.
std::string hue(Rgb c) {
  const auto chroma = [](Rgb v) {
    const double mean = (v.r + v.g + v.b) / 3;
    return Vec3d{v.r - mean, v.g - mean, v.b - mean};
  };
  const auto nearest = std::max_element(kSpots.begin(), kSpots.end(), [&](const Spot& a, const Spot& b) {
    const Vec3d ca = chroma(a.color), cb = chroma(b.color), v = chroma(c);
    return dot(ca, v) / std::sqrt(dot(ca, ca)) < dot(cb, v) / std::sqrt(dot(cb, cb));
  });
  return nearest->name;
}

double mean_difference(const Image& a, const Image& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.values.size(); ++i) sum += std::abs(a.values[i] - b.values[i]);
  return sum / static_cast<double>(a.values.size());
}

class ToolOrientation : public ToolDrawingTest {
 protected:
  void SetUp() override {
    ToolDrawingTest::SetUp();
    const auto axes = make_axes_light();
    save_image(folder_ / "lat-long.exr", axes->lat_long(512));
    constexpr int kSize = 512;
    Image angular_map(kSize, kSize);
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x)
        if (const auto d = direction_at(Layout::kAngularMap, {(x + 0.5) / kSize, (y + 0.5) / kSize}))
          angular_map.set_rgb(x, y, axes->radiance(*d));
    save_image(folder_ / "angular-map.exr", angular_map);
  }

  Image draw(const std::string& light, const View& view, const std::string& rotate_light = "0") const {
    run({"render", "builtin:sphere", "--light", light, "--camera", view.text() + "," + std::to_string(kZoom), "--size",
         std::to_string(kWidth) + "x" + std::to_string(kHeight), "--rotate-light", rotate_light, "-o",
         path("draw.exr")});
    return load_image(folder_ / "draw.exr").image;
  }
};

// The middle of the sphere has the colour of the spot that it faces, and opposite sides differ as their spots do.
void expect_shading(const Image& image, const View& view) {
  const double reach = 0.9 * 0.47 * kZoom * kHeight;
  const auto seen = [&](double right, double up) {
    return image.rgb(static_cast<int>(kWidth / 2.0 + right * reach), static_cast<int>(kHeight / 2.0 - up * reach));
  };
  const auto expect_hue = [&](Rgb color, Vec3d normal, const char* where) {
    const Spot* spot = spot_near(normal);
    if (!spot) return;
    EXPECT_EQ(hue(color), spot->name) << view.text() << " " << where;
  };
  expect_hue(seen(0, 0), view.toward(), "middle");
  expect_hue(seen(1, 0) - seen(-1, 0), view.right(), "right");
  expect_hue(seen(0, 1) - seen(0, -1), view.up(), "top");
}

// Every pixel around the sphere shows what comes from behind it.
void expect_background(const Image& image, const View& view) {
  int compared = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const double u = (2 * x + 1.0) / kWidth - 1, v = 1 - (2 * y + 1.0) / kHeight;
      const auto expected = light_from(view.direction_seen(u, v));
      if (!expected || std::hypot(u * kTanX, v * kTanY) < 1.05 * kZoom * kTanY) continue;
      const Rgb difference = image.rgb(x, y) - *expected;
      const double largest = std::max({std::abs(difference.r), std::abs(difference.g), std::abs(difference.b)});
      ASSERT_LT(largest, 0.02) << view.text() << ", pixel " << x << " " << y;
      ++compared;
    }
  EXPECT_GT(compared, kWidth * kHeight / 3);
}

TEST_F(ToolOrientation, LightIsSeenWhereItComesFrom) {
  // Each axis in the middle; two spots side by side; one at the top and one at the bottom of the picture.
  for (const View& view :
       {View{0, 0}, {90, 0}, {180, 0}, {270, 0}, {0, 80}, {0, -80}, {90, 80}, {45, 0}, {0, -60}, {0, 60}, {180, -35}}) {
    const Image image = draw(path("lat-long.exr"), view);
    expect_shading(image, view);
    expect_background(image, view);
  }
}

TEST_F(ToolOrientation, EveryLayoutShowsTheSame) {
  for (const View& view : {View{20, 10}, {200, -50}}) {
    const Image builtin = draw("builtin:axes", view);
    expect_background(builtin, view);
    for (const char* layout : {"lat-long.exr", "angular-map.exr"}) {
      const Image image = draw(path(layout), view);
      expect_background(image, view);
      // Spots' edges differ by a pixel; a quarter turn of the light makes 0.3.
      EXPECT_LT(mean_difference(image, builtin), 0.02) << layout << " " << view.text();
    }
  }
}

TEST_F(ToolOrientation, TurningTheLightTurnsShadingAndBackground) {
  for (const std::string& light : {path("lat-long.exr"), path("angular-map.exr")}) {
    const Image still = draw(light, {20, 10});
    // Both turn counter-clockwise seen from above.
    EXPECT_LT(mean_difference(draw(light, {110, 10}, "90"), still), 0.02) << light;
    EXPECT_GT(mean_difference(draw(light, {110, 10}, "-90"), still), 0.2) << light;
    // The turn brings what was at −Z, in front of the camera at azimuth 0, to −X, in front of the one at 90.
    const Image turned = draw(light, {90, 0}, "90");
    expect_shading(turned, {0, 0});
    expect_background(turned, {0, 0});
  }
}

}  // namespace
}  // namespace shlight
