#include "shlight/light/sun.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <numbers>
#include <string>
#include <vector>

#include "shlight/image/pixels.h"
#include "shlight/light/builtin_light.h"
#include "shlight/light/project_image.h"
#include "shlight/sh/basis.h"
#include "shlight/sh/kernel.h"
#include "shlight/sh/minimum.h"
#include "shlight/sh/zonal.h"

namespace shlight {
namespace {

using std::numbers::pi;

constexpr double kDegree = pi / 180;

Vec3d direction_from(double azimuth_degrees, double elevation_degrees) {
  const double a = azimuth_degrees * kDegree, e = elevation_degrees * kDegree;
  return {std::cos(e) * std::sin(a), std::sin(e), -std::cos(e) * std::cos(a)};
}

double degrees_between(Vec3d a, Vec3d b) {
  const Vec3d c = cross(a, b);
  return std::atan2(std::sqrt(dot(c, c)), dot(a, b)) / kDegree;
}

Environment picture_of(const Light& light, int width) {
  return {light.lat_long(width), Layout::kLatLong};
}

Rgb flux_of(const Environment& environment) {
  Rgb flux;
  const PixelQuadrature quadrature(environment.layout, environment.size(), 2);
  for (int y = 0; y < environment.image.height; ++y)
    for (int x = 0; x < environment.image.width; ++x)
      flux += quadrature.solid_angle({x, y}) * environment.image.rgb(x, y);
  return flux;
}

// A sky that brightens upward and toward the sun, ground below, and a disc in it.
FunctionLight some_sky(Vec3d sun, double half_angle, double irradiance) {
  const auto sky = [sun](Vec3d d) {
    const double glow = std::exp(8 * (dot(d, sun) - 1));
    return d.y > 0 ? (1 + d.y + 3 * glow) * Rgb{0.4, 0.5, 0.7} : Rgb{0.2, 0.2, 0.1};
  };
  const double radiance = irradiance / (4 * pi * std::pow(std::sin(half_angle / 2), 2));
  return FunctionLight(sky, {{sun, half_angle, radiance * Rgb{1, 0.9, 0.7}}});
}

// A sun within one pixel cannot be placed in it: that is 0.12° at 512 pixels.
TEST(Sun, TheSameAtEveryResolution) {
  for (const auto& [elevation, azimuth] : {std::pair{30.0, -125.0}, {7.0, 179.97}, {62.3, 33.1}, {89.6, 10.0}}) {
    SkyParams params;
    params.elevation = elevation, params.azimuth = azimuth;
    const auto sky = make_sky_light(params);
    const Sun exact = sky->split_sun()->sun;
    EXPECT_LT(degrees_between(exact.direction, direction_from(azimuth, elevation)), 1e-10);
    for (const int width : elevation == 30 ? std::vector{512, 1024, 2048} : std::vector{512, 1024}) {
      Environment picture = picture_of(*sky, width);
      const auto sun = split_sun(picture);
      ASSERT_TRUE(sun) << width;
      EXPECT_LT(degrees_between(sun->direction, exact.direction), width == 512 ? 0.13 : 0.03) << width;
      // The model's glow within the aperture counts as sun in pictures.
      EXPECT_NEAR(sun->irradiance.r / exact.irradiance.r, 1, 0.01) << width;
      EXPECT_NEAR(sun->irradiance.g / exact.irradiance.g, 1, 0.01) << width;
      EXPECT_NEAR(sun->irradiance.b / exact.irradiance.b, 1, 0.01) << width;
    }
  }
}

TEST(Sun, TheSameInEveryLayout) {
  const Vec3d direction = direction_from(-70, 25);
  const FunctionLight sky = some_sky(direction, kSunHalfAngle, 5);
  for (const Layout layout : all_layouts()) {
    Environment picture{sky.picture({layout, size_from_horizon(layout, 1024)}, {}), layout};
    const auto sun = split_sun(picture);
    ASSERT_TRUE(sun) << layout_name(layout);
    EXPECT_LT(degrees_between(sun->direction, direction), 0.05) << layout_name(layout);
    // Pictures hold a disc of a pixel's size to about 0.5 %; 1 % of the sky's glow is in the aperture.
    EXPECT_NEAR(sun->irradiance.r, 5, 0.1) << layout_name(layout);
  }
}

// What is taken away and what is left are what was there, to the rounding of a sum over half a million pixels.
TEST(Sun, NothingIsLost) {
  Environment picture = picture_of(some_sky(direction_from(20, 40), kSunHalfAngle, 5), 1024);
  const Environment before = picture;
  const auto sun = split_sun(picture);
  ASSERT_TRUE(sun);
  const Rgb was = flux_of(before), is = flux_of(picture) + sun->irradiance;
  EXPECT_NEAR(is.r / was.r, 1, 1e-10);
  EXPECT_NEAR(is.g / was.g, 1, 1e-10);
  EXPECT_NEAR(is.b / was.b, 1, 1e-10);
  // Together they light as the picture does: apart by what 1.5° around the middle of the sun can do, l² · 1e-4.
  RgbCoefficients both = project_image(picture, 5);
  add_sun(*sun, both);
  const RgbCoefficients whole = project_image(before, 5);
  for (std::size_t i = 0; i < both.size(); ++i) EXPECT_NEAR(both[i].g, whole[i].g, 1e-3 * whole[0].g) << i;
}

// Where the sun was, the sky goes on: no hole, no rim, no change anywhere else.
TEST(Sun, TheSkyGoesOnBehindIt) {
  const Vec3d direction = direction_from(20, 40);
  const FunctionLight with = some_sky(direction, kSunHalfAngle, 50), without = some_sky(direction, kSunHalfAngle, 0);
  Environment picture = picture_of(with, 1024);
  const Environment before = picture, expected = picture_of(without, 1024);
  ASSERT_TRUE(split_sun(picture));
  for (int y = 0; y < 512; ++y)
    for (int x = 0; x < 1024; ++x) {
      const Rgb here = picture.image.rgb(x, y);
      const double angle =
          degrees_between(*direction_at(Layout::kLatLong, {(x + .5) / 1024, (y + .5) / 512}), direction);
      if (angle > 3.2)
        EXPECT_EQ(here, before.image.rgb(x, y));
      else  // the glow, e^{8 (cos θ − 1)}, falls by 4 % to the ring
        EXPECT_NEAR(here.g / expected.image.rgb(x, y).g, 1, 0.04) << angle;
    }
  // The rest no longer rings: without the sun, irradiance of three bands is certified positive.
  RgbCoefficients whole = irradiance_from_radiance(project_image(before, 3));
  RgbCoefficients rest = irradiance_from_radiance(project_image(picture, 3));
  const auto least = [](const RgbCoefficients& c) {
    std::vector<double> green;
    for (const Rgb v : c.values()) green.push_back(v.g);
    return find_minimum(green, c.bands());
  };
  EXPECT_LT(least(whole).value, 0);
  EXPECT_GT(least(rest).lower_bound, 0);
}

// What people see in them: a high sun over a city, a street lamp at night, the last of a sun behind trees; lamps with
// shades, the sky between houses and clouds are no suns.
TEST(Sun, OfRealMaps) {
  const char* data = std::getenv("SHLIGHT_TEST_DATA");
  if (!data) GTEST_SKIP() << "SHLIGHT_TEST_DATA names no folder";
  struct Case {
    const char* name;
    double azimuth, elevation, irradiance;  // 0: none
  };
  for (const auto& [name, azimuth, elevation, irradiance] : {Case{"blender_city.exr", 35.97, 47.80, 2.95},
                                                             {"blender_night.exr", -78.35, 6.41, 0.367},
                                                             {"polyhaven_1k_sunset.hdr", 35.99, 3.19, 0.0218},
                                                             {"blender_studio.exr", 0, 0, 0},
                                                             {"polyhaven_1k_studio.hdr", 0, 0, 0},
                                                             {"polyhaven_1k_city.hdr", 0, 0, 0},
                                                             {"polyhaven_1k_venice.hdr", 0, 0, 0}}) {
    const auto split = load_light(std::string(data) + "/lights/" + name).light->split_sun();
    ASSERT_EQ(split.has_value(), irradiance > 0) << name;
    if (!split) continue;
    EXPECT_LT(degrees_between(split->sun.direction, direction_from(azimuth, elevation)), 0.02) << name;
    EXPECT_NEAR(split->sun.irradiance.g / irradiance, 1, 0.01) << name;
  }
}

TEST(Sun, WideFaintOrManySourcesAreNone) {
  for (const char* name : {"studio", "axes", "thesis", "sky:elevation=0,turbidity=10"}) {
    const auto light = make_builtin_light(name);
    EXPECT_FALSE(light->split_sun()) << name;
    Environment picture = picture_of(*light, 512);
    const Environment before = picture;
    EXPECT_FALSE(split_sun(picture)) << name;
    EXPECT_EQ(picture.image.values, before.image.values);
  }
  // As small as a sun, but too faint; bright, but too wide.
  Environment faint = picture_of(some_sky(direction_from(20, 40), kSunHalfAngle, 0.02), 1024);
  EXPECT_FALSE(split_sun(faint));
  for (const double degrees : {2.7, 4.0, 8.0, 30.0}) {
    Environment lamp = picture_of(some_sky(direction_from(20, 40), degrees * kDegree, 5), 1024);
    EXPECT_FALSE(split_sun(lamp)) << degrees;
  }
  Environment black{Image(64, 32), Layout::kLatLong};
  EXPECT_FALSE(split_sun(black));
}

// A red sun in a blue sky: no channel gets more light than it had.
TEST(Sun, AChannelWithoutSunStaysAsItIs) {
  const Vec3d direction = direction_from(20, 3);
  const FunctionLight light([](Vec3d) { return Rgb{0.1, 0.2, 1}; }, {{direction, kSunHalfAngle, {2000, 300, 0}}});
  Environment picture = picture_of(light, 1024);
  // The disc is dark in blue, where the sky is bright.
  for (int y = 0; y < 512; ++y)
    for (int x = 0; x < 1024; ++x) {
      Rgb c = picture.image.rgb(x, y);
      if (c.r > 0.2) c.b = 0.5, picture.image.set_rgb(x, y, c);
    }
  const auto sun = split_sun(picture);
  ASSERT_TRUE(sun);
  EXPECT_GT(sun->irradiance.r, 0);
  EXPECT_EQ(sun->irradiance.b, 0);
}

TEST(Sun, OfCoefficientsIsExactForADeltaAndAConstant) {
  const Sun exact = {direction_from(50, 20), {3, 2, 1}};
  for (const int bands : {3, 4, 7, 12}) {
    RgbCoefficients light(bands);
    light[0] = {1, 2, 3};
    const RgbCoefficients constant = light;
    add_sun(exact, light);
    const auto sun = split_sun(light);
    ASSERT_TRUE(sun) << bands;
    EXPECT_LT(degrees_between(sun->direction, exact.direction), 1e-6) << bands;
    EXPECT_NEAR(sun->irradiance.r, 3, 1e-9);
    EXPECT_NEAR(sun->irradiance.b, 1, 1e-9);
    for (std::size_t i = 0; i < light.size(); ++i) EXPECT_NEAR(light[i].g, constant[i].g, 1e-8) << i;
  }
}

TEST(Sun, OfCoefficientsAndTheRestAreTheLight) {
  for (const int bands : {3, 5, 10}) {
    const RgbCoefficients light = make_sky_light({})->project(bands);
    RgbCoefficients rest = light;
    const auto sun = split_sun(rest);
    ASSERT_TRUE(sun) << bands;
    // The sky's own brightness pulls it up; the more bands, the less.
    EXPECT_LT(degrees_between(sun->direction, direction_from(-125, 30)), bands == 10 ? 0.5 : 2.5);
    EXPECT_NEAR(sun->irradiance.g, 7.0, bands == 10 ? 0.4 : 1.6);
    add_sun(*sun, rest);
    for (std::size_t i = 0; i < light.size(); ++i) EXPECT_NEAR(rest[i].g, light[i].g, 1e-14 * light[0].g);
  }
}

TEST(Sun, OfCoefficientsOfSoftLightsIsNone) {
  for (const char* name : {"studio", "axes", "thesis"})
    for (const int bands : {1, 2, 3, 5, 10}) {
      RgbCoefficients c = make_builtin_light(name)->project(bands);
      const RgbCoefficients before = c;
      EXPECT_FALSE(split_sun(c)) << name << " " << bands;
      EXPECT_EQ(c, before);
    }
  RgbCoefficients constant(5);
  constant[0] = {1, 1, 1};
  EXPECT_FALSE(split_sun(constant));
  // A clamped cosine is as soft as a light with one direction can be.
  RgbCoefficients cosine(5);
  add_zonal(make_cosine_power_kernel(5, 1), {0, 1, 0}, {1, 1, 1}, cosine);
  EXPECT_FALSE(split_sun(cosine));
}

}  // namespace
}  // namespace shlight
