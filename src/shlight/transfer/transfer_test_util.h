#pragma once

// Small scenes whose transfer is known.

#include <cmath>
#include <initializer_list>
#include <numbers>
#include <vector>

#include "shlight/scene/scene.h"
#include "shlight/transfer/transfer.h"

namespace shlight {

// A parallelogram of steps x steps quads from `corner` along `a` and `b`; its normal is that of a × b.
inline Mesh make_sheet(Vec3f corner, Vec3f a, Vec3f b, int steps) {
  Mesh mesh;
  const Vec3f across = cross(a, b);
  const Vec3f normal = (1 / std::sqrt(dot(across, across))) * across;
  for (int j = 0; j <= steps; ++j)
    for (int i = 0; i <= steps; ++i) {
      const float u = static_cast<float>(i) / static_cast<float>(steps);
      const float v = static_cast<float>(j) / static_cast<float>(steps);
      mesh.positions.push_back(corner + u * a + v * b);
      mesh.normals.push_back(normal);
    }
  for (int j = 0; j < steps; ++j)
    for (int i = 0; i < steps; ++i) {
      const std::uint32_t p = static_cast<std::uint32_t>(j * (steps + 1) + i),
                          q = p + static_cast<std::uint32_t>(steps) + 1;
      mesh.indices.insert(mesh.indices.end(), {p, p + 1, q + 1, p, q + 1, q});
    }
  return mesh;
}

inline void append(Mesh& mesh, const Mesh& other) {
  const std::uint32_t first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
  mesh.normals.insert(mesh.normals.end(), other.normals.begin(), other.normals.end());
  for (const std::uint32_t index : other.indices) mesh.indices.push_back(first + index);
}

// The six sides of a box with hard edges; normals point out of it, or into it.
inline Mesh make_box(Vec3f low, Vec3f high, int steps, bool outward) {
  const Vec3f size = high - low, x = {size.x, 0, 0}, y = {0, size.y, 0}, z = {0, 0, size.z};
  Mesh box;
  for (const auto& [a, b, c] : {std::array{x, y, z}, std::array{y, z, x}, std::array{z, x, y}}) {
    append(box, outward ? make_sheet(low, b, a, steps) : make_sheet(low, a, b, steps));
    append(box, outward ? make_sheet(low + c, a, b, steps) : make_sheet(low + c, b, a, steps));
  }
  return box;
}

// Each mesh once and where it stands, with a material of its own.
inline Scene make_test_scene(std::initializer_list<Mesh> meshes, Vec3f reflectance = {0.5f, 0.5f, 0.5f}) {
  Scene scene;
  for (const Mesh& mesh : meshes) {
    const std::uint32_t number = static_cast<std::uint32_t>(scene.meshes.size());
    scene.meshes.push_back(mesh);
    scene.meshes.back().material = number;
    scene.materials.push_back({"", reflectance, {}});
    scene.instances.push_back({number, kIdentity});
  }
  return scene;
}

inline BakeParams make_cosine_params(int bands) {
  BakeParams params;
  params.kind = TransferKind::kCosine;
  params.bands = bands;
  return params;
}

// What leaves a white vertex under uniform light of radiance 1, in channel c.
inline double under_uniform_light(const Transfer& transfer, std::size_t vertex, std::size_t c = 0) {
  const std::size_t n = static_cast<std::size_t>(transfer.bands * transfer.bands);
  return std::sqrt(4 * std::numbers::pi) *
         double{transfer.coefficients[(vertex * static_cast<std::size_t>(transfer.channels) + c) * n]};
}

// √(Σ (a − b)² / Σ b²) over all coefficients.
inline double relative_difference(const Transfer& a, const Transfer& b) {
  double difference = 0, norm = 0;
  for (std::size_t i = 0; i < b.coefficients.size(); ++i) {
    difference += std::pow(double{a.coefficients[i]} - double{b.coefficients[i]}, 2);
    norm += std::pow(double{b.coefficients[i]}, 2);
  }
  return std::sqrt(difference / norm);
}

}  // namespace shlight
