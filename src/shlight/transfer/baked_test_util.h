#pragma once

// Baked files for tests: with all that a scene can have, and changed.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <string>

#include "shlight/core/error.h"
#include "shlight/scene/shapes.h"
#include "shlight/scene/transform.h"
#include "shlight/sh/coefficients.h"
#include "shlight/transfer/baked_format.h"
#include "shlight/transfer/glb.h"

namespace shlight {

// All that a scene can have: two materials, one with gloss; two meshes, the second shown first and three times, once
// sheared and once turned; colours of vertices; texture coordinates on one mesh only, and a textured material on both;
// alpha in the texture.
inline Scene make_busy_scene() {
  Scene scene;
  scene.meshes = {make_rounded_box({1, 2, 1}, .1f, 1, 1), make_sphere(1, 3)};
  scene.meshes[0].name = "box";
  scene.meshes[1].name = "\"sphere\", with \xc3\xa4 name";
  for (const Vec3f p : scene.meshes[1].positions) {
    scene.meshes[1].texcoords.push_back({p.x, 1 - 3 * p.y});
    scene.meshes[1].colors.push_back({.5f + .5f * p.x, .5f, 1});
  }
  scene.meshes[0].material = 1;
  scene.meshes[1].material = 1;
  scene.materials = {{"plain", {.1f, .2f, .3f}, {}}, {"wood", {1, .9f, .8f}, 0, MetallicRoughness{.25f, .7f}}};
  Image8 texture = {3, 2, {}};
  for (int i = 0; i < 24; ++i) texture.values.push_back(static_cast<unsigned char>(10 * i + 3));
  scene.textures = {texture};
  const Mat4f turned = make_rotation({1, 2, 3}, 40);
  scene.instances = {{1, kIdentity},
                     {0, make_translation({3, 0, 0})},
                     {1, multiply(make_scaling({1, 2, 3}), turned)},
                     {1, multiply(make_translation({0, 0, -4}), turned)}};
  return scene;
}

// Numbers of any kind in the place of a bake's: each another, tiny ones and a negative zero among them.
inline Transfer make_any_transfer(const Scene& scene, int bands, int channels) {
  Transfer transfer;
  transfer.kind = channels == 3 ? TransferKind::kInterreflected : TransferKind::kShadowed;
  transfer.bands = bands;
  transfer.channels = channels;
  transfer.first_vertex.push_back(0);
  for (const Instance& instance : scene.instances)
    transfer.first_vertex.push_back(transfer.first_vertex.back() + scene.meshes[instance.mesh].positions.size());
  const std::size_t vertices = transfer.first_vertex.back();
  std::mt19937 random(5);
  std::normal_distribution<float> normal;
  transfer.coefficients.resize(vertices * static_cast<std::size_t>(num_coefficients(bands) * channels));
  for (float& a : transfer.coefficients) a = normal(random);
  transfer.coefficients[1 % transfer.coefficients.size()] = -0.0f;
  transfer.coefficients.back() = std::numeric_limits<float>::denorm_min();
  for (std::size_t v = 0; v < vertices; ++v) {
    transfer.ambient_occlusion.push_back(static_cast<float>(v) / static_cast<float>(vertices));
    transfer.bent_normals.push_back({.6f, 0, v % 2 ? .8f : -.8f});
  }
  transfer.hash = 0x0123456789abcdef;
  transfer.rays = (1ull << 60) + 1;
  transfer.seconds = 1.0 / 3;
  transfer.estimated_error = 1.0 / 300;
  return transfer;
}

inline BakeInfo make_info(const Transfer& transfer) {
  BakeInfo info;
  info.params.kind = transfer.kind;
  info.params.bands = transfer.bands;
  info.params.method = TransferMethod::kMonteCarlo;
  info.params.samples = 1234;
  info.params.error = .003f;
  info.params.bounces = 7;
  info.params.seed = ~0ull;
  info.model = "\"checksum\":\"0000000000000000\" is no name";
  return info;
}

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

inline void expect_same(const Scene& a, const Scene& b) {
  ASSERT_EQ(a.meshes.size(), b.meshes.size());
  for (std::size_t i = 0; i < a.meshes.size(); ++i) {
    EXPECT_EQ(a.meshes[i].name, b.meshes[i].name);
    EXPECT_TRUE(same_bits(a.meshes[i].positions, b.meshes[i].positions)) << i;
    EXPECT_TRUE(same_bits(a.meshes[i].normals, b.meshes[i].normals)) << i;
    EXPECT_TRUE(same_bits(a.meshes[i].texcoords, b.meshes[i].texcoords)) << i;
    EXPECT_TRUE(same_bits(a.meshes[i].colors, b.meshes[i].colors)) << i;
    EXPECT_EQ(a.meshes[i].indices, b.meshes[i].indices) << i;
    EXPECT_EQ(a.meshes[i].material, b.meshes[i].material) << i;
  }
  ASSERT_EQ(a.instances.size(), b.instances.size());
  for (std::size_t i = 0; i < a.instances.size(); ++i) {
    EXPECT_EQ(a.instances[i].mesh, b.instances[i].mesh) << i;
    EXPECT_EQ(a.instances[i].to_world, b.instances[i].to_world) << i;
  }
  ASSERT_EQ(a.materials.size(), b.materials.size());
  for (std::size_t i = 0; i < a.materials.size(); ++i) {
    EXPECT_EQ(a.materials[i].name, b.materials[i].name);
    EXPECT_EQ(a.materials[i].base_color, b.materials[i].base_color);
    EXPECT_EQ(a.materials[i].texture, b.materials[i].texture);
    EXPECT_EQ(a.materials[i].gloss, b.materials[i].gloss);
  }
  ASSERT_EQ(a.textures.size(), b.textures.size());
  for (std::size_t i = 0; i < a.textures.size(); ++i) {
    EXPECT_EQ(a.textures[i].width, b.textures[i].width);
    EXPECT_EQ(a.textures[i].values, b.textures[i].values);
  }
}

inline void expect_same(const Transfer& a, const Transfer& b) {
  EXPECT_EQ(a.kind, b.kind);
  EXPECT_EQ(a.bands, b.bands);
  EXPECT_EQ(a.channels, b.channels);
  EXPECT_TRUE(same_bits(a.coefficients, b.coefficients));
  EXPECT_TRUE(same_bits(a.ambient_occlusion, b.ambient_occlusion));
  EXPECT_TRUE(same_bits(a.bent_normals, b.bent_normals));
  EXPECT_EQ(a.first_vertex, b.first_vertex);
  EXPECT_EQ(a.hash, b.hash);
  EXPECT_EQ(a.rays, b.rays);
  EXPECT_EQ(a.estimated_error, b.estimated_error);
}

inline std::vector<std::byte> make_file(int bands = 2, int channels = 1, bool textured = true) {
  Scene scene = make_busy_scene();
  if (!textured) scene.materials[1].texture.reset(), scene.textures.clear();
  const Transfer transfer = make_any_transfer(scene, bands, channels);
  return format_baked(scene, transfer, make_info(transfer), "busy.glb");
}

inline std::string error_of(std::span<const std::byte> file) {
  try {
    load_baked(file, "a.glb");
    return "no error";
  } catch (const Error& error) {
    EXPECT_TRUE(std::string_view(error.what()).starts_with("a.glb: ")) << error.what();
    return error.what();
  }
}

// The file with its JSON changed, and the checksum right again.
template <class Change>
std::vector<std::byte> changed(const std::vector<std::byte>& file, Change&& change) {
  const auto [text, binary] = split_glb(file, "a.glb");
  auto root = nlohmann::ordered_json::parse(text);
  root["asset"]["extras"]["shlight"]["checksum"] = kEmptyChecksum;
  change(root);
  return make_glb(root.dump(), binary, "a.glb");
}

}  // namespace shlight
