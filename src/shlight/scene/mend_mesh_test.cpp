#include "shlight/scene/mend_mesh.h"

#include <gtest/gtest.h>

#include <limits>

#include "shlight/scene/scene_test_util.h"
#include "shlight/scene/shapes.h"

namespace shlight {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

TEST(MendMesh, SoundMeshStaysAsItIs) {
  const Mesh sphere = make_sphere(1, 8);
  MeshFaults faults;
  const Mesh mended = mend_mesh(sphere, 60, faults);
  expect_valid(mended);
  EXPECT_EQ(mended.positions.size(), sphere.positions.size());
  EXPECT_EQ(mended.indices.size(), sphere.indices.size());
  EXPECT_EQ(signed_volume(mended), signed_volume(sphere));
  EXPECT_EQ(faults.degenerate_triangles + faults.non_finite_triangles + faults.bad_normals + faults.bad_attributes, 0u);
}

TEST(MendMesh, LeavesOutWhatCannotBeDrawn) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}, {kNaN, 0, 0}, {0, kInfinity, 0}, {9, 9, 9}, {1, 0, 0}};
  mesh.indices = {0, 1, 2, 0, 1, 3, 0, 1, 1, 1, 7, 2, 0, 1, 4, 5, 1, 2};
  MeshFaults faults;
  const Mesh mended = mend_mesh(mesh, 60, faults);
  expect_valid(mended);
  EXPECT_EQ(mended.indices.size(), 3u);
  EXPECT_EQ(mended.positions.size(), 3u);
  EXPECT_EQ(faults.degenerate_triangles, 3u);
  EXPECT_EQ(faults.non_finite_triangles, 2u);
}

TEST(MendMesh, KeepsTheThinnestTriangle) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0.5f, 1e-37f, 0}};
  mesh.indices = {0, 1, 2};
  MeshFaults faults;
  const Mesh mended = mend_mesh(mesh, 60, faults);
  expect_valid(mended);
  EXPECT_EQ(mended.normals[0], (Vec3f{0, 0, 1}));
}

TEST(MendMesh, MakesBadNormalsAnewAndKeepsTheGood) {
  Mesh sphere = make_sphere(1, 16);
  sphere.normals[20] = {0, 0, 0};
  sphere.normals[21] = {kNaN, 0, 1};
  sphere.normals[22] = {0, 0, 100};
  MeshFaults faults;
  const Mesh mended = mend_mesh(sphere, 60, faults);
  expect_valid(mended);
  EXPECT_GT(faults.bad_normals, 0u);
  for (std::size_t i = 0; i < mended.positions.size(); ++i) {
    const bool is_given = mended.positions[i] == sphere.positions[22];
    EXPECT_GT(dot(mended.normals[i], is_given ? Vec3f{0, 0, 1} : mended.positions[i]), 0.99f);
  }
}

TEST(MendMesh, MissingNormalsSplitVerticesAtCreases) {
  Mesh box = make_rounded_box({1, 1, 1}, 0.4f, 1, 1);
  box.normals.clear();
  MeshFaults faults;
  EXPECT_EQ(mend_mesh(box, 180, faults).positions.size(), box.positions.size());
  const Mesh flat = mend_mesh(box, 0, faults);
  expect_valid(flat);
  EXPECT_GT(flat.positions.size(), box.positions.size());
}

TEST(MendMesh, MendsAttributes) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.texcoords = {{0.5f, 2}, {kNaN, 0}, {1, 1}};
  mesh.colors = {{0.5f, 2, -1}, {1, 1, 1}, {kInfinity, 0, 0}};
  mesh.indices = {0, 1, 2};
  MeshFaults faults;
  const Mesh mended = mend_mesh(mesh, 60, faults);
  expect_valid(mended);
  EXPECT_EQ(mended.texcoords, (std::vector<Vec2f>{{0.5f, 2}, {0, 0}, {1, 1}}));
  EXPECT_EQ(mended.colors, (std::vector<Vec3f>{{0.5f, 1, 0}, {1, 1, 1}, {1, 1, 1}}));
  EXPECT_EQ(faults.bad_attributes, 2u);
}

TEST(MendMesh, MirrorImageIsNotInsideOut) {
  const Mesh box = make_rounded_box({1, 2, 3}, 0.1f, 2, 1);
  const Mesh image = mirror_mesh(box);
  expect_valid(image);
  EXPECT_NEAR(signed_volume(image), signed_volume(box), 1e-6);
  EXPECT_GT(least_normal_agreement(image), 0.9);
}

}  // namespace
}  // namespace shlight
