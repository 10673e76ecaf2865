#include "shlight/transfer/surfaces.h"

#include <gtest/gtest.h>

#include "shlight/transfer/transfer_test_util.h"

namespace shlight {
namespace {

// One triangle of z = 0 that faces +Z.
Mesh make_triangle() {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.normals = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
  mesh.indices = {0, 1, 2};
  return mesh;
}

constexpr Vec3f kDown = {0, 0, -1}, kUp = {0, 0, 1};

TEST(Surfaces, ReflectanceIsMaterialTimesColorTimesTexture) {
  Mesh mesh = make_triangle();
  mesh.colors = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.texcoords = {{0.25f, 0.5f}, {2.25f, 0.5f}, {0.25f, -3.5f}};  // the left texel's middle, whole repeats away
  Scene scene = make_test_scene({mesh}, {0.5f, 1, 3});
  scene.textures.push_back({2, 1, {188, 188, 188, 255, 255, 0, 0, 255}});
  scene.materials[0].texture = 0;
  const WorldMesh world = make_world_mesh(scene);
  const Surfaces surfaces(scene, world);
  const auto corner = surfaces.meet({0, 0, 0}, kDown);
  ASSERT_TRUE(corner);
  const double grey = std::pow((188 / 255.0 + 0.055) / 1.055, 2.4);
  EXPECT_NEAR(corner->reflectance.x, 0.5 * grey, 1e-6);
  EXPECT_EQ(corner->reflectance.y, 0);
  // The material's blue is more than all light: clamped.
  const auto blue = surfaces.meet({0, 0, 1}, kDown);
  ASSERT_TRUE(blue);
  EXPECT_EQ(blue->reflectance.z, 1);
  // Half way between the texels' middles, both count.
  const auto between = surfaces.meet({0, 0.125f, 0}, kDown);
  ASSERT_TRUE(between);
  EXPECT_NEAR(between->reflectance.x, 0.5 * 0.875 * (grey + 1) / 2, 1e-6);
}

TEST(Surfaces, BacksReflectNothing) {
  const Scene scene = make_test_scene({make_triangle()});
  const WorldMesh world = make_world_mesh(scene);
  const Surfaces surfaces(scene, world);
  EXPECT_TRUE(surfaces.meet({0, 0.2f, 0.3f}, kDown));
  EXPECT_FALSE(surfaces.meet({0, 0.2f, 0.3f}, kUp));
}

TEST(Surfaces, NormalsSayWhichSideIsTheFront) {
  Mesh mesh = make_triangle();
  mesh.indices = {0, 2, 1};
  const Scene scene = make_test_scene({mesh});
  const WorldMesh world = make_world_mesh(scene);
  const Surfaces surfaces(scene, world);
  EXPECT_TRUE(surfaces.meet({0, 0.2f, 0.3f}, kDown));
  EXPECT_FALSE(surfaces.meet({0, 0.2f, 0.3f}, kUp));
}

TEST(Surfaces, OfADoubleSidedSheetTheFacingSideAnswers) {
  Mesh sheet = make_triangle(), back = make_triangle();
  back.indices = {1, 0, 2};
  for (Vec3f& normal : back.normals) normal = {0, 0, -1};
  append(sheet, back);
  const Scene scene = make_test_scene({sheet});
  const WorldMesh world = make_world_mesh(scene);
  const Surfaces surfaces(scene, world);
  for (const std::uint32_t named : {0u, 1u})
    for (const Vec3f direction : {kDown, kUp}) {
      const Hit hit = {named, 0.2f, 0.3f};
      const auto point = surfaces.meet(hit, direction);
      ASSERT_TRUE(point);
      // The same place, on the side that the ray sees.
      Vec3f expected, met;
      const float weights[3] = {0.5f, 0.2f, 0.3f};
      for (std::size_t k = 0; k < 3; ++k) {
        expected = expected + weights[k] * world.positions[world.indices[3 * named + k]];
        met = met + point->weights[k] * world.positions[point->vertices[k]];
        EXPECT_LT(dot(world.normals[point->vertices[k]], direction), 0);
      }
      EXPECT_NEAR(met.x, expected.x, 1e-6);
      EXPECT_NEAR(met.y, expected.y, 1e-6);
    }
}

}  // namespace
}  // namespace shlight
