#include "shlight/transfer/baked_file.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

#include "shlight/core/temporary_folder.h"
#include "shlight/scene/builtin_scene.h"
#include "shlight/scene/load_scene.h"
#include "shlight/transfer/baked_test_util.h"
#include "shlight/transfer/quantise.h"
#include "shlight/transfer/transfer_test_util.h"

namespace shlight {
namespace {

TEST(BakedFile, ComesBackWithTheSameBits) {
  const Scene scene = make_busy_scene();
  // A coefficient alone in its vector, and vectors that are full.
  for (const int bands : {1, 2, 5, kMaxTransferBands})
    for (const int channels : {1, 3}) {
      const Transfer transfer = make_any_transfer(scene, bands, channels);
      const BakeInfo info = make_info(transfer);
      const Baked back = load_baked(format_baked(scene, transfer, info, "a.glb"), "a.glb");
      expect_same(scene, back.scene);
      expect_same(transfer, back.transfer);
      EXPECT_EQ(back.info.params.kind, info.params.kind);
      EXPECT_EQ(back.info.params.bands, info.params.bands);
      EXPECT_EQ(back.info.params.method, info.params.method);
      EXPECT_EQ(back.info.params.samples, info.params.samples);
      EXPECT_EQ(back.info.params.error, info.params.error);
      EXPECT_EQ(back.info.params.bounces, info.params.bounces);
      EXPECT_EQ(back.info.params.seed, info.params.seed);
      EXPECT_EQ(back.info.model, info.model);
    }
}

TEST(BakedFile, FewerBitsComeBackAsQuantised) {
  const Scene scene = make_busy_scene();
  for (const int bits : {8, 16})
    for (const int channels : {1, 3}) {
      const Transfer transfer = make_any_transfer(scene, 3, channels);
      BakeInfo info = make_info(transfer);
      info.bits = bits;
      const std::vector<std::byte> file = format_baked(scene, transfer, info, "a.glb");
      const Baked back = load_baked(file, "a.glb");
      expect_same(scene, back.scene);
      EXPECT_EQ(back.info.bits, bits);
      EXPECT_TRUE(same_bits(back.transfer.coefficients, quantise_transfer(transfer, bits).coefficients));
      EXPECT_TRUE(same_bits(back.transfer.ambient_occlusion, transfer.ambient_occlusion));
      EXPECT_EQ(baked_bytes_per_vertex(3, channels, bits), static_cast<std::size_t>(channels * 3 * bits / 2 + 16));
      EXPECT_NE(error_of(changed(file, [](auto& root) { root["asset"]["extras"]["shlight"]["scales"].erase(0); }))
                    .find("scales are not one for each"),
                std::string::npos);
      EXPECT_NE(error_of(changed(file, [](auto& root) { root["asset"]["extras"]["shlight"]["bits"] = 32; })),
                "no error");
    }
}

TEST(BakedFile, ClusteredPcaComesBackWithTheSameBits) {
  const Scene scene = make_busy_scene();
  for (const int channels : {1, 3})
    for (const int components : {1, 3, 4, 7}) {
      const Transfer transfer = make_any_transfer(scene, 3, channels);
      BakeInfo info = make_info(transfer);
      info.bits = 16;
      info.pca = compress_pca(transfer, {.clusters = 5, .components = components});
      const std::vector<std::byte> file = format_baked(scene, transfer, info, "a.glb");
      const Baked back = load_baked(file, "a.glb");
      expect_same(scene, back.scene);
      ASSERT_TRUE(back.info.pca);
      EXPECT_EQ(back.info.pca->clusters, 5);
      EXPECT_EQ(back.info.pca->components, components);
      EXPECT_TRUE(same_bits(back.info.pca->table, info.pca->table));
      EXPECT_EQ(back.info.pca->codes, info.pca->codes);
      Transfer decompressed = transfer;
      decompressed.coefficients = pca_coefficients(*info.pca);
      expect_same(decompressed, back.transfer);
      // What comes back is written again as the same file.
      EXPECT_EQ(format_baked(back.scene, back.transfer, back.info, "a.glb"), file);

      const double per_vertex = baked_bytes_per_vertex(transfer, info);
      const double with_floats = static_cast<double>(baked_bytes_per_vertex(3, channels));
      const double bytes = static_cast<double>(file.size()),
                   bytes_of_floats = static_cast<double>(format_baked(scene, transfer, {}, "a.glb").size());
      // But for the text that describes them.
      constexpr double kJson = 10000;
      EXPECT_NEAR((with_floats - per_vertex) * static_cast<double>(transfer.num_vertices()), bytes_of_floats - bytes,
                  kJson);

      const auto pca = [](auto& root) -> auto& {
        return root["asset"]["extras"]["shlight"]["pca"];
      };
      EXPECT_NE(error_of(changed(file, [&](auto& r) { pca(r)["clusters"] = 6; })).find("a table of"),
                std::string::npos);
      EXPECT_NE(error_of(changed(file, [&](auto& r) { pca(r)["components"] = 40; })).find("components is 40"),
                std::string::npos);
      EXPECT_NE(error_of(changed(file, [&](auto& r) { pca(r)["table"] = 0; })), "no error");
      EXPECT_NE(error_of(changed(file, [&](auto& r) { r["asset"]["extras"]["shlight"]["bits"] = 8; })), "no error");
      info.pca->codes[0] = 5;
      EXPECT_NE(error_of(format_baked(scene, transfer, info, "a.glb")).find("a vertex of cluster 5 of 5"),
                std::string::npos);
      info.pca->codes[0] = 0;
      info.pca->table[0] = std::numeric_limits<float>::infinity();
      EXPECT_NE(error_of(format_baked(scene, transfer, info, "a.glb")).find("not finite"), std::string::npos);
      std::ranges::fill(info.pca->table, std::numeric_limits<float>::max());
      EXPECT_NE(error_of(format_baked(scene, transfer, info, "a.glb")).find("not finite"), std::string::npos);
    }
}

TEST(BakedFile, FitsWhatItWasBakedFromAndNothingElse) {
  const Scene scene = make_sphere_scene(8);
  BakeParams params = make_cosine_params(3);
  const Baked back = load_baked(format_baked(scene, bake_transfer(scene, params), {params, "a"}, "a.glb"), "a.glb");
  EXPECT_TRUE(still_fits(back.transfer, scene, back.info.params));
  EXPECT_TRUE(still_fits(back.transfer, scene, params));
  Scene other = scene;
  other.meshes[0].positions[5].x = std::nextafter(other.meshes[0].positions[5].x, 9.0f);
  EXPECT_FALSE(still_fits(back.transfer, other, params));
  other = scene;
  other.instances[0].to_world[12] = 1;
  EXPECT_FALSE(still_fits(back.transfer, other, params));
  params.bands = 4;
  EXPECT_FALSE(still_fits(back.transfer, scene, params));
}

TEST(BakedFile, BuiltinScenesComeBack) {
  for (const Scene& scene : {make_sphere_scene(8), make_still_life_scene()}) {
    const Transfer transfer = bake_transfer(scene, make_cosine_params(3));
    const Baked back = load_baked(format_baked(scene, transfer, {}, "a.glb"), "a.glb");
    expect_same(scene, back.scene);
    expect_same(transfer, back.transfer);
  }
}

// Triangle for triangle in the world, with the materials that can be seen.
void expect_same_picture(const Scene& scene, const Scene& model) {
  EXPECT_TRUE(model.warnings.empty()) << model.warnings[0];
  EXPECT_EQ(num_triangles(model), num_triangles(scene));
  ASSERT_EQ(model.instances.size(), scene.instances.size());
  constexpr float kTolerance = 1e-5f;
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const Mesh &a = scene.meshes[scene.instances[i].mesh], &b = model.meshes[model.instances[i].mesh];
    ASSERT_EQ(a.indices.size(), b.indices.size());
    ASSERT_EQ(a.texcoords.empty(), b.texcoords.empty());
    ASSERT_EQ(a.colors.empty(), b.colors.empty());
    for (std::size_t k = 0; k < a.indices.size(); ++k) {
      const std::uint32_t u = a.indices[k], v = b.indices[k];
      const Vec3f d = transform_point(scene.instances[i].to_world, a.positions[u]) -
                      transform_point(model.instances[i].to_world, b.positions[v]);
      const Vec3f n = transform_normal(scene.instances[i].to_world, a.normals[u]) -
                      transform_normal(model.instances[i].to_world, b.normals[v]);
      ASSERT_LT(dot(d, d) + dot(n, n), kTolerance * kTolerance) << i << " " << k;
      if (!a.colors.empty()) {
        ASSERT_EQ(a.colors[u], b.colors[v]);
        ASSERT_EQ(a.texcoords[u], b.texcoords[v]);
      }
    }
    const Material &m = scene.materials[a.material], &n = model.materials[b.material];
    EXPECT_EQ(m.base_color, n.base_color);
    EXPECT_EQ(m.gloss, n.gloss);
    ASSERT_EQ(n.texture.has_value(), !a.texcoords.empty());
    if (n.texture) {
      EXPECT_EQ(model.textures[*n.texture].values, scene.textures[0].values);
    }
  }
}

// Read by assimp, which knows nothing of us, however transfer is stored.
TEST(BakedFile, IsAModelToOthers) {
  const TemporaryFolder folder;
  const Scene scene = make_busy_scene();
  const Transfer transfer = make_any_transfer(scene, 5, 3);
  std::vector<BakeInfo> infos(4, make_info(transfer));
  infos[1].bits = 16;
  infos[2].bits = 8;
  infos[3].bits = 16;
  infos[3].pca = compress_pca(transfer, {.clusters = 5, .components = 7});
  for (std::size_t k = 0; k < infos.size(); ++k) {
    const testing::ScopedTrace trace(__FILE__, __LINE__, fmt::format("storage {}", k));
    save_baked(folder / "busy.glb", scene, transfer, infos[k]);
    expect_same_picture(scene, load_scene(folder / "busy.glb"));
  }
}

// Where Khronos's validator is installed (npm install gltf-validator), named by SHLIGHT_GLTF_VALIDATOR: a folder that
// has node_modules in it.
TEST(BakedFile, IsValidGltf) {
  const char* const validator = std::getenv("SHLIGHT_GLTF_VALIDATOR");
  if (!validator) GTEST_SKIP() << "SHLIGHT_GLTF_VALIDATOR names no folder";
  const TemporaryFolder folder;
  for (const bool pca : {false, true})
    for (const int bits : {8, 16, 32}) {
      const Scene scene = make_busy_scene();
      const Transfer transfer = make_any_transfer(scene, 5, bits == 32 ? 1 : 3);
      BakeInfo info = make_info(transfer);
      info.bits = pca ? 16 : bits;
      if (pca) info.pca = compress_pca(transfer, {.clusters = bits, .components = bits - 1});
      save_baked(folder / "busy.glb", scene, transfer, info);
      const std::string command = fmt::format(
          "cd '{}' && node -e \"require('gltf-validator').validateBytes(new "
          "Uint8Array(require('fs').readFileSync('{}')))"
          ".then(r => {{ const i = r.issues; "
          "console.log(JSON.stringify(i.messages)); "
          "process.exit(i.numErrors + i.numWarnings) }})\"",
          validator, (folder / "busy.glb").string());
      EXPECT_EQ(std::system(command.c_str()), 0) << bits;
    }
}

TEST(BakedFile, EstimateIsAboutTheSize) {
  for (const int bands : {3, 6}) {
    const Scene scene = make_still_life_scene();
    const double size =
        static_cast<double>(format_baked(scene, make_any_transfer(scene, bands, 3), {}, "a.glb").size());
    EXPECT_NEAR(static_cast<double>(estimate_baked_bytes(scene, bands, 3)), size, .05 * size);
  }
}

TEST(BakedFile, AFailureLeavesTheOldFile) {
  const TemporaryFolder folder;
  const Scene scene = make_busy_scene();
  const Transfer transfer = make_any_transfer(scene, 2, 1);
  save_baked(folder / "a.glb", scene, transfer, {});
  Scene empty = scene;
  empty.meshes[1].indices.clear();
  EXPECT_THROW(save_baked(folder / "a.glb", empty, transfer, {}), Error);
  EXPECT_THROW(save_baked(folder / "missing" / "a.glb", scene, transfer, {}), Error);
  expect_same(load_baked(folder / "a.glb").transfer, transfer);
}

}  // namespace
}  // namespace shlight
