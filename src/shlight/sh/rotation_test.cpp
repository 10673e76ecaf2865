#include "shlight/sh/rotation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "shlight/sh/basis.h"
#include "shlight/sh/sphere_samples.h"

namespace shlight {
namespace {

using std::numbers::pi;

// A rotation that is nothing special: 1.1 radians about (2, −1, 2)/3 (Rodrigues).
Rotation oblique_rotation() {
  const Vec3d k = {2.0 / 3, -1.0 / 3, 2.0 / 3};
  const double c = std::cos(1.1), s = std::sin(1.1);
  const auto turned = [&](Vec3d v) { return c * v + s * cross(k, v) + (1 - c) * dot(k, v) * k; };
  const Vec3d x = turned({1, 0, 0}), y = turned({0, 1, 0}), z = turned({0, 0, 1});
  return {{Vec3d{x.x, y.x, z.x}, Vec3d{x.y, y.y, z.y}, Vec3d{x.z, y.z, z.z}}};
}

RgbCoefficients some_light(int bands) {
  RgbCoefficients light(bands);
  for (std::size_t i = 0; i < light.size(); ++i)
    light[i] = {std::sin(3.7 * double(i)), std::cos(1.3 * double(i)), std::sin(double(i * i))};
  return light;
}

TEST(Rotation, TurnsADeltaToItsNewDirection) {
  const Rotation rotation = oblique_rotation();
  for (const Vec3d d : make_sphere_samples(0, 4, 5).directions) {
    RgbCoefficients before(12), expected(12);
    add_delta(d, {1, 0, 0}, before);
    add_delta(rotation(d), {1, 0, 0}, expected);
    const RgbCoefficients after = rotate(rotation, before);
    for (std::size_t i = 0; i < after.size(); ++i) EXPECT_NEAR(after[i].r, expected[i].r, 1e-13) << "coefficient " << i;
  }
}

TEST(Rotation, CommutesWithEvaluationTo64Bands) {
  const Rotation rotation = oblique_rotation();
  const RgbCoefficients light = some_light(64);
  const RgbCoefficients turned = rotate(rotation, light);
  for (const Vec3d d : make_sphere_samples(0, 3, 7).directions)
    EXPECT_NEAR(reconstruct(turned, rotation(d)).g, reconstruct(light, d).g, 1e-10);
}

TEST(Rotation, TwelveTurnsOf30DegreesReturn) {
  const RgbCoefficients light = some_light(10);
  const RotationMatrix step(10, rotation_about_y(pi / 6));
  RgbCoefficients turned = light;
  for (int i = 0; i < 12; ++i) turned = rotate(step, turned);
  for (std::size_t i = 0; i < light.size(); ++i) EXPECT_NEAR(turned[i].r, light[i].r, 1e-13);
}

// docs/conventions.md, "Other conventions".
TEST(Rotation, ToZUpIsTheDocumentedTable) {
  const Rotation z_up = {{Vec3d{1, 0, 0}, Vec3d{0, 0, -1}, Vec3d{0, 1, 0}}};
  EXPECT_EQ(z_up({.36, .48, .80}), (Vec3d{.36, -.80, .48}));
  const RgbCoefficients light = some_light(3);
  const auto c = [&](std::size_t i) { return light[i].r; };
  const double half_root_3 = std::sqrt(3.0) / 2;
  const double documented[9] = {
      c(0), -c(2), c(1), c(3), -c(7), -c(5), -c(6) / 2 - half_root_3 * c(8), c(4), -half_root_3 * c(6) + c(8) / 2};
  const RgbCoefficients turned = rotate(z_up, light);
  for (std::size_t i = 0; i < 9; ++i) EXPECT_NEAR(turned[i].r, documented[i], 1e-15) << "coefficient " << i;
}

TEST(Rotation, AboutYTakesZToX) {
  const Vec3d v = rotation_about_y(pi / 2)({0, 0, 1});
  EXPECT_NEAR(v.x, 1, 1e-15);
  EXPECT_NEAR(v.y, 0, 1e-15);
  EXPECT_NEAR(v.z, 0, 1e-15);
}

}  // namespace
}  // namespace shlight
