#include "shlight/scene/coarsen.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <set>

#include "shlight/scene/shapes.h"

namespace shlight {
namespace {

Scene scene_of(Mesh mesh) {
  Scene scene;
  scene.meshes = {std::move(mesh)};
  scene.materials = {{"white", {1, 1, 1}, {}}};
  scene.instances = {{0, kIdentity}};
  return scene;
}

// A square of n x n vertices at this height, seen from above or from below.
void add_square(Mesh& mesh, int n, float height, bool from_above) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (int i = 0; i < n * n; ++i) {
    mesh.positions.push_back(
        {static_cast<float>(i % n) / static_cast<float>(n), height, static_cast<float>(i / n) / static_cast<float>(n)});
    mesh.normals.push_back({0, from_above ? 1.0f : -1.0f, 0});
  }
  for (int y = 0; y + 1 < n; ++y)
    for (int x = 0; x + 1 < n; ++x) {
      const auto a = first + static_cast<std::uint32_t>(y * n + x), b = a + 1, c = a + static_cast<std::uint32_t>(n),
                 d = c + 1;
      std::array<std::uint32_t, 6> indices = {a, c, b, b, c, d};
      if (!from_above) std::ranges::reverse(indices);
      mesh.indices.insert(mesh.indices.end(), indices.begin(), indices.end());
    }
}

TEST(Coarsen, LeavesWhatHasFewTriangles) {
  const Scene sphere = scene_of(make_sphere(1, 8));
  EXPECT_EQ(coarsen(sphere, num_triangles(sphere)).meshes[0].indices, sphere.meshes[0].indices);
}

TEST(Coarsen, ASphereStaysRoundAndClosed) {
  const Scene sphere = scene_of(make_sphere(1, 128));
  constexpr std::size_t kTriangles = 2000;
  ASSERT_GT(num_triangles(sphere), 10 * kTriangles);
  const Scene coarse = coarsen(sphere, kTriangles);
  const Mesh& mesh = coarse.meshes[0];
  EXPECT_EQ(mesh.positions.size(), sphere.meshes[0].positions.size());
  EXPECT_LE(num_triangles(coarse), kTriangles * 5 / 4);
  EXPECT_GE(num_triangles(coarse), kTriangles / 2);
  // The volume is nearly that of the sphere, which takes triangles all around it, all seen from outside.
  double volume = 0;
  for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
    ASSERT_LT(std::max({mesh.indices[t], mesh.indices[t + 1], mesh.indices[t + 2]}), mesh.positions.size());
    const Vec3d a = vec_cast<double>(mesh.positions[mesh.indices[t]]),
                b = vec_cast<double>(mesh.positions[mesh.indices[t + 1]]),
                c = vec_cast<double>(mesh.positions[mesh.indices[t + 2]]);
    volume += dot(a, cross(b, c)) / 6;
  }
  EXPECT_NEAR(volume, 4 * std::numbers::pi / 3, 0.05);
}

TEST(Coarsen, FlatSurfacesKeepTheirSharesOfVertices) {
  Mesh square;
  add_square(square, 100, 0, true);
  const Scene coarse = coarsen(scene_of(square), 1000);
  // No tenth of it is without some.
  std::set<int> tenths;
  for (const std::uint32_t v : coarse.meshes[0].indices) {
    const Vec3f p = coarse.meshes[0].positions[v];
    tenths.insert(static_cast<int>(10 * p.x) + 10 * static_cast<int>(10 * p.z));
  }
  EXPECT_EQ(tenths.size(), 100u);
}

TEST(Coarsen, SidesOfThinWallsStayApart) {
  Mesh wall;
  add_square(wall, 100, 0.01f, true);
  add_square(wall, 100, -0.01f, false);
  const Scene coarse = coarsen(scene_of(wall), 2000);
  ASSERT_LT(num_triangles(coarse), 3000u);
  const Mesh& mesh = coarse.meshes[0];
  for (std::size_t t = 0; t < mesh.indices.size(); t += 3)
    for (const std::size_t i : {t + 1, t + 2})
      ASSERT_EQ(mesh.positions[mesh.indices[i]].y, mesh.positions[mesh.indices[t]].y);
}

TEST(Coarsen, CountsInstancesAndKeepsSmallMeshes) {
  Scene scene = scene_of(make_sphere(1, 64));
  scene.meshes.push_back(make_sphere(1, 2));
  scene.instances = {{0, kIdentity}, {0, kIdentity}, {1, kIdentity}};
  const Scene coarse = coarsen(scene, 1000);
  EXPECT_LE(num_triangles(coarse), 1300u);
  EXPECT_EQ(coarse.meshes[1].indices, scene.meshes[1].indices);
}

}  // namespace
}  // namespace shlight
