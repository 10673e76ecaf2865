#include "shlight/scene/normals.h"

#include <gtest/gtest.h>

#include <cmath>

#include "shlight/scene/scene_test_util.h"
#include "shlight/scene/shapes.h"

namespace shlight {
namespace {

constexpr float kNearlyEqual = 1e-6f;

void expect_near(Vec3f a, Vec3f b, float tolerance = kNearlyEqual) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

// A cube around the origin, each side cut by one of its diagonals, not always alike. In a corner's number bit 0 is z,
// bit 1 is y and bit 2 is x.
struct Cube {
  std::vector<Vec3f> positions;
  std::vector<std::uint32_t> indices = {0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3, 0, 4, 5, 0, 5, 1,
                                        2, 3, 7, 2, 7, 6, 0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5};
  Cube() {
    for (int i = 0; i < 8; ++i) positions.push_back({i & 4 ? 1.0f : -1.0f, i & 2 ? 1.0f : -1.0f, i & 1 ? 1.0f : -1.0f});
  }
};

TEST(Normals, CubeSmoothsToItsDiagonals) {
  // Weighted by angles, the way a side is cut has no say: by area or plain mean it would.
  const Cube cube;
  const auto normals = make_corner_normals(cube.positions, cube.indices, 180);
  const float third = 1 / std::sqrt(3.0f);
  for (std::size_t i = 0; i < normals.size(); ++i) expect_near(normals[i], third * cube.positions[cube.indices[i]]);
}

TEST(Normals, CubeStaysSharpBelowItsDihedralAngle) {
  const Cube cube;
  for (const float crease : {0.0f, 60.0f, 89.0f}) {
    const auto normals = make_corner_normals(cube.positions, cube.indices, crease);
    for (std::size_t i = 0; i < normals.size(); i += 3) {
      const Vec3f a = cube.positions[cube.indices[i]], b = cube.positions[cube.indices[i + 1]],
                  c = cube.positions[cube.indices[i + 2]];
      for (std::size_t k = 0; k < 3; ++k) expect_near(normals[i + k], 0.25f * cross(b - a, c - a));
    }
  }
}

TEST(Normals, SphereGetsItsDirections) {
  const Mesh sphere = make_sphere(2, 32);
  const auto normals = make_corner_normals(sphere.positions, sphere.indices, 60);
  // The error is of second order in the step, (pi / 32)^2 / 4.
  for (std::size_t i = 0; i < normals.size(); ++i) expect_near(normals[i], sphere.normals[sphere.indices[i]], 3e-3f);
}

TEST(Normals, SoupEqualsIndexedMesh) {
  const Mesh sphere = make_sphere(1, 12);
  std::vector<Vec3f> soup;
  std::vector<std::uint32_t> indices;
  for (const std::uint32_t i : sphere.indices) {
    indices.push_back(static_cast<std::uint32_t>(soup.size()));
    soup.push_back(sphere.positions[i]);
  }
  EXPECT_EQ(make_corner_normals(soup, indices, 60), make_corner_normals(sphere.positions, sphere.indices, 60));
}

TEST(Normals, TwoSidedSheetKeepsItsSides) {
  const std::vector<Vec3f> positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const std::vector<std::uint32_t> indices = {0, 1, 2, 0, 2, 3, 0, 2, 1, 0, 3, 2};
  for (const float crease : {60.0f, 180.0f}) {
    const auto normals = make_corner_normals(positions, indices, crease);
    for (std::size_t i = 0; i < 6; ++i) expect_near(normals[i], {0, 0, 1});
    for (std::size_t i = 6; i < 12; ++i) expect_near(normals[i], {0, 0, -1});
  }
}

TEST(Normals, TriangleWithoutAreaIsHarmless) {
  const std::vector<Vec3f> positions = {{0, 0, 0}, {1, 0, 0}, {0, 0, -1}, {2, 0, 0}, {5, 5, 5}};
  const std::vector<std::uint32_t> indices = {0, 1, 2, 0, 1, 3, 4, 4, 4};
  for (const Vec3f& normal : make_corner_normals(positions, indices, 60)) expect_near(normal, {0, 1, 0});
}

// Quadratic work on this fan would be 10^10 steps.
TEST(Normals, ManyTrianglesOnOneEdgeTakeLinearTime) {
  std::vector<Vec3f> positions = {{0, 0, 0}, {0, 1, 0}};
  std::vector<std::uint32_t> indices;
  for (std::uint32_t i = 0; i < 100'000; ++i) {
    positions.push_back({std::cos(static_cast<float>(i)), 0, std::sin(static_cast<float>(i))});
    indices.insert(indices.end(), {0, 1, i + 2});
  }
  EXPECT_EQ(make_corner_normals(positions, indices, 60).size(), indices.size());
}

}  // namespace
}  // namespace shlight
