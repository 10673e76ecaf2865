#include "shlight/transfer/gltf_nodes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "shlight/scene/transform.h"

namespace shlight {
namespace {

Vec3d rotate(const std::array<double, 4>& q, Vec3d v) {
  const Vec3d axis = {q[0], q[1], q[2]};
  return v + 2.0 * cross(axis, cross(axis, v) + q[3] * v);
}

Vec3d apply(const Trs& trs, Vec3d p) {
  return trs.translation + rotate(trs.rotation, {trs.scale.x * p.x, trs.scale.y * p.y, trs.scale.z * p.z});
}

TEST(GltfNodes, TurnedAndScaledIsTrsAndShearedIsNot) {
  const Mat4f turned = make_rotation({1, 2, 3}, 77), scaled = make_scaling({.5f, 2, 3});
  EXPECT_TRUE(is_trs(kIdentity));
  EXPECT_TRUE(is_trs(multiply(make_translation({1, 2, 3}), multiply(turned, scaled))));
  EXPECT_FALSE(is_trs(multiply(scaled, turned)));
}

// Rotations of unit length whose composition is the matrix, also where it is nearly flat or three scales are equal.
TEST(GltfNodes, TwoNodesAreTheMatrix) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> uniform(-1, 1);
  const auto vector = [&] { return Vec3f{uniform(random), uniform(random), uniform(random)}; };
  for (int round = 0; round < 200; ++round) {
    const float thin = round % 3 == 0 ? 1 : round % 3 == 1 ? 2.5f : 1e-4f;
    Mat4f m =
        multiply(make_rotation(vector(), 180 * uniform(random)), make_scaling({1, thin, round % 2 ? 1.0f : 3.0f}));
    m = multiply(make_translation(vector()), multiply(m, make_rotation(vector(), 180 * uniform(random))));
    const auto [outer, inner] = split_into_trs(m);
    for (const auto& q : {outer.rotation, inner.rotation})
      EXPECT_NEAR(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3], 1, 1e-12);
    EXPECT_GT(std::min({outer.scale.x, outer.scale.y, outer.scale.z}), 0);
    // Elements of three or less, rounded to float.
    constexpr double kTolerance = 1e-6;
    for (const Vec3f p : {Vec3f{}, Vec3f{1, 0, 0}, Vec3f{0, 1, 0}, Vec3f{0, 0, 1}}) {
      const Vec3d d = apply(outer, apply(inner, vec_cast<double>(p))) - vec_cast<double>(transform_point(m, p));
      EXPECT_LT(std::sqrt(dot(d, d)), kTolerance) << round;
    }
  }
}

}  // namespace
}  // namespace shlight
