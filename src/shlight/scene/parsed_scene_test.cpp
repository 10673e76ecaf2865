#include "shlight/scene/parsed_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "shlight/core/error.h"
#include "shlight/scene/shapes.h"

namespace shlight {
namespace {

ParsedScene make_example() {
  ParsedScene scene;
  scene.meshes = {make_sphere(1, 3), {}};
  scene.meshes[0].name = "ball";
  scene.meshes[0].colors.assign(scene.meshes[0].positions.size(), {0.5f, 0.25f, 1});
  scene.meshes[0].texcoords.assign(scene.meshes[0].positions.size(), {0.1f, 0.2f});
  scene.instances = {{1, kIdentity}, {0, {2, 0, 0, 0, 0, 3, 0, 0, 0, 0, 4, 0, 5, 6, 7, 1}}};
  scene.materials = {{"red", {1, 0, 0}, {}, {}}, {"mapped", {1, 1, 1}, 1, MetallicRoughness{0.75f, 0.5f}}};
  ParsedTexture file, embedded;
  file.name = "file.png";
  embedded.name = "*0";
  embedded.texels = {2, 1, {1, 2, 3, 4, 5, 6, 7, 8}};
  embedded.file_bytes = {std::byte{9}};
  scene.textures = {file, embedded};
  scene.warnings = {"something", ""};
  return scene;
}

std::vector<std::byte> bytes_of(const ParsedScene& scene) {
  FencedBytes bytes;
  write_parsed_scene(scene, bytes);
  return {bytes.bytes().begin(), bytes.bytes().end()};
}

ParsedScene read(std::span<const std::byte> bytes) {
  return read_parsed_scene(bytes, "test.obj", "a model");
}

TEST(ParsedScene, RoundTrip) {
  const ParsedScene scene = make_example();
  const ParsedScene back = read(bytes_of(scene));
  ASSERT_EQ(back.meshes.size(), 2u);
  EXPECT_EQ(back.meshes[0].name, "ball");
  EXPECT_EQ(back.meshes[0].positions, scene.meshes[0].positions);
  EXPECT_EQ(back.meshes[0].normals, scene.meshes[0].normals);
  EXPECT_EQ(back.meshes[0].texcoords, scene.meshes[0].texcoords);
  EXPECT_EQ(back.meshes[0].colors, scene.meshes[0].colors);
  EXPECT_EQ(back.meshes[0].indices, scene.meshes[0].indices);
  ASSERT_EQ(back.instances.size(), 2u);
  EXPECT_EQ(back.instances[1].to_world, scene.instances[1].to_world);
  EXPECT_EQ(back.materials[0].base_color, scene.materials[0].base_color);
  EXPECT_FALSE(back.materials[0].texture);
  EXPECT_EQ(back.materials[1].texture, 1u);
  EXPECT_FALSE(back.materials[0].gloss);
  EXPECT_EQ(back.materials[1].gloss, (MetallicRoughness{0.75f, 0.5f}));
  EXPECT_EQ(back.textures[1].texels.values, scene.textures[1].texels.values);
  EXPECT_EQ(back.textures[1].file_bytes, scene.textures[1].file_bytes);
  EXPECT_EQ(back.warnings, scene.warnings);
  EXPECT_EQ(bytes_of(back), bytes_of(scene));
}

TEST(ParsedScene, EveryTruncationIsRefused) {
  const std::vector<std::byte> bytes = bytes_of(make_example());
  for (std::size_t size = 0; size < bytes.size(); ++size) EXPECT_THROW(read(std::span(bytes).first(size)), Error);
}

TEST(ParsedScene, MoreBytesThanTheSceneAreRefused) {
  std::vector<std::byte> bytes = bytes_of(make_example());
  bytes.push_back({});
  EXPECT_THROW(read(bytes), Error);
}

// Whatever one byte is changed to, the scene is refused or has its references and lengths in range.
TEST(ParsedScene, AnyChangedByteIsRefusedOrHarmless) {
  const std::vector<std::byte> bytes = bytes_of(make_example());
  for (std::size_t i = 0; i < bytes.size(); ++i)
    for (const int value : {0x01, 0x7f, 0xff}) {
      std::vector<std::byte> changed = bytes;
      changed[i] = std::byte(value);
      try {
        const ParsedScene scene = read(changed);
        for (const Mesh& mesh : scene.meshes) {
          EXPECT_LT(mesh.material, scene.materials.size());
          for (const std::uint32_t index : mesh.indices) EXPECT_LT(index, mesh.positions.size());
        }
        for (const Instance& instance : scene.instances) EXPECT_LT(instance.mesh, scene.meshes.size());
      } catch (const Error&) {
      }
    }
}

TEST(ParsedScene, FalseReferencesAreRefused) {
  const auto refuse = [](auto&& change) {
    ParsedScene scene = make_example();
    change(scene);
    EXPECT_THROW(read(bytes_of(scene)), Error);
  };
  refuse([](ParsedScene& s) { s.meshes[0].indices[4] = 1000; });
  refuse([](ParsedScene& s) { s.meshes[0].indices.pop_back(); });
  refuse([](ParsedScene& s) { s.meshes[0].normals.pop_back(); });
  refuse([](ParsedScene& s) { s.meshes[1].material = 2; });
  refuse([](ParsedScene& s) { s.instances[0].mesh = 2; });
  refuse([](ParsedScene& s) { s.materials[1].texture = 2; });
  refuse([](ParsedScene& s) { s.textures[1].texels.width = 3; });
  refuse([](ParsedScene& s) { s.textures[1].texels.width = -2, s.textures[1].texels.height = -1; });
}

}  // namespace
}  // namespace shlight
