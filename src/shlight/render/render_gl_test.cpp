#include "shlight/render/render.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "shlight/render/render_test_util.h"
#include "shlight/render/sh_glsl.h"
#include "shlight/scene/load_scene.h"
#include "shlight/sh/rotation.h"
#include "shlight/sh/zonal.h"

namespace shlight {
namespace {

constexpr int kSize = 65;
constexpr double kHalfPrecision = 1.0 / 1024;

// Of the largest radiance: half floats, and normals interpolated between 96 columns.
constexpr double kShadingTolerance = 5e-3;

RenderParams test_params(double azimuth = 0, double elevation = 0) {
  RenderParams params;
  params.width = params.height = kSize;
  params.camera.azimuth = azimuth;
  params.camera.elevation = elevation;
  return params;
}

Image draw(const Scene& scene, const RgbCoefficients& light, RenderParams params, Image background = {}) {
  params.bands = light.bands();
  return render_irradiance(scene, {light, std::move(background)}, params).radiance;
}

double max_difference(const Image& a, const Image& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.values.size(); ++i)
    largest = std::max(largest, static_cast<double>(std::abs(a.values[i] - b.values[i])));
  return largest;
}

// The middle of mass of a picture's green, in pixels from the centre, +y up.
Vec3d brightness_center(const Image& image) {
  Vec3d sum;
  double weight = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const double g = image.rgb(x, y).g;
      sum = sum + g * Vec3d{x - (image.width - 1) / 2.0, (image.height - 1) / 2.0 - y, 0};
      weight += g;
    }
  return (1 / weight) * sum;
}

class Render : public GlTest {
 protected:
  // render_irradiance makes its own context.
  void SetUp() override {
    GlTest::SetUp();
    context_.reset();
  }

  const Scene sphere_ = make_test_scene(make_ellipsoid({1, 1, 1}));
};

TEST_F(Render, SphereIsBrightestOnTheSideOfTheLight) {
  struct Case {
    double azimuth, elevation;
    Vec3d light, side;
  };
  for (const Case& c :
       {Case{0, 0, {1, 0, 0}, {1, 0, 0}}, Case{0, 0, {-1, 0, 0}, {-1, 0, 0}}, Case{0, 0, {0, 1, 0}, {0, 1, 0}},
        Case{0, 0, {0, -1, 0}, {0, -1, 0}}, Case{90, 0, {0, 0, -1}, {1, 0, 0}}, Case{90, 0, {0, 0, 1}, {-1, 0, 0}},
        Case{180, 0, {-1, 0, 0}, {1, 0, 0}}, Case{0, 90, {0, 0, -1}, {0, 1, 0}}, Case{0, 90, {1, 0, 0}, {1, 0, 0}}}) {
    RenderParams params = test_params(c.azimuth, c.elevation);
    params.show_background = false;
    const Vec3d center = brightness_center(draw(sphere_, delta_light(3, c.light), params));
    const auto where = testing::Message() << c.azimuth << " " << c.elevation << " " << c.light.x << " " << c.light.y;
    EXPECT_GT(dot(center, c.side), 5) << where;
    EXPECT_NEAR(dot(center, Vec3d{c.side.y, c.side.x, 0}), 0, 0.5) << where;
  }
}

TEST_F(Render, SphereShowsIrradianceAsComputedInDouble) {
  for (int bands = 1; bands <= kMaxGlslBands; ++bands) {
    RgbCoefficients light = constant_light(bands, {0.5, 0.6, 0.7});
    light += delta_light(bands, {0.48, 0.64, 0.6}, {1, 2, 3});
    const RgbCoefficients irradiance = irradiance_from_radiance(light);
    RenderParams params = test_params();
    // Nearly parallel projection, in which a pixel's place gives the normal.
    params.camera.vertical_fov = 0.5;
    const Scene sphere = make_test_scene(make_ellipsoid({1, 1, 1}), {0.5f, 1, 0.25f});
    const Image image = draw(sphere, light, params);
    for (const auto& [u, v] : {std::array{0.0, 0.0}, {0.4, 0.3}, {-0.6, 0.2}, {0.1, -0.7}}) {
      const int x = static_cast<int>((0.5 + 0.47 * u) * kSize), y = static_cast<int>((0.5 - 0.47 * v) * kSize);
      const double nx = ((x + 0.5) / kSize - 0.5) / 0.47, ny = (0.5 - (y + 0.5) / kSize) / 0.47;
      const Rgb e = reconstruct(irradiance, {nx, ny, std::sqrt(1 - nx * nx - ny * ny)});
      const Rgb drawn = image.rgb(x, y);
      EXPECT_NEAR(drawn.r, 0.5 * e.r / std::numbers::pi, kShadingTolerance) << bands;
      EXPECT_NEAR(drawn.g, e.g / std::numbers::pi, kShadingTolerance) << bands;
      EXPECT_NEAR(drawn.b, 0.25 * e.b / std::numbers::pi, kShadingTolerance) << bands;
    }
  }
}

TEST_F(Render, WhiteFurnace) {
  // White in constant light cannot be seen, in whatever unit the light is.
  for (const double radiance : {1.0, 1e-7, 1e7})
    for (const int bands : {1, 2, 3, 5, 10})
      for (const bool picture : {false, true}) {
        Image background;
        if (picture) {
          background = Image(8, 4);
          std::fill(background.values.begin(), background.values.end(), static_cast<float>(radiance));
        }
        const RgbCoefficients light = constant_light(bands, {radiance, radiance, radiance});
        const Image image = draw(sphere_, light, test_params(20, 30), background);
        const auto [least, most] = std::minmax_element(image.values.begin(), image.values.end());
        EXPECT_NEAR(*least / radiance, 1, kHalfPrecision) << radiance << " " << bands << " " << picture;
        EXPECT_NEAR(*most / radiance, 1, kHalfPrecision) << radiance << " " << bands << " " << picture;
      }
}

// A delta light's irradiance of three bands is negative at about 105° to 130° from it: magenta there, and nowhere else.
TEST_F(Render, NegativeIrradianceIsMarked) {
  const RgbCoefficients light = delta_light(3, {0, 1, 0});
  const RgbCoefficients irradiance = irradiance_from_radiance(light);
  RenderParams params = test_params();
  params.camera.vertical_fov = 0.5;
  params.show_background = false;
  const Image plain = draw(sphere_, light, params);
  params.mark_negative = true;
  const Image marked = draw(sphere_, light, params);
  int striped = 0, negative = 0;
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) {
      const double nx = ((x + 0.5) / kSize - 0.5) / 0.47, ny = (0.5 - (y + 0.5) / kSize) / 0.47;
      if (nx * nx + ny * ny > 0.97) continue;
      const double e = reconstruct(irradiance, {nx, ny, std::sqrt(1 - nx * nx - ny * ny)}).g;
      const Rgb a = plain.rgb(x, y), b = marked.rgb(x, y);
      const bool magenta = b.g < 0.5 * b.r;
      if (e > 0.02) {
        EXPECT_EQ(a, b) << x << " " << y;
      }
      if (e < -0.02) ++negative, striped += magenta;
      EXPECT_GE(a.g, 0);
    }
  ASSERT_GT(negative, 100);
  EXPECT_NEAR(double(striped) / negative, 0.5, 0.1);
}

TEST_F(Render, TurningTheLightIsTurningItsCoefficients) {
  const RgbCoefficients light = delta_light(5, {0.48, 0.64, 0.6}, {1, 2, 3});
  for (const double degrees : {90.0, -35.0}) {
    RenderParams params = test_params(20, 10);
    params.rotate_light = rotation_about_y(degrees * std::numbers::pi / 180);
    const Image turned = draw(sphere_, light, params);
    params.rotate_light = {};
    const Rotation rotation = rotation_about_y(degrees * std::numbers::pi / 180);
    const Image expected = draw(sphere_, rotate(rotation, light), params);
    EXPECT_LT(max_difference(turned, expected), kShadingTolerance) << degrees;
    EXPECT_GT(max_difference(draw(sphere_, light, params), expected), 0.1) << "the turn is seen";
  }
}

TEST_F(Render, TurningTheLightWithTheCameraChangesNothing) {
  // Counter-clockwise from above both: the camera's azimuth goes from +Z to +X. A sphere hides its own turn.
  Image background(32, 16);
  for (int x = 0; x < 32; ++x)
    for (int y = 0; y < 16; ++y) background.set_rgb(x, y, {x / 32.0, y / 16.0, 1});
  const RgbCoefficients light = delta_light(4, {0.48, 0.64, 0.6});
  RenderParams params = test_params(10, 20);
  const Image before = draw(sphere_, light, params, background);
  params.camera.azimuth += 75;
  params.rotate_light = rotation_about_y(75 * std::numbers::pi / 180);
  EXPECT_LT(max_difference(draw(sphere_, light, params, background), before), kShadingTolerance);
}

TEST_F(Render, QuarterTurnOfTheLightIsAMovedPicture) {
  // Left-handed or right-handed: +Z goes to +X, so what was in the columns around the back comes to the right quarter.
  const int width = 64, height = 32;
  Image background(width, height), moved(width, height);
  for (int x = 0; x < width; ++x)
    for (int y = 0; y < height; ++y) background.set_rgb(x, y, {x % 16 < 8 ? 1.0 : 0.5, x / 64.0, y / 32.0});
  for (int x = 0; x < width; ++x)
    for (int y = 0; y < height; ++y) moved.set_rgb(x, y, background.rgb((x + width / 4) % width, y));
  RenderParams params = test_params(0, -15);
  const RgbCoefficients light = constant_light(3, {1, 1, 1});
  const Image expected = draw(sphere_, light, params, moved);
  params.rotate_light = rotation_about_y(std::numbers::pi / 2);
  EXPECT_LT(max_difference(draw(sphere_, light, params, background), expected), kShadingTolerance);
}

TEST_F(Render, InstancesAreTurnedStretchedAndMirroredWithTheirNormals) {
  const RgbCoefficients light = delta_light(3, {0.48, 0.64, 0.6});
  const Mat4f stretched = {1, 0, 0, 0, 0, 0.5f, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  const Mat4f mirrored = {-1, 0, 0, 0, 0, 0.5f, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  const Image expected = draw(make_test_scene(make_ellipsoid({1, 0.5, 1})), light, test_params());
  for (const Mat4f& to_world : {stretched, mirrored}) {
    const Scene scene = make_test_scene(make_ellipsoid({1, 1, 1}), {1, 1, 1}, to_world);
    // At the outline a sample may fall to the other side of an edge.
    const Image image = draw(scene, light, test_params());
    double sum = 0;
    for (std::size_t i = 0; i < image.values.size(); ++i) sum += std::abs(image.values[i] - expected.values[i]);
    EXPECT_LT(sum / static_cast<double>(image.values.size()), kHalfPrecision);
    EXPECT_LT(max_difference(image, expected), 0.05);
  }
}

TEST_F(Render, TrianglesHaveTwoSides) {
  const Scene square = make_test_scene(make_square());
  const int middle = kSize / 2;
  const RgbCoefficients behind = delta_light(3, {0, 0, -1});
  const double facing = reconstruct(irradiance_from_radiance(behind), {0, 0, -1}).g / std::numbers::pi;
  EXPECT_NEAR(draw(square, behind, test_params(180)).rgb(middle, middle).g, facing, kHalfPrecision);
  EXPECT_LT(draw(square, behind, test_params(0)).rgb(middle, middle).g, 0.1 * facing);
}

// Pixels that are brighter or darker than all eight around them, by so many of 255 steps.
int num_specks(const Image8& picture, int steps) {
  const auto value = [&](int x, int y, int c) {
    return int{picture.values[static_cast<std::size_t>(4 * (y * picture.width + x) + c)]};
  };
  int specks = 0;
  for (int y = 1; y + 1 < picture.height; ++y)
    for (int x = 1; x + 1 < picture.width; ++x)
      for (int c = 0; c < 3; ++c) {
        int low = 255, high = 0;
        for (int i = 0; i < 9; ++i) {
          if (i == 4) continue;
          const int v = value(x + i % 3 - 1, y + i / 3 - 1, c);
          low = std::min(low, v), high = std::max(high, v);
        }
        if (value(x, y, c) > high + steps || value(x, y, c) < low - steps) ++specks;
      }
  return specks;
}

// There, samples may lie off slivers of triangles, and the far side may show through.
TEST_F(Render, OutlinesDoNotSparkle) {
  const Scene sphere = make_scene("builtin:sphere");
  for (const auto& [azimuth, elevation] : {std::pair{30, 11}, {100, -20}, {200, 40}, {310, 5}}) {
    RenderParams params = test_params(azimuth, elevation);
    params.width = params.height = 500;
    params.show = Show::kNormals;
    EXPECT_EQ(num_specks(render_irradiance(sphere, {RgbCoefficients(1), {}}, params).picture, 20), 0) << azimuth;
  }
}

TEST_F(Render, TexturesAndVertexColorsMultiplyTheBaseColor) {
  // Four quarters: red at the top left, green at the top right, blue below, and grey.
  Scene scene = make_test_scene(make_square(), {0.5f, 0.5f, 0.5f});
  Image8 quarters = {16, 16, {}};
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) {
      constexpr unsigned char kColors[4][3] = {{255, 0, 0}, {0, 255, 0}, {0, 0, 255}, {128, 128, 128}};
      const auto& c = kColors[2 * (y / 8) + x / 8];
      quarters.values.insert(quarters.values.end(), {c[0], c[1], c[2], 255});
    }
  scene.textures = {quarters};
  scene.materials[0].texture = 0;
  RenderParams params = test_params();
  const RgbCoefficients light = constant_light(1, {1, 1, 1});
  const Image image = draw(scene, light, params);
  const int low = kSize / 3, high = kSize - 1 - low;
  const auto expect_near = [&image](int x, int y, Rgb expected) {
    const Rgb c = image.rgb(x, y);
    EXPECT_NEAR(c.r, expected.r, 0.02);
    EXPECT_NEAR(c.g, expected.g, 0.02);
    EXPECT_NEAR(c.b, expected.b, 0.02);
  };
  const double grey = 0.2158605;  // of sRGB 128
  expect_near(low, low, {0.5, 0, 0});
  expect_near(high, low, {0, 0.5, 0});
  expect_near(low, high, {0, 0, 0.5});
  expect_near(high, high, {0.5 * grey, 0.5 * grey, 0.5 * grey});

  Scene colored = make_test_scene(make_square(), {0.5f, 1, 1});
  colored.meshes[0].colors.assign(4, {0.5f, 0.25f, 1});
  const Rgb c = draw(colored, light, params).rgb(low, low);
  EXPECT_NEAR(c.r, 0.25, kHalfPrecision);
  EXPECT_NEAR(c.g, 0.25, kHalfPrecision);
  EXPECT_NEAR(c.b, 1, kHalfPrecision);
}

TEST_F(Render, ModelsOfAnySizeLookTheSame) {
  const RgbCoefficients light = delta_light(3, {0.48, 0.64, 0.6});
  const Image expected = draw(sphere_, light, test_params());
  for (const double size : {1e-18, 1e-6, 1e6, 1e18}) {
    const Scene scene = make_test_scene(make_ellipsoid({size, size, size}));
    EXPECT_LT(max_difference(draw(scene, light, test_params()), expected), 0.05) << size;
  }
}

TEST_F(Render, PictureIsTopRowFirstAndOpaque) {
  RenderParams params = test_params();
  params.show_background = false;
  const RenderResult result = render_irradiance(sphere_, {delta_light(3, {0, 1, 0}), {}}, params);
  ASSERT_EQ(result.picture.values.size(), 4u * kSize * kSize);
  const auto green = [&](int x, int y) { return result.picture.values[4 * (y * kSize + x) + 1]; };
  EXPECT_GT(green(kSize / 2, kSize / 5), green(kSize / 2, 4 * kSize / 5) + 50);
  EXPECT_EQ(green(0, 0), 0);
  EXPECT_EQ(result.picture.values[3], 255);
}

TEST_F(Render, SameInputSameBits) {
  const RenderLight light = {delta_light(4, {0.48, 0.64, 0.6}), {}};
  const RenderResult first = render_irradiance(sphere_, light, test_params(25, 5));
  RenderParams params = test_params(25, 5);
  params.bands = 3;
  params.frames = 3;
  const RenderResult second = render_irradiance(sphere_, light, params);
  EXPECT_EQ(first.picture.values, second.picture.values) << "frames for timing change nothing";
  EXPECT_EQ(first.radiance.values, second.radiance.values);
  EXPECT_GT(second.frame_ms, 0);
  EXPECT_FALSE(second.gl_renderer.empty());
}

TEST_F(Render, NothingToSeeIsNoError) {
  const RgbCoefficients black(3);
  for (const Scene& scene : {Scene(), sphere_})
    for (const float value : render_irradiance(scene, {black, {}}, test_params()).radiance.values) ASSERT_EQ(value, 0);
  const Image lit = draw(Scene(), constant_light(3, {2, 2, 2}), test_params());
  EXPECT_NEAR(lit.rgb(3, 3).g, 2, 2 * kHalfPrecision);
}

TEST_F(Render, RefusesWhatTheDeviceCannotDraw) {
  RenderParams params;
  params.width = 1 << 20;
  try {
    render_irradiance(sphere_, {constant_light(3, {1, 1, 1}), {}}, params);
    FAIL() << "no Error";
  } catch (const Error& error) {
    EXPECT_TRUE(
        std::string(error.what()).starts_with("OpenGL: a picture of 1048576x720 pixels cannot be drawn: 1x1 to "))
        << error.what();
  }
}

TEST_F(Render, StopsWhenAskedTo) {
  RenderParams params = test_params();
  params.frames = 10;
  int calls = 0;
  const auto stop_at_third = [&calls](double) { return ++calls < 3; };
  EXPECT_THROW(render_irradiance(sphere_, {constant_light(3, {1, 1, 1}), {}}, params, stop_at_third), Cancelled);
  EXPECT_EQ(calls, 3);
}

}  // namespace
}  // namespace shlight
