#pragma once

// Meshes and scenes that tests of several folders are made of.

#include <cmath>
#include <cstdint>
#include <numbers>

#include "shlight/scene/scene.h"

namespace shlight {

// An ellipsoid around the origin with exact normals.
inline Mesh make_ellipsoid(Vec3d half_axes, int rings = 48) {
  Mesh mesh;
  const int columns = 2 * rings;
  for (int i = 0; i <= rings; ++i)
    for (int j = 0; j <= columns; ++j) {
      const double theta = std::numbers::pi * i / rings, phi = std::numbers::pi * 2 * j / columns;
      const Vec3d d = {std::sin(theta) * std::sin(phi), std::cos(theta), std::sin(theta) * std::cos(phi)};
      const Vec3d n = {d.x / half_axes.x, d.y / half_axes.y, d.z / half_axes.z};
      mesh.positions.push_back(vec_cast<float>(Vec3d{d.x * half_axes.x, d.y * half_axes.y, d.z * half_axes.z}));
      mesh.normals.push_back(vec_cast<float>((1 / std::sqrt(dot(n, n))) * n));
    }
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < columns; ++j) {
      const auto a = static_cast<std::uint32_t>(i * (columns + 1) + j),
                 below = a + static_cast<std::uint32_t>(columns) + 1;
      for (const std::uint32_t index : {a, below, a + 1, a + 1, below, below + 1}) mesh.indices.push_back(index);
    }
  return mesh;
}

// A square from (-1, -1, 0) to (1, 1, 0) that faces +Z, its picture upright seen from there.
inline Mesh make_square() {
  Mesh mesh;
  mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  mesh.normals.assign(4, {0, 0, 1});
  mesh.texcoords = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
  mesh.indices = {0, 1, 2, 0, 2, 3};
  return mesh;
}

inline Scene make_test_scene(const Mesh& mesh, Vec3f base_color = {1, 1, 1}, const Mat4f& to_world = kIdentity) {
  Scene scene;
  scene.meshes = {mesh};
  scene.materials = {{"", base_color, {}, {}}};
  scene.instances = {{0, to_world}};
  return scene;
}

}  // namespace shlight
