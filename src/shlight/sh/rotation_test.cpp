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

TEST(Rotation, CommutesWithEvaluationTo1e12At32Bands) {
  const Rotation rotation = oblique_rotation();
  const RgbCoefficients light = some_light(32);
  const RgbCoefficients turned = rotate(rotation, light);
  double scale = 0;
  for (const Rgb c : light.values()) scale += c.g * c.g;
  for (const Vec3d d : make_sphere_samples(0, 5, 7).directions)
    EXPECT_NEAR(reconstruct(turned, rotation(d)).g, reconstruct(light, d).g, 1e-12 * std::sqrt(scale));
}

TEST(Rotation, CommutesWithEvaluationTo64Bands) {
  const Rotation rotation = oblique_rotation();
  const RgbCoefficients light = some_light(64);
  const RgbCoefficients turned = rotate(rotation, light);
  double scale = 0;
  for (const Rgb c : light.values()) scale += c.g * c.g;
  for (const Vec3d d : make_sphere_samples(0, 3, 7).directions)
    EXPECT_NEAR(reconstruct(turned, rotation(d)).g, reconstruct(light, d).g, 1e-11 * std::sqrt(scale));
}

TEST(Rotation, TwelveTurnsOf30DegreesReturn) {
  const RgbCoefficients light = some_light(10);
  const RotationMatrix step(10, rotation_about_y(pi / 6));
  RgbCoefficients turned = light;
  for (int i = 0; i < 12; ++i) turned = rotate(step, turned);
  for (std::size_t i = 0; i < light.size(); ++i) EXPECT_NEAR(turned[i].r, light[i].r, 1e-13);
}

double largest_difference(const RgbCoefficients& a, const RgbCoefficients& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    largest = std::max({largest, std::abs(a[i].r - b[i].r), std::abs(a[i].g - b[i].g), std::abs(a[i].b - b[i].b)});
  return largest;
}

TEST(Rotation, MatricesComposeAndInvert) {
  const RgbCoefficients light = some_light(32);
  const Rotation a = oblique_rotation(), b = rotation_zyz(0.4, 2.1, -1.3);
  EXPECT_LT(largest_difference(rotate(a * b, light), rotate(a, rotate(b, light))), 1e-12);
  EXPECT_LT(largest_difference(rotate(inverse(a), rotate(a, light)), light), 1e-12);
}

TEST(Rotation, EveryWayToNameARotation) {
  const Rotation zyz = rotation_zyz(0.4, 2.1, -1.3);
  EXPECT_TRUE(is_rotation(zyz, 1e-14));
  EXPECT_FALSE(is_rotation({{Vec3d{1, 0, 0}, Vec3d{0, 0, 1}, Vec3d{0, 1, 0}}}));  // a mirror
  EXPECT_FALSE(is_rotation({{Vec3d{2, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}}}));
  // 1.1 radians about (2, −1, 2)/3, of a length that does not matter.
  const double c = 5 * std::cos(0.55), s = 5 * std::sin(0.55);
  const Rotation quaternion = rotation_from_quaternion(c, s * 2 / 3, -s / 3, s * 2 / 3), expected = oblique_rotation();
  for (const Vec3d d : make_sphere_samples(0, 3, 5).directions) {
    EXPECT_NEAR(dot(quaternion(d) - expected(d), quaternion(d) - expected(d)), 0, 1e-28);
    const Vec3d by_steps = rotation_about_z(0.4)(rotation_about_y(2.1)(rotation_about_z(-1.3)(d)));
    EXPECT_NEAR(dot(zyz(d) - by_steps, zyz(d) - by_steps), 0, 1e-28);
  }
}

TEST(Rotation, AboutZWithoutAMatrix) {
  const RgbCoefficients light = some_light(20);
  EXPECT_LT(largest_difference(rotate_about_z(0.7, light), rotate(rotation_about_z(0.7), light)), 1e-13);
}

TEST(Rotation, ManyAtOnceInFloatCommuteWithEvaluation) {
  for (const int bands : {1, 2, 3, 5, 8, 32})
    for (const std::size_t count :
         {std::size_t{1}, std::size_t{16}, std::size_t{17}, std::size_t{37}, std::size_t{64}}) {
      const RotationMatrix matrix(bands, oblique_rotation());
      const auto size = static_cast<std::size_t>(num_coefficients(bands));
      std::vector<float> values(size * count), result(values.size());
      for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(std::sin(double(i * i % 1009)));
      rotate(matrix, values, result, count);
      for (std::size_t j = 0; j < count; ++j) {
        RgbCoefficients one(bands);
        for (std::size_t i = 0; i < size; ++i) one[i] = {values[i * count + j], 0, 0};
        const RgbCoefficients turned = rotate(matrix, one);
        for (std::size_t i = 0; i < size; ++i)
          EXPECT_NEAR(result[i * count + j], turned[i].r, 1e-6) << bands << " bands, coefficient " << i;
      }
    }
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
