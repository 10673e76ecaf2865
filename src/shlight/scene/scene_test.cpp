#include "shlight/scene/scene.h"

#include <gtest/gtest.h>

#include "shlight/scene/scene_test_util.h"
#include "shlight/scene/shapes.h"
#include "shlight/scene/transform.h"

namespace shlight {
namespace {

constexpr float kNearlyEqual = 1e-5f;

void expect_near(Vec3f a, Vec3f b) {
  EXPECT_NEAR(a.x, b.x, kNearlyEqual);
  EXPECT_NEAR(a.y, b.y, kNearlyEqual);
  EXPECT_NEAR(a.z, b.z, kNearlyEqual);
}

const Mat4f kSome =
    multiply(make_translation({1, -2, 3}), multiply(make_rotation({1, 2, -1}, 40), make_scaling({2, 0.5f, 3})));

TEST(Transform, ProductAppliesTheRightFactorFirst) {
  const Mat4f other = multiply(make_rotation({0, 1, 0}, 70), make_translation({0, 1, 0}));
  const Vec3f p = {0.3f, -0.7f, 2};
  expect_near(transform_point(multiply(kSome, other), p), transform_point(kSome, transform_point(other, p)));
  EXPECT_NEAR(determinant(multiply(kSome, other)), determinant(kSome) * determinant(other), kNearlyEqual);
}

TEST(Transform, RotationIsCounterClockwiseSeenFromTheTip) {
  expect_near(transform_point(make_rotation({0, 0, 5}, 90), {1, 0, 0}), {0, 1, 0});
  expect_near(transform_point(make_rotation({0, 1, 0}, 90), {0, 0, 1}), {1, 0, 0});
  EXPECT_NEAR(determinant(make_rotation({3, 1, 2}, 123)), 1, kNearlyEqual);
  const Rotation turned = rotation_zyz(0.4, 1.1, -0.7);
  expect_near(transform_point(make_rotation(turned), {1, -2, 3}), vec_cast<float>(turned({1, -2, 3})));
}

// A normal stays perpendicular to the surface and on its outside, whatever the matrix does, mirroring included.
TEST(Transform, NormalsStayNormal) {
  const Vec3f tangent = {1, 2, 0.5f}, bitangent = {-1, 0.3f, 1};
  const Vec3f normal = cross(tangent, bitangent);
  for (const Mat4f& m : {kSome, multiply(kSome, make_scaling({-1, 1, 1}))}) {
    const Vec3f n = transform_normal(m, normal);
    EXPECT_NEAR(dot(n, transform_vector(m, tangent)), 0, kNearlyEqual);
    EXPECT_NEAR(dot(n, transform_vector(m, bitangent)), 0, kNearlyEqual);
    EXPECT_NEAR(dot(n, n), 1, kNearlyEqual);
    EXPECT_GT(dot(n, transform_vector(m, normal)), 0);
  }
}

TEST(Transform, FlattenedNormalIsZero) {
  EXPECT_EQ(transform_normal(make_scaling({1, 0, 0}), {1, 0, 0}), Vec3f{});
}

TEST(Scene, EmptySceneHasNoBounds) {
  EXPECT_FALSE(world_bounds(Scene{}));
  EXPECT_EQ(num_triangles(Scene{}), 0u);
  EXPECT_EQ(num_vertices(Scene{}), 0u);
}

TEST(Scene, InstancesCountEachTime) {
  Scene scene;
  scene.meshes = {make_sphere(1, 8)};
  scene.materials = {{}};
  scene.instances = {{0, make_translation({10, 0, 0})}, {0, make_scaling({1, 2, 3})}};
  expect_valid(scene);
  EXPECT_EQ(num_triangles(scene), 2 * scene.meshes[0].indices.size() / 3);
  EXPECT_EQ(num_vertices(scene), 2 * scene.meshes[0].positions.size());
  const Bounds bounds = world_bounds(scene).value();
  expect_near(bounds.min, {-1, -2, -3});
  expect_near(bounds.max, {11, 2, 3});
}

}  // namespace
}  // namespace shlight
