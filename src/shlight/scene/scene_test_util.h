#pragma once

// What the tests of this folder ask of scenes and meshes.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "shlight/scene/scene.h"
#include "shlight/scene/transform.h"
#include "shlight/scene/weld.h"

namespace shlight {

inline bool is_finite(Vec3f v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}
inline bool is_reflectance(Vec3f c) {
  return std::ranges::all_of(std::array{c.x, c.y, c.z}, [](float v) { return v >= 0 && v <= 1; });
}

// All that scene.h promises.
inline void expect_valid(const Mesh& mesh) {
  const std::size_t n = mesh.positions.size();
  EXPECT_EQ(mesh.normals.size(), n);
  EXPECT_TRUE(mesh.texcoords.empty() || mesh.texcoords.size() == n);
  EXPECT_TRUE(mesh.colors.empty() || mesh.colors.size() == n);
  EXPECT_EQ(mesh.indices.size() % 3, 0u);
  EXPECT_FALSE(mesh.indices.empty());
  EXPECT_TRUE(std::ranges::all_of(mesh.positions, is_finite));
  EXPECT_TRUE(std::ranges::all_of(mesh.colors, is_reflectance));
  EXPECT_TRUE(std::ranges::all_of(mesh.texcoords, [](Vec2f t) { return std::isfinite(t.u) && std::isfinite(t.v); }));
  // A float rounds a unit vector's length by less than two units in the last place.
  constexpr double kUnitTolerance = 3e-7;
  for (const Vec3f& normal : mesh.normals) {
    const double length = std::sqrt(dot(vec_cast<double>(normal), vec_cast<double>(normal)));
    ASSERT_NEAR(length, 1, kUnitTolerance);
  }
  std::vector<bool> is_used(n);
  for (const std::uint32_t i : mesh.indices) {
    ASSERT_LT(i, n);
    is_used[i] = true;
  }
  EXPECT_TRUE(std::ranges::all_of(is_used, std::identity{}));
}

inline void expect_valid(const Scene& scene) {
  EXPECT_FALSE(scene.instances.empty());
  for (const Mesh& mesh : scene.meshes) {
    expect_valid(mesh);
    EXPECT_LT(mesh.material, scene.materials.size());
  }
  for (const Instance& instance : scene.instances) {
    EXPECT_LT(instance.mesh, scene.meshes.size());
    EXPECT_GT(determinant(instance.to_world), 0);
  }
  for (const Material& material : scene.materials) {
    EXPECT_TRUE(is_reflectance(material.base_color)) << material.name;
    if (material.texture) {
      EXPECT_LT(*material.texture, scene.textures.size());
    }
  }
  for (const Image8& texture : scene.textures) {
    EXPECT_GT(texture.width, 0);
    EXPECT_EQ(texture.values.size(), 4u * static_cast<unsigned>(texture.width) * static_cast<unsigned>(texture.height));
  }
  const auto bounds = world_bounds(scene);
  ASSERT_TRUE(bounds);
  EXPECT_TRUE(is_finite(bounds->min) && is_finite(bounds->max));
}

// Of what the mesh encloses; positive where triangles are counter-clockwise seen from outside.
inline double signed_volume(const Mesh& mesh, const Mat4f& to_world = kIdentity) {
  const auto p = [&](std::size_t corner) {
    return vec_cast<double>(transform_point(to_world, mesh.positions[mesh.indices[corner]]));
  };
  double volume = 0;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) volume += dot(p(i), cross(p(i + 1), p(i + 2))) / 6;
  return volume;
}
inline double signed_volume(const Scene& scene) {
  double volume = 0;
  for (const Instance& i : scene.instances) volume += signed_volume(scene.meshes[i.mesh], i.to_world);
  return volume;
}

// The worst of the cosines between a corner's normal and its triangle's.
inline double least_normal_agreement(const Mesh& mesh) {
  double least = 1;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const auto p = [&](std::size_t k) { return vec_cast<double>(mesh.positions[mesh.indices[i + k]]); };
    const Vec3d geometric = cross(p(1) - p(0), p(2) - p(0));
    for (std::size_t k = 0; k < 3; ++k)
      least = std::min(least, dot(geometric, vec_cast<double>(mesh.normals[mesh.indices[i + k]])) /
                                  std::sqrt(dot(geometric, geometric)));
  }
  return least;
}

// Vertices - edges + faces, equal positions counted once: 2 - 2 · handles for a closed surface in one piece.
struct Topology {
  int euler_characteristic = 0;
  bool is_closed = true;  // every edge belongs to exactly two triangles, which pass it in opposite directions
};
inline Topology topology(const Mesh& mesh) {
  const Weld weld = weld_positions(mesh.positions);
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> half_edges;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
    for (std::size_t k = 0; k < 3; ++k)
      ++half_edges[{weld.group[mesh.indices[i + k]], weld.group[mesh.indices[i + (k + 1) % 3]]}];
  Topology t;
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const auto& [edge, count] : half_edges) {
    const auto opposite = half_edges.find({edge.second, edge.first});
    t.is_closed = t.is_closed && count == 1 && opposite != half_edges.end();
    edges.insert(std::minmax(edge.first, edge.second));
  }
  t.euler_characteristic =
      static_cast<int>(weld.first.size()) - static_cast<int>(edges.size()) + static_cast<int>(mesh.indices.size() / 3);
  return t;
}

}  // namespace shlight
