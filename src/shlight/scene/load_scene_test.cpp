#include "shlight/scene/load_scene.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>

#include "shlight/core/error.h"
#include "shlight/core/temporary_folder.h"
#include "shlight/scene/scene_test_util.h"

namespace shlight {
namespace {

namespace fs = std::filesystem;

constexpr float kNearlyEqual = 1e-5f;

// A unit cube's corners as half of its sides need them: bits 0, 1, 2 are x, y, z.
const std::string kObjCube = [] {
  std::string text;
  for (int i = 0; i < 8; ++i) text += fmt::format("v {} {} {}\n", i & 1, i >> 1 & 1, i >> 2 & 1);
  return text + "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
}();

// A one-pixel picture, portable pixmap: (255, 0, 0).
const std::string kRedPicture = std::string("P6\n1 1\n255\n\xff\x00\x00", 14);

std::string base64(std::string_view bytes) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k)
      word = word << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += i + k <= bytes.size() ? kDigits[word >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

class LoadSceneTest : public testing::Test {
 protected:
  fs::path write(const std::string& name, const std::string& text) {
    const fs::path path = folder_.path() / name;
    fs::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << text;
    return path;
  }
  Scene load(const std::string& name, const std::string& text) {
    const Scene scene = load_scene(write(name, text));
    expect_valid(scene);
    return scene;
  }
  // The Error's text without the path at its head.
  std::string error_of(const fs::path& path, const LoadSceneParams& params = {}) {
    try {
      load_scene(path, params);
    } catch (const Error& error) {
      const std::string text = error.what();
      EXPECT_EQ(text.substr(0, path.string().size() + 2), path.string() + ": ");
      return text.substr(std::min(text.size(), path.string().size() + 2));
    }
    return "no error";
  }
  std::string error_of(const std::string& name, const std::string& text) { return error_of(write(name, text)); }

  TemporaryFolder folder_;
};

testing::AssertionResult starts_with(const std::string& text, const std::string& start) {
  if (text.starts_with(start)) return testing::AssertionSuccess();
  return testing::AssertionFailure() << '"' << text << "\" does not start with \"" << start << '"';
}

// The same cube in every format: closed, counter-clockwise from outside, sharp at its edges.
void expect_unit_cube(const Scene& scene) {
  EXPECT_EQ(num_triangles(scene), 12u);
  EXPECT_EQ(num_vertices(scene), 24u);
  EXPECT_NEAR(signed_volume(scene), 1, kNearlyEqual);
  ASSERT_EQ(scene.meshes.size(), 1u);
  EXPECT_TRUE(topology(scene.meshes[0]).is_closed);
  EXPECT_EQ(topology(scene.meshes[0]).euler_characteristic, 2);
  EXPECT_GT(least_normal_agreement(scene.meshes[0]), 0.9999);
  EXPECT_TRUE(scene.warnings.empty());
}

TEST_F(LoadSceneTest, Obj) {
  expect_unit_cube(load("cube.obj", kObjCube));
}

TEST_F(LoadSceneTest, Off) {
  expect_unit_cube(load("cube.off",
                        "OFF\n8 6 12\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 0 1\n1 0 1\n0 1 1\n1 1 1\n"
                        "4 0 2 3 1\n4 4 5 7 6\n4 0 1 5 4\n4 2 6 7 3\n4 0 4 6 2\n4 1 3 7 5\n"));
}

TEST_F(LoadSceneTest, PlyWithVertexColors) {
  std::string text =
      "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 6\n"
      "property list uchar int vertex_indices\nend_header\n";
  for (int i = 0; i < 8; ++i) text += fmt::format("{} {} {} 188 255 0\n", i & 1, i >> 1 & 1, i >> 2 & 1);
  const Scene scene = load("cube.ply", text + "4 0 2 3 1\n4 4 5 7 6\n4 0 1 5 4\n4 2 6 7 3\n4 0 4 6 2\n4 1 3 7 5\n");
  expect_unit_cube(scene);
  // 188 / 255 encodes half the light.
  ASSERT_FALSE(scene.meshes[0].colors.empty());
  EXPECT_NEAR(scene.meshes[0].colors[0].x, 0.5, 3e-3);
  EXPECT_EQ(scene.meshes[0].colors[0].y, 1);
  EXPECT_EQ(scene.meshes[0].colors[0].z, 0);
  EXPECT_EQ(scene.materials[0].base_color, (Vec3f{1, 1, 1}));
}

// An octahedron whose facet normals are ignored: at 120 degrees of crease it is as smooth as a sphere.
TEST_F(LoadSceneTest, StlIsSmoothed) {
  std::string text = "solid octahedron\n";
  for (const int x : {-1, 1})
    for (const int y : {-1, 1})
      for (const int z : {-1, 1}) {
        const std::string a = fmt::format("vertex {} 0 0\n", x), b = fmt::format("vertex 0 {} 0\n", y),
                          c = fmt::format("vertex 0 0 {}\n", z);
        text += fmt::format("facet normal {} {} {}\nouter loop\n", x, y, z) + a + (x * y * z > 0 ? b + c : c + b) +
                "endloop\nendfacet\n";
      }
  const fs::path path = write("octahedron.stl", text + "endsolid\n");
  const Scene sharp = load_scene(path);
  EXPECT_EQ(num_vertices(sharp), 24u);
  LoadSceneParams params;
  params.crease_degrees = 120;
  const Scene smooth = load_scene(path, params);
  expect_valid(smooth);
  EXPECT_EQ(num_vertices(smooth), 6u);
  EXPECT_NEAR(signed_volume(smooth), 4.0 / 3, kNearlyEqual);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_NEAR(dot(smooth.meshes[0].normals[i], smooth.meshes[0].positions[i]), 1, kNearlyEqual);
  }
}

// A left-handed format, with a frame's matrix: the tetrahedron is moved to x = 10 and its height, along the file's z,
// lies along our -z.
TEST_F(LoadSceneTest, TextXFile) {
  const Scene scene = load(
      "tetrahedron.x",
      "xof 0303txt 0032\n"
      "Frame Root {\n FrameTransformMatrix { 1.0,0.0,0.0,0.0, 0.0,1.0,0.0,0.0, 0.0,0.0,1.0,0.0, 10.0,0.0,0.0,1.0;; }\n"
      " Mesh Tetrahedron {\n  4;\n  0;0;0;,\n  1;0;0;,\n  0;1;0;,\n  0;0;2;;\n"
      "  4;\n  3;0,2,1;,\n  3;0,1,3;,\n  3;0,3,2;,\n  3;1,2,3;;\n"
      "  MeshMaterialList {\n   1;\n   4;\n   0,0,0,0;;\n   Material Grey {\n"
      "    0.735357;0.735357;1.0;1.0;;\n    0;\n    0;0;0;;\n    0;0;0;;\n   }\n  }\n }\n}\n");
  EXPECT_EQ(num_triangles(scene), 4u);
  EXPECT_NEAR(signed_volume(scene), 2.0 / 6, kNearlyEqual);
  const Bounds bounds = world_bounds(scene).value();
  EXPECT_NEAR(bounds.min.x, 10, kNearlyEqual);
  EXPECT_NEAR(bounds.min.z, -2, kNearlyEqual);
  EXPECT_NEAR(bounds.max.z, 0, kNearlyEqual);
  EXPECT_FALSE(scene.materials[0].gloss);
  // The file's colours are encoded.
  EXPECT_NEAR(scene.materials[0].base_color.x, 0.5, 1e-4);
  EXPECT_EQ(scene.materials[0].base_color.z, 1);
}

// One triangle, three vertices with texture coordinates, in a glTF with everything embedded. `node` goes into its node.
std::string gltf_triangle(const std::string& node, std::vector<float> positions = {0, 0, 0, 1, 0, 0, 0, 1, 0},
                          std::vector<std::uint16_t> indices = {0, 1, 2}, const std::string& image = "none.png") {
  const std::vector<float> texcoords = {0, 0, 1, 0, 0, 0.25f};
  std::string buffer;
  buffer.append(reinterpret_cast<const char*>(positions.data()), 36);
  buffer.append(reinterpret_cast<const char*>(texcoords.data()), 24);
  buffer.append(reinterpret_cast<const char*>(indices.data()), 6);
  return fmt::format(
      R"({{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0{}}}],)"
      R"("meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"TEXCOORD_0":1}},"indices":2,"material":0}}]}}],)"
      R"("materials":[{{"pbrMetallicRoughness":{{"baseColorFactor":[0.5,0.25,1,1],"metallicFactor":0.25,"baseColorTexture":{{"index":0}}}}}}],)"
      R"("textures":[{{"source":0}}],"images":[{{"uri":"{}"}}],"buffers":[{{"byteLength":66,"uri":)"
      R"("data:application/octet-stream;base64,{}"}}],"bufferViews":[{{"buffer":0,"byteLength":36}},)"
      R"({{"buffer":0,"byteOffset":36,"byteLength":24}},{{"buffer":0,"byteOffset":60,"byteLength":6}}],"accessors":[)"
      R"({{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}},)"
      R"({{"bufferView":1,"componentType":5126,"count":3,"type":"VEC2"}},)"
      R"({{"bufferView":2,"componentType":5123,"count":3,"type":"SCALAR"}}]}})",
      node, image, base64(buffer));
}

TEST_F(LoadSceneTest, GltfColorsAreLinearAndTexcoordsStartAtTheTop) {
  const Scene scene = load("a.gltf", gltf_triangle(""));
  EXPECT_EQ(scene.materials[0].base_color, (Vec3f{0.5f, 0.25f, 1}));
  EXPECT_EQ(scene.materials[0].gloss, (MetallicRoughness{0.25f, 1}));
  ASSERT_EQ(scene.meshes[0].texcoords.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3f p = scene.meshes[0].positions[i];
    EXPECT_EQ(scene.meshes[0].texcoords[i], (Vec2f{p.x, 0.25f * p.y}));
  }
}

TEST_F(LoadSceneTest, GltfMatricesPlaceTheMesh) {
  const Scene scene = load("a.gltf", gltf_triangle(R"(,"translation":[5,6,7],"scale":[2,2,2])"));
  const Bounds bounds = world_bounds(scene).value();
  EXPECT_EQ(bounds.min, (Vec3f{5, 6, 7}));
  EXPECT_EQ(bounds.max, (Vec3f{7, 8, 7}));
}

// A mirroring node turns the triangle's corners around; its front, here +z, stays its front.
TEST_F(LoadSceneTest, MirroredInstanceIsNotInsideOut) {
  const Scene scene = load("a.gltf", gltf_triangle(R"(,"scale":[-1,1,1])"));
  const Bounds bounds = world_bounds(scene).value();
  EXPECT_EQ(bounds.min.x, -1);
  EXPECT_EQ(bounds.max.x, 0);
  const Mesh& mesh = scene.meshes[0];
  const Mat4f& to_world = scene.instances[0].to_world;
  EXPECT_EQ(transform_normal(to_world, mesh.normals[0]), (Vec3f{0, 0, 1}));
  EXPECT_GT(least_normal_agreement(mesh), 0.9999);
}

TEST_F(LoadSceneTest, FlattenedInstanceIsNothing) {
  EXPECT_TRUE(
      starts_with(error_of("a.gltf", gltf_triangle(R"(,"scale":[1,1,0])")), "holds no triangles: a model with"));
}

TEST_F(LoadSceneTest, ObjTexcoordsStartAtTheTop) {
  const Scene scene = load("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 1\nvt 1 1\nvt 0 0.25\nf 1/1 2/2 3/3\n");
  EXPECT_EQ(scene.meshes[0].texcoords, (std::vector<Vec2f>{{0, 0}, {1, 0}, {0, 0.75f}}));
}

// A textured OBJ, whose material library names the texture as `map`.
const std::string kTexturedObj = "mtllib a.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n";
std::string material_with(const std::string& map) {
  return "newmtl m\nKd 1 1 1\nmap_Kd " + map + "\n";
}

TEST_F(LoadSceneTest, TexturesAreFoundHoweverTheyAreNamed) {
  write("red.ppm", kRedPicture);
  write("maps/blue.ppm", std::string("P6\n1 1\n255\n\x00\x00\xff", 14));
  for (const char* map : {"red.ppm", "C:\\work\\art\\red.ppm", "../../red.ppm", "maps\\blue.ppm", "maps/blue.ppm"}) {
    SCOPED_TRACE(map);
    write("a.mtl", material_with(map));
    const Scene scene = load("a.obj", kTexturedObj);
    EXPECT_TRUE(scene.warnings.empty());
    ASSERT_EQ(scene.textures.size(), 1u);
    EXPECT_EQ(scene.materials[0].texture, 0u);
    const bool is_red = std::strstr(map, "red") != nullptr;
    using Values = std::vector<unsigned char>;
    EXPECT_EQ(scene.textures[0].values, is_red ? (Values{255, 0, 0, 255}) : (Values{0, 0, 255, 255}));
  }
}

TEST_F(LoadSceneTest, MissingBadAndForeignTexturesAreWarnings) {
  write("secret.ppm", kRedPicture);
  write("model/bad.ppm", "P6\n1");
  for (const char* map : {"missing.png", "bad.ppm", "../secret.ppm", "..\\secret.ppm"}) {
    SCOPED_TRACE(map);
    write("model/a.mtl", material_with(map));
    const Scene scene = load("model/a.obj", kTexturedObj);
    EXPECT_TRUE(scene.textures.empty());
    EXPECT_FALSE(scene.materials[0].texture);
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_TRUE(scene.warnings[0].starts_with("texture ")) << scene.warnings[0];
  }
}

TEST_F(LoadSceneTest, PartsOutsideOfTheFolderAreNotRead) {
  write("secret.mtl", "newmtl m\nKd 0 0 0\n");
  const Scene scene = load("model/a.obj", "mtllib ../secret.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_NE(scene.materials[0].base_color, Vec3f{});
}

TEST_F(LoadSceneTest, EmbeddedTextureIsRead) {
  const std::string image = "data:image/x-portable-pixmap;base64," + base64(kRedPicture);
  const Scene scene = load("a.gltf", gltf_triangle("", {0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2}, image));
  ASSERT_EQ(scene.textures.size(), 1u) << testing::PrintToString(scene.warnings);
  EXPECT_EQ(scene.textures[0].values, (std::vector<unsigned char>{255, 0, 0, 255}));
}

TEST_F(LoadSceneTest, BadTrianglesAreLeftOutWithAWarning) {
  // The quadrilateral's triangles stay; of the others one has a NaN, one no area.
  const Scene scene =
      load("a.off", "OFF\n6 3 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n2 0 0\nnan 0 0\n4 0 1 2 3\n3 0 1 4\n3 0 1 5\n");
  EXPECT_EQ(num_triangles(scene), 2u);
  EXPECT_EQ(num_vertices(scene), 4u);
  EXPECT_EQ(scene.warnings.size(), 2u) << testing::PrintToString(scene.warnings);
}

TEST_F(LoadSceneTest, NonFinitePositionsAreLeftOut) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(starts_with(error_of("a.gltf", gltf_triangle("", {0, 0, 0, nan, 0, 0, 0, 1, 0})), "holds no triangles"));
}

TEST_F(LoadSceneTest, IndicesOutOfRangeAreRefusedOrLeftOut) {
  const std::vector<float> positions = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  EXPECT_TRUE(starts_with(error_of("a.gltf", gltf_triangle("", positions, {0, 1, 60000})), "is malformed"));
  EXPECT_TRUE(starts_with(error_of("a.obj", "v 0 0 0\nv 1 0 0\nf 1 2 9\n"), "is malformed"));
  // assimp moves those of OFF into the range.
  load("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n");
}

TEST_F(LoadSceneTest, ErrorsNameWhatIsWrong) {
  EXPECT_TRUE(
      starts_with(error_of(folder_.path() / "none.obj"), "is not there: a model with triangles, such as .x .obj"));
  EXPECT_TRUE(starts_with(error_of(folder_.path()), "is a folder: a model"));
  EXPECT_TRUE(starts_with(error_of("empty.obj", ""), "is empty: a model"));
  EXPECT_TRUE(
      starts_with(error_of("a.unknown", "some text, long enough"), "is of no kind that is known here: a model"));
  EXPECT_TRUE(
      starts_with(error_of("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\np 1 2 3\n"), "holds no triangles: a model"));
  EXPECT_TRUE(starts_with(error_of("faceless.ply",
                                   "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n"
                                   "property float y\nproperty float z\nend_header\n0 0 0\n"),
                          "holds no triangles: a model"));
  LoadSceneParams params;
  params.max_file_bytes = 10;
  EXPECT_TRUE(starts_with(error_of(write("big.obj", kObjCube), params), "holds 1"));
  params = {};
  params.max_triangles = 11;
  EXPECT_EQ(error_of(write("cube.obj", kObjCube), params), "draws 12 triangles: at most 11");
}

TEST_F(LoadSceneTest, EveryTruncationLoadsOrIsRefused) {
  const std::string whole = gltf_triangle("");
  for (std::size_t size = 1; size < whole.size(); size += 97) {
    try {
      load("cut.gltf", whole.substr(0, size));
    } catch (const Error&) {
    }
  }
}

TEST(MakeScene, KnowsItsBuiltInModels) {
  EXPECT_EQ(make_scene("builtin:sphere").meshes.size(), 1u);
  EXPECT_EQ(make_scene("builtin:knot").meshes.size(), 1u);
  EXPECT_GT(make_scene("builtin:scene").meshes.size(), 5u);
  try {
    make_scene("builtin:teapot");
    FAIL() << "an unknown built-in model was made";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "builtin:teapot: is no built-in model: builtin:sphere, builtin:knot or builtin:scene");
  }
}

// Real files, where the environment says where they are.

class RealModels : public testing::Test {
 protected:
  void SetUp() override {
    const char* folder = std::getenv("SHLIGHT_TEST_DATA");
    if (!folder) GTEST_SKIP() << "SHLIGHT_TEST_DATA does not name a folder";
    folder_ = folder;
  }
  fs::path folder_;
};

TEST_F(RealModels, HaveTheirPolygons) {
  const std::map<std::string, std::size_t> triangles = {{"dx_cube_on_plane.x", 1073},
                                                        {"dx_Head_Sad.x", 34560},
                                                        {"dx_skullocc.x", 60339},
                                                        {"dx_sphere0.x", 108},
                                                        {"dx_teapot.x", 2256},
                                                        {"dx_tiger.x", 602},
                                                        {"spot.obj", 5856},
                                                        {"BoxTextured.glb", 12},
                                                        {"bun_zipper.ply", 69451},
                                                        {"Duck.glb", 4212},
                                                        {"dx_Cube.x", 12},
                                                        {"trimesh_sphere.ply", 1280},
                                                        {"trimesh_unit_sphere.STL", 1280}};
  for (const auto& [name, count] : triangles) {
    SCOPED_TRACE(name);
    const Scene scene = load_scene(folder_ / "models" / name);
    expect_valid(scene);
    EXPECT_EQ(num_triangles(scene), count);
    // Whether closed or not, all of them are right side out.
    EXPECT_GT(signed_volume(scene), 0);
  }
}

TEST_F(RealModels, BadFilesLoadOrAreRefused) {
  LoadSceneParams params;
  params.fence.seconds = 10;
  int loaded = 0, refused = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder_ / "bad/mesh")) {
    if (!entry.is_regular_file()) continue;
    SCOPED_TRACE(entry.path().string());
    try {
      expect_valid(load_scene(entry.path(), params));
      ++loaded;
    } catch (const Error& error) {
#ifndef SHLIGHT_SANITIZED  // the fence has no limit of memory then, and taking it all takes time
      EXPECT_EQ(std::string(error.what()).find("within"), std::string::npos) << error.what();
#else
      EXPECT_STRNE(error.what(), "");
#endif
      ++refused;
    }
  }
  EXPECT_GT(loaded, 0);
  EXPECT_GT(refused, 0);
}

}  // namespace
}  // namespace shlight
