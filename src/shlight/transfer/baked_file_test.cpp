#include "shlight/transfer/baked_file.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <random>
#include <string>

#include "shlight/core/error.h"
#include "shlight/core/file.h"
#include "shlight/core/temporary_folder.h"
#include "shlight/scene/builtin_scene.h"
#include "shlight/scene/load_scene.h"
#include "shlight/scene/shapes.h"
#include "shlight/scene/transform.h"
#include "shlight/sh/coefficients.h"
#include "shlight/transfer/baked_format.h"
#include "shlight/transfer/glb.h"
#include "shlight/transfer/quantise.h"

namespace shlight {
namespace {

BakeParams cosine_params(int bands) {
  BakeParams params;
  params.kind = TransferKind::kCosine;
  params.bands = bands;
  return params;
}

// All that a scene can have: two materials, one with gloss; two meshes, the second shown first and three times, once
// sheared and once turned; colours of vertices; texture coordinates on one mesh only, and a textured material on both;
// alpha in the texture.
Scene make_busy_scene() {
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
Transfer make_any_transfer(const Scene& scene, int bands, int channels) {
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

BakeInfo make_info(const Transfer& transfer) {
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

void expect_same(const Scene& a, const Scene& b) {
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

void expect_same(const Transfer& a, const Transfer& b) {
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

std::vector<std::byte> make_file(int bands = 2, int channels = 1, bool textured = true) {
  Scene scene = make_busy_scene();
  if (!textured) scene.materials[1].texture.reset(), scene.textures.clear();
  const Transfer transfer = make_any_transfer(scene, bands, channels);
  return format_baked(scene, transfer, make_info(transfer), "busy.glb");
}

std::string error_of(std::span<const std::byte> file) {
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
  BakeParams params = cosine_params(3);
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
    const Transfer transfer = bake_transfer(scene, cosine_params(3));
    const Baked back = load_baked(format_baked(scene, transfer, {}, "a.glb"), "a.glb");
    expect_same(scene, back.scene);
    expect_same(transfer, back.transfer);
  }
}

TEST(BakedFile, IsAModelToOthers) {
  const TemporaryFolder folder;
  const Scene scene = make_busy_scene();
  const Transfer transfer = make_any_transfer(scene, 5, 3);
  save_baked(folder / "busy.glb", scene, transfer, {});
  const Scene model = load_scene(folder / "busy.glb");
  EXPECT_TRUE(model.warnings.empty()) << model.warnings[0];
  EXPECT_EQ(num_triangles(model), num_triangles(scene));
  ASSERT_EQ(model.instances.size(), scene.instances.size());
  // Triangle for triangle in the world.
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

TEST(BakedFile, IsKnownByItsHead) {
  const TemporaryFolder folder;
  const std::vector<std::byte> file = make_file();
  write_file(folder / "a.glb", file);
  EXPECT_TRUE(is_baked_file(folder / "a.glb"));
  write_file(folder / "b.glb", changed(file, [](auto& root) { root["asset"].erase("extras"); }));
  write_file(folder / "c.glb", "glTF");
  EXPECT_FALSE(is_baked_file(folder / "b.glb"));
  EXPECT_FALSE(is_baked_file(folder / "c.glb"));
  EXPECT_FALSE(is_baked_file(folder / "missing.glb"));
  EXPECT_FALSE(is_baked_file(folder.path()));
  EXPECT_NE(error_of(changed(file, [](auto& root) { root["asset"].erase("extras"); })).find("is no baked file"),
            std::string::npos);
}

TEST(BakedFile, EveryCutAndEveryChangedByteIsRefused) {
  const std::vector<std::byte> file = make_file();
  for (std::size_t length = 0; length < file.size(); ++length)
    ASSERT_NE(error_of(std::span(file).first(length)), "no error") << length;
  EXPECT_NE(error_of(std::span(file).first(file.size() - 1)).find("is cut short"), std::string::npos);
  std::mt19937 random(2);
  std::vector<std::byte> other = file;
  for (std::size_t i = 0; i < file.size(); i += 1 + random() % 8) {
    other[i] = file[i] ^ std::byte(1u << random() % 8);
    ASSERT_NE(error_of(other), "no error") << i;
    other[i] = file[i];
  }
  other.push_back(std::byte{0});
  EXPECT_NE(error_of(other).find("do not add up"), std::string::npos);
}

// With a checksum that is right again, so that what is behind it is tried: no crash, and what is read is sound.
TEST(BakedFile, DamageBehindTheChecksumIsReadOrRefused) {
  // Pictures are decoded in processes of their own: few rounds with, many without.
  constexpr int kRounds = 1500, kTexturedRounds = 60;
  const std::vector<std::byte> plain = make_file(2, 3, false), textured = make_file(2, 3);
  std::mt19937 random(7);
  int refused = 0;
  for (int round = 0; round < kRounds; ++round) {
    const auto [text, binary] = split_glb(round < kTexturedRounds ? textured : plain, "a.glb");
    std::string json(text);
    std::vector<std::byte> bytes(binary.begin(), binary.end());
    for (std::size_t change = 0, changes = 1 + random() % 3; change < changes; ++change)
      if (random() % 4 > 0) {
        // Mostly a digit for a digit, which keeps it JSON.
        char& c = json[random() % json.size()];
        c = std::isdigit(static_cast<unsigned char>(c)) ? static_cast<char>('0' + random() % 10)
            : random() % 8 == 0                         ? static_cast<char>(random())
                                                        : c;
      } else {
        bytes[random() % bytes.size()] = std::byte(random() % 2 ? 255 : random() & 255);
      }
    const std::size_t checksum = json.find("\"checksum\":\"");
    if (checksum == std::string::npos || checksum + 28 > json.size()) continue;
    json.replace(checksum + 12, 16, kEmptyChecksum);
    try {
      const Baked baked = load_baked(make_glb(json, bytes, "a.glb"), "a.glb");
      ASSERT_EQ(baked.transfer.first_vertex.back(), num_vertices(baked.scene));
      ASSERT_EQ(baked.transfer.coefficients.size(),
                num_vertices(baked.scene) * static_cast<std::size_t>(baked.transfer.channels) *
                    static_cast<std::size_t>(num_coefficients(baked.transfer.bands)));
    } catch (const Error&) {
      ++refused;
    }
  }
  RecordProperty("refused", refused);
  EXPECT_GT(refused, kRounds / 20);
}

TEST(BakedFile, WhatIsWrongIsSaid) {
  const std::vector<std::byte> file = make_file();
  using Json = nlohmann::ordered_json;
  const auto expect = [&](const std::string& wrong, const std::function<void(Json&)>& change) {
    const std::string error = error_of(changed(file, change));
    EXPECT_NE(error.find(wrong), std::string::npos) << "expected: " << wrong << "\nis: " << error;
  };
  const auto extras = [](Json& root) -> Json& { return root["asset"]["extras"]["shlight"]; };
  const auto attributes = [](Json& root, int mesh) -> Json& {
    return root["meshes"][mesh]["primitives"][0]["attributes"];
  };
  EXPECT_EQ(error_of(changed(file, [](Json&) {})), "no error");
  expect("is of version 2: version 1", [&](Json& r) { extras(r)["version"] = 2; });
  expect("version is no whole number", [&](Json& r) { extras(r)["version"] = "new"; });
  expect("bands is 17 and not 1 to 16", [&](Json& r) { extras(r)["bands"] = 17; });
  expect("_SH_TRANSFER_1 is missing", [&](Json& r) { extras(r)["bands"] = 3; });
  expect("bytes are to come", [&](Json& r) { extras(r)["bands"] = 16; });
  expect("_SH_TRANSFER_R_0 is missing", [&](Json& r) { extras(r)["channels"] = 3; });
  expect("two channels", [&](Json& r) { extras(r)["channels"] = 2; });
  expect("a kind that is not known", [&](Json& r) { extras(r)["kind"] = "lit"; });
  expect("convention", [&](Json& r) { extras(r)["convention"]["condon_shortley_phase"] = true; });
  expect("hash is not of 16", [&](Json& r) { extras(r)["hash"] = "+123456789abcdef"; });
  expect("more than once", [](Json& r) {
    Json& roots = r["scenes"][0]["nodes"];
    for (int more = 0; more < 4; ++more) roots.push_back(roots[0]);
  });
  expect("is not a readable picture", [](Json& r) { r["images"][0]["bufferView"] = 0; });
  expect("byteOffset is", [](Json& r) { r["bufferViews"][0]["byteOffset"] = 1u << 30; });
  expect("byteLength is", [](Json& r) { r["bufferViews"][1]["byteLength"] = 1u << 30; });
  expect("byteLength is no whole number", [](Json& r) { r["bufferViews"][1]["byteLength"] = -1; });
  expect("an index into accessors", [&](Json& r) { attributes(r, 0)["NORMAL"] = 100000; });
  expect("an accessor that is no VEC4", [&](Json& r) { attributes(r, 0)["_SH_TRANSFER_0"] = 0; });
  expect("68 NORMAL for 14 vertices", [&](Json& r) { attributes(r, 0)["NORMAL"] = attributes(r, 1)["NORMAL"]; });
  expect("other than one primitive", [](Json& r) { r["meshes"][0]["primitives"] = Json::array(); });
  expect("an index into materials is 9", [](Json& r) { r["meshes"][0]["primitives"][0]["material"] = 9; });
  expect("an index into images is 5", [](Json& r) { r["textures"][0]["source"] = 5; });
  expect("flattens or mirrors", [](Json& r) { r["nodes"][1]["matrix"] = std::vector<int>(16, 1); });
  expect("outside of 0 to 1", [](Json& r) { r["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"][1] = 2; });
  expect("a metallicFactor outside of 0 to 1",
         [](Json& r) { r["materials"][1]["pbrMetallicRoughness"]["metallicFactor"] = 1.5; });
  expect("roughnessFactor is missing",
         [](Json& r) { r["materials"][1]["pbrMetallicRoughness"].erase("roughnessFactor"); });
  expect("an estimated_error below 0", [&](Json& r) { extras(r)["estimated_error"] = -0.1; });
  expect("no nodes", [](Json& r) { r["scenes"][0]["nodes"] = Json::array(); });
  expect("accessors are missing", [](Json& r) { r.erase("accessors"); });
  expect("its JSON is too deep", [](Json& r) {
    for (int depth = 0; depth < 30; ++depth) r["nodes"] = Json::array({r["nodes"]});
  });
}

// A NaN, and an index of a vertex that is not there, in the binary chunk.
TEST(BakedFile, BadValuesAreRefused) {
  const Scene scene = make_busy_scene();
  const auto error_with = [&](const Scene& s, const Transfer& t) { return error_of(format_baked(s, t, {}, "a.glb")); };
  const Transfer good = make_any_transfer(scene, 2, 1);
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    Transfer transfer = good;
    transfer.coefficients[17] = bad;
    EXPECT_NE(error_with(scene, transfer).find("not finite"), std::string::npos);
    transfer = good;
    transfer.bent_normals[3].y = bad;
    EXPECT_NE(error_with(scene, transfer).find("not finite"), std::string::npos);
    Scene other = scene;
    other.meshes[0].positions[2].z = bad;
    EXPECT_NE(error_with(other, good), "no error");
  }
  Scene other = scene;
  other.meshes[0].indices[4] = static_cast<std::uint32_t>(other.meshes[0].positions.size());
  EXPECT_NE(error_with(other, good).find("is malformed: vertex"), std::string::npos);
  other = scene;
  other.meshes[1].colors[2].y = 1.5f;
  EXPECT_NE(error_with(other, good).find("a colour outside"), std::string::npos);
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
