#include "shlight/render/background.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "shlight/render/render_test_util.h"
#include "shlight/render/targets.h"

namespace shlight {
namespace {

constexpr int kSize = 33;
constexpr double kHalfPrecision = 1.0 / 1024;

Image draw(const Background& background, double azimuth, double elevation, double rotate_light_degrees = 0) {
  Camera camera;
  camera.azimuth = azimuth;
  camera.elevation = elevation;
  const RadianceTarget target(kSize, kSize);
  target.begin();
  background.draw(make_view(camera, {}, 1), rotation_about_y(rotate_light_degrees * std::numbers::pi / 180));
  target.resolve();
  return target.read(1);
}

// The direction that the middle of pixel (x, y) of a lat-long picture shows.
Vec3d lat_long_direction(double x, double y, int width, int height) {
  const double azimuth = (x / width - 0.5) * 2 * std::numbers::pi, latitude = (0.5 - y / height) * std::numbers::pi;
  return {std::cos(latitude) * std::sin(azimuth), std::sin(latitude), -std::cos(latitude) * std::cos(azimuth)};
}

// A picture whose colour is its own direction, moved to be positive.
Image direction_picture(int width, int height) {
  Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const Vec3d d = lat_long_direction(x + 0.5, y + 0.5, width, height);
      image.set_rgb(x, y, {2 + d.x, 2 + d.y, 2 + d.z});
    }
  return image;
}

void expect_color(const Image& image, int x, int y, Rgb expected, double tolerance) {
  const Rgb color = image.rgb(x, y);
  EXPECT_NEAR(color.r, expected.r, tolerance);
  EXPECT_NEAR(color.g, expected.g, tolerance);
  EXPECT_NEAR(color.b, expected.b, tolerance);
}

class BackgroundTest : public GlTest {};

// At a pole the nearest pixels are half a row of 128 away, which is 0.0123; elsewhere interpolation does better.
constexpr double kDirectionTolerance = 0.015;

TEST_F(BackgroundTest, ShowsWhatIsBehindTheModel) {
  const Background background(direction_picture(256, 128), 1);
  const int middle = kSize / 2;
  struct Case {
    double azimuth, elevation;
    Vec3d seen;
  };
  for (const Case& c : {Case{0, 0, {0, 0, -1}}, Case{90, 0, {-1, 0, 0}}, Case{180, 0, {0, 0, 1}},
                        Case{270, 0, {1, 0, 0}}, Case{0, 90, {0, -1, 0}}, Case{0, -90, {0, 1, 0}}})
    expect_color(draw(background, c.azimuth, c.elevation), middle, middle, {2 + c.seen.x, 2 + c.seen.y, 2 + c.seen.z},
                 kDirectionTolerance);

  // Looking down -Z, the picture's right is +X and its top +Y.
  const Image ahead = draw(background, 0, 0);
  const double edge = std::tan(Camera().vertical_fov * std::numbers::pi / 360) * (kSize - 1) / kSize;
  const double length = std::hypot(edge, 1);
  expect_color(ahead, kSize - 1, middle, {2 + edge / length, 2, 2 - 1 / length}, kDirectionTolerance);
  expect_color(ahead, middle, 0, {2, 2 + edge / length, 2 - 1 / length}, kDirectionTolerance);
}

TEST_F(BackgroundTest, HasNoSeamAtTheBack) {
  // The picture's ends meet at +Z, which azimuth 180 looks at; values run on smoothly across it. Of eight columns the
  // last and the first differ by 0.77, which takes 45 degrees, a little more than the view.
  const Image behind = draw(Background(direction_picture(8, 4), 1), 180, 0);
  for (int x = 1; x < kSize; ++x) EXPECT_NEAR(behind.rgb(x, kSize / 2).r, behind.rgb(x - 1, kSize / 2).r, 0.04) << x;
}

TEST_F(BackgroundTest, TurnsWithTheLight) {
  // A quarter turn counter-clockwise from above takes +Z to +X and -X to +Z.
  const Background background(direction_picture(256, 128), 1);
  expect_color(draw(background, 180, 0, 90), kSize / 2, kSize / 2, {1, 2, 2}, kDirectionTolerance);
}

TEST_F(BackgroundTest, CoefficientsShowTheirSum) {
  // 1 + x / 2 + y / 4 + z / 8, exactly of two bands.
  RgbCoefficients light(2);
  const double y00 = std::sqrt(4 * std::numbers::pi), y1 = std::sqrt(4 * std::numbers::pi / 3);
  light.at(0, 0) = y00 * Rgb{1, 1, 1};
  light.at(1, 1) = y1 / 2 * Rgb{1, 1, 1};
  light.at(1, -1) = y1 / 4 * Rgb{1, 1, 1};
  light.at(1, 0) = y1 / 8 * Rgb{1, 1, 1};
  const Background background(light);
  const int middle = kSize / 2;
  expect_color(draw(background, 0, 0), middle, middle, {0.875, 0.875, 0.875}, kHalfPrecision);
  expect_color(draw(background, 90, 0), middle, middle, {0.5, 0.5, 0.5}, kHalfPrecision);
  expect_color(draw(background, 90, 0, 90), middle, middle, {1 - 0.125, 1 - 0.125, 1 - 0.125}, kHalfPrecision);
  expect_color(draw(background, 0, -90), middle, middle, {1.25, 1.25, 1.25}, kHalfPrecision);
}

TEST_F(BackgroundTest, ClampsToHalfFloats) {
  Image image(2, 1);
  image.set_rgb(0, 0, {1e9, -1, std::numeric_limits<double>::quiet_NaN()});
  image.set_rgb(1, 0, {1e9, -1, std::numeric_limits<double>::quiet_NaN()});
  expect_color(draw(Background(image, 1), 0, 0), 5, 5, {65504, 0, 0}, 0);
  expect_color(draw(Background(image, 1e-9), 0, 0), 5, 5, {1, 0, 0}, kHalfPrecision);
}

TEST(ReduceToSize, AveragesBlocks) {
  Image image(5, 2);
  for (int x = 0; x < 5; ++x)
    for (int y = 0; y < 2; ++y) image.set_rgb(x, y, {1.0 * x, 1.0 * y, 7});
  const Image reduced = reduce_to_size(image, 3);
  ASSERT_EQ(reduced.width, 3);
  ASSERT_EQ(reduced.height, 1);
  EXPECT_EQ(reduced.rgb(0, 0), (Rgb{0.5, 0.5, 7}));
  EXPECT_EQ(reduced.rgb(2, 0), (Rgb{4, 0.5, 7})) << "the last block is partial";
  EXPECT_EQ(reduce_to_size(image, 5).width, 5);
}

}  // namespace
}  // namespace shlight
