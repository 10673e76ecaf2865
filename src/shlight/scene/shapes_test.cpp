#include "shlight/scene/shapes.h"

#include <gtest/gtest.h>

#include <numbers>

#include "shlight/scene/scene_test_util.h"

namespace shlight {
namespace {

constexpr double kPi = std::numbers::pi;

void expect_closed(const Mesh& mesh, int euler_characteristic) {
  expect_valid(mesh);
  const Topology t = topology(mesh);
  EXPECT_TRUE(t.is_closed);
  EXPECT_EQ(t.euler_characteristic, euler_characteristic);
}

TEST(Shapes, SphereIsOne) {
  const Mesh sphere = make_sphere(1.5f, 64);
  expect_closed(sphere, 2);
  EXPECT_EQ(sphere.positions.size(), 2u + 63 * 128);
  EXPECT_EQ(sphere.indices.size() / 3, 2u * 128 * 63);
  // An inscribed polyhedron lacks a part of the second order in the step.
  const double volume = 4 * kPi / 3 * 1.5 * 1.5 * 1.5;
  EXPECT_LT(signed_volume(sphere), volume);
  EXPECT_NEAR(signed_volume(sphere), volume, 2e-3 * volume);
  EXPECT_GT(least_normal_agreement(sphere), 0.999);
  for (std::size_t i = 0; i < sphere.positions.size(); ++i) {
    const Vec3f d = sphere.positions[i] - 1.5f * sphere.normals[i];
    EXPECT_LT(dot(d, d), 1e-12f);
  }
}

TEST(Shapes, CoarsestSphereIsClosed) {
  expect_closed(make_sphere(1, 2), 2);
}

TEST(Shapes, TorusKnotIsATorus) {
  const TorusKnotParams params;
  const Mesh knot = make_torus_knot(params);
  expect_closed(knot, 0);
  EXPECT_GT(least_normal_agreement(knot), 0.99);
  // A tube that nowhere meets itself has the volume of its cross section times its length.
  double length = 0;
  constexpr int kSteps = 4096;
  for (int i = 0; i < kSteps; ++i) {
    const double t = 2 * kPi * i / kSteps, distance = 2 + std::cos(3 * t);
    length += std::sqrt(9 + 4 * distance * distance) * 2 * kPi / kSteps;
  }
  const double volume = kPi * params.tube * params.tube * length;
  EXPECT_NEAR(signed_volume(knot), volume, 5e-3 * volume);
}

TEST(Shapes, RoundedBoxIsABoxWithoutItsEdges) {
  const double a = 1.0, b = 0.6, c = 0.4, r = 0.1;
  const Mesh box = make_rounded_box({1.0f, 0.6f, 0.4f}, 0.1f, 8, 0.1f);
  expect_closed(box, 2);
  EXPECT_GT(least_normal_agreement(box), 0.99);
  // Steiner: the inner box, its sides and edges swept outwards by r, and a ball.
  const double x = a - 2 * r, y = b - 2 * r, z = c - 2 * r;
  const double volume =
      x * y * z + 2 * r * (x * y + y * z + z * x) + kPi * r * r * (x + y + z) + 4 * kPi / 3 * r * r * r;
  EXPECT_NEAR(signed_volume(box), volume, 2e-3 * volume);
}

TEST(Shapes, RoundingUpToHalfTheSizeMakesABall) {
  const Mesh ball = make_rounded_box({2, 2, 2}, 1, 12, 1);
  expect_valid(ball);
  EXPECT_NEAR(signed_volume(ball), 4 * kPi / 3, 0.02 * 4 * kPi / 3);
}

TEST(Shapes, TurnedCylinderHasItsVolume) {
  const OutlineCorner outline[] = {{0, -0.5f}, {0.7f, -0.5f, 1e-3f}, {0.7f, 0.5f, 1e-3f}, {0, 0.5f}};
  const Mesh cylinder = make_turned(outline, 256, 0.1f);
  expect_closed(cylinder, 2);
  EXPECT_NEAR(signed_volume(cylinder), kPi * 0.49, 1e-3);
}

TEST(Shapes, TurnedBowlIsClosedAndHollow) {
  const OutlineCorner outline[] = {{0, 0},           {1, 0, 0.3f},        {1, 1, 0.04f},
                                   {0.9f, 1, 0.04f}, {0.9f, 0.1f, 0.25f}, {0, 0.1f}};
  const Mesh bowl = make_turned(outline, 128, 0.05f);
  expect_closed(bowl, 2);
  EXPECT_GT(least_normal_agreement(bowl), 0.98);
  EXPECT_NEAR(signed_volume(bowl), kPi * (1 - 0.81 * 0.9), 0.1);
}

}  // namespace
}  // namespace shlight
