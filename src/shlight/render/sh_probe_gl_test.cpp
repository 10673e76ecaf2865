#include "shlight/render/sh_probe.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "shlight/render/render_test_util.h"
#include "shlight/render/sh_glsl.h"
#include "shlight/sh/zonal.h"

namespace shlight {
namespace {

// Of the largest value: 100 products of floats with 6e-8 each.
constexpr double kTolerance = 1e-5;

RgbCoefficients random_light(int bands) {
  std::mt19937 random(20010812u + static_cast<unsigned>(bands));
  std::uniform_real_distribution<double> value(-1, 1);
  RgbCoefficients light(bands);
  for (Rgb& c : light.values()) c = {value(random), value(random), value(random)};
  return light;
}

std::vector<Vec3d> test_directions() {
  std::vector<Vec3d> directions = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (int i = 0; i < 2000; ++i) directions.push_back(spiral_direction(i, 2000));
  return directions;
}

// The largest difference of `drawn` from Σ c_i Y_i, relative to the largest value.
double relative_error(const std::vector<Vec3d>& directions, const std::vector<Rgb>& drawn, const RgbCoefficients& c) {
  double largest = 0, error = 0;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const Rgb expected = reconstruct(c, directions[i]), difference = drawn[i] - expected;
    largest = std::max({largest, std::abs(expected.r), std::abs(expected.g), std::abs(expected.b)});
    error = std::max({error, std::abs(difference.r), std::abs(difference.g), std::abs(difference.b)});
  }
  return error / largest;
}

class ShProbe : public GlTest {};

TEST_F(ShProbe, IrradianceIsTheSumInDouble) {
  const std::vector<Vec3d> normals = test_directions();
  for (int bands = 1; bands <= kMaxGlslBands; ++bands) {
    const RgbCoefficients light = random_light(bands);
    const double error = relative_error(normals, draw_irradiance_at(normals, light), irradiance_from_radiance(light));
    EXPECT_LT(error, kTolerance) << bands << " bands";
    RecordProperty("irradiance_error_" + std::to_string(bands), std::to_string(error));
  }
}

TEST_F(ShProbe, RadianceIsTheSumInDouble) {
  const std::vector<Vec3d> directions = test_directions();
  for (int bands = 1; bands <= kMaxGlslBands; ++bands) {
    const RgbCoefficients light = random_light(bands);
    EXPECT_LT(relative_error(directions, draw_radiance_at(directions, light), light), kTolerance) << bands << " bands";
  }
}

TEST_F(ShProbe, NoDirectionsNoValues) {
  EXPECT_TRUE(draw_irradiance_at({}, random_light(3)).empty());
}

TEST_F(ShProbe, TwoContextsMayLiveOneAfterTheOther) {
  const std::vector<Vec3d> up = {{0, 1, 0}};
  const RgbCoefficients light = random_light(3);
  const std::vector<Rgb> first = draw_irradiance_at(up, light);
  context_.reset();
  context_.emplace();
  EXPECT_FALSE(gl_renderer().empty());
  EXPECT_EQ(draw_irradiance_at(up, light), first);
}

}  // namespace
}  // namespace shlight
