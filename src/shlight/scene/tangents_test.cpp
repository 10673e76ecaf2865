#include "shlight/scene/tangents.h"

#include <gtest/gtest.h>

#include <cmath>

#include "shlight/scene/shapes.h"

namespace shlight {
namespace {

constexpr float kTolerance = 1e-5f;  // of unit vectors in floats

// A sheet in the plane z = 0 whose texture is turned by `angle` and mirrored where `mirror` is -1.
Mesh make_sheet(double angle, float mirror) {
  Mesh mesh;
  const auto c = static_cast<float>(std::cos(angle)), s = static_cast<float>(std::sin(angle));
  for (const auto& [x, y] : {std::pair{0.0f, 0.0f}, {1.0f, 0.0f}, {1.0f, 1.0f}, {0.0f, 1.0f}}) {
    mesh.positions.push_back({x, y, 0});
    mesh.normals.push_back({0, 0, 1});
    mesh.texcoords.push_back({c * x + s * y, mirror * (-s * x + c * y)});
  }
  mesh.indices = {0, 1, 2, 0, 2, 3};
  return mesh;
}

TEST(Tangents, PointToWhereUGrows) {
  for (const double angle : {0.0, 0.4, 2.0, -3.0})
    for (const float mirror : {1.0f, -1.0f})
      for (const Vec3f t : make_tangents(make_sheet(angle, mirror))) {
        EXPECT_NEAR(t.x, std::cos(angle), kTolerance);
        EXPECT_NEAR(t.y, std::sin(angle), kTolerance);
        EXPECT_NEAR(t.z, 0, kTolerance);
      }
}

TEST(Tangents, AreUnitAndOrthogonal) {
  for (const Mesh& mesh : {make_sphere(1, 24), make_torus_knot({}), make_rounded_box({1, 1, 1}, 0.1f, 3, 0.2f)}) {
    const std::vector<Vec3f> tangents = make_tangents(mesh);
    ASSERT_EQ(tangents.size(), mesh.positions.size());
    for (std::size_t v = 0; v < tangents.size(); ++v) {
      EXPECT_NEAR(dot(tangents[v], tangents[v]), 1, kTolerance);
      EXPECT_NEAR(dot(tangents[v], mesh.normals[v]), 0, kTolerance);
    }
  }
}

TEST(Tangents, WithoutTextureCoordinatesAreHorizontal) {
  Mesh sphere = make_sphere(1, 24);
  sphere.texcoords.clear();
  const std::vector<Vec3f> tangents = make_tangents(sphere);
  for (std::size_t v = 0; v < tangents.size(); ++v) {
    EXPECT_NEAR(tangents[v].y, 0, kTolerance);
    // Grooves of a lathe: the tangent goes around the vertical, the same way everywhere.
    const Vec3f n = sphere.normals[v];
    if (std::abs(n.y) > 0.99f) continue;
    EXPECT_GT(dot(tangents[v], {n.z, 0, -n.x}), 0.1f);
  }
}

TEST(Tangents, OneTexelForAllIsNoDirection) {
  Mesh sheet = make_sheet(0, 1);
  for (Vec2f& t : sheet.texcoords) t = {0.5f, 0.5f};
  for (const Vec3f t : make_tangents(sheet)) EXPECT_NEAR(dot(t, {1, 0, 0}), 1, kTolerance);
  EXPECT_TRUE(make_tangents({}).empty());
}

}  // namespace
}  // namespace shlight
