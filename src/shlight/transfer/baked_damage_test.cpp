// Baked files that are not what save_baked wrote.

#include <gtest/gtest.h>

#include <array>
#include <cctype>
#include <functional>
#include <limits>
#include <random>

#include "shlight/core/file.h"
#include "shlight/core/temporary_folder.h"
#include "shlight/transfer/baked_test_util.h"

namespace shlight {
namespace {

TEST(BakedDamage, IsKnownByItsHead) {
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

TEST(BakedDamage, EveryCutAndEveryChangedByteIsRefused) {
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
TEST(BakedDamage, DamageBehindTheChecksumIsReadOrRefused) {
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

TEST(BakedDamage, WhatIsWrongIsSaid) {
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
TEST(BakedDamage, BadValuesAreRefused) {
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

}  // namespace
}  // namespace shlight
