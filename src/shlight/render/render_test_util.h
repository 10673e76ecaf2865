#pragma once

// What the tests of render/ share.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string>

#include "shlight/core/error.h"
#include "shlight/render/context.h"
#include "shlight/scene/scene.h"
#include "shlight/sh/basis.h"
#include "shlight/sh/coefficients.h"

namespace shlight {

// A test that draws. Skipped, visibly, where no context can be made.
class GlTest : public testing::Test {
 protected:
  void SetUp() override {
    try {
      context_.emplace();
    } catch (const Error& error) {
      GTEST_SKIP() << error.what();
    }
  }

  std::optional<HeadlessContext> context_;
};

// Directions on a spiral, which are nowhere dense and hit no symmetry.
inline Vec3d spiral_direction(int i, int count) {
  const double y = 1 - (2 * i + 1.0) / count;
  const double azimuth = i * std::numbers::pi * (3 - std::sqrt(5.0));
  const double r = std::sqrt(1 - y * y);
  return {r * std::cos(azimuth), y, r * std::sin(azimuth)};
}

// Coefficients of a delta light from `direction`.
inline RgbCoefficients delta_light(int bands, Vec3d direction, Rgb color = {1, 1, 1}) {
  RgbCoefficients light(bands);
  add_delta(direction, color, light);
  return light;
}

// Coefficients of a light that is `color` from everywhere.
inline RgbCoefficients constant_light(int bands, Rgb color) {
  RgbCoefficients light(bands);
  light[0] = std::sqrt(4 * std::numbers::pi) * color;
  return light;
}

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
  scene.materials = {{"", base_color, {}}};
  scene.instances = {{0, to_world}};
  return scene;
}

}  // namespace shlight
