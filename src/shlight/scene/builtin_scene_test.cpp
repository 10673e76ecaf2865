#include "shlight/scene/builtin_scene.h"

#include <gtest/gtest.h>

#include <numbers>

#include "shlight/scene/scene_test_util.h"

namespace shlight {
namespace {

TEST(BuiltinScene, SphereIsTheUnitSphere) {
  const Scene scene = make_sphere_scene();
  expect_valid(scene);
  EXPECT_EQ(num_vertices(scene), 2u + 63 * 128);
  EXPECT_NEAR(signed_volume(scene), 4 * std::numbers::pi / 3, 5e-3);
  const Bounds bounds = world_bounds(scene).value();
  EXPECT_EQ(bounds.min.y, -1);
  EXPECT_EQ(bounds.max.y, 1);
}

TEST(BuiltinScene, KnotFitsTheUnitSphere) {
  const Scene scene = make_knot_scene();
  expect_valid(scene);
  EXPECT_EQ(topology(scene.meshes[0]).euler_characteristic, 0);
  float farthest = 0;
  for (const Vec3f& p : scene.meshes[0].positions) farthest = std::max(farthest, dot(p, p));
  EXPECT_NEAR(farthest, 1, 1e-4);
}

TEST(BuiltinScene, StillLifeIsMadeOfClosedThings) {
  const Scene scene = make_still_life_scene();
  expect_valid(scene);
  for (const Mesh& mesh : scene.meshes) {
    SCOPED_TRACE(mesh.name);
    EXPECT_TRUE(topology(mesh).is_closed);
    EXPECT_GT(signed_volume(mesh), 0);
    EXPECT_GT(least_normal_agreement(mesh), 0.9);
  }
  const Bounds bounds = world_bounds(scene).value();
  EXPECT_LT(bounds.max.y - bounds.min.y, 1);
  EXPECT_NEAR(bounds.max.x - bounds.min.x, 1.92, 0.01);
}

// All but the floor stand on it or on something that does: nothing sinks in, nothing floats.
TEST(BuiltinScene, StillLifeRestsOnItsFloor) {
  const Scene scene = make_still_life_scene();
  int on_floor = 0;
  for (const Instance& instance : scene.instances) {
    float lowest = 1;
    for (const Vec3f& p : scene.meshes[instance.mesh].positions)
      lowest = std::min(lowest, transform_point(instance.to_world, p).y);
    if (scene.meshes[instance.mesh].name == "floor") continue;
    EXPECT_GT(lowest, 0) << scene.meshes[instance.mesh].name;
    on_floor += lowest < 1e-3f;
  }
  EXPECT_EQ(on_floor, static_cast<int>(scene.instances.size()) - 3);  // the floor, the bench's slab and the knot on it
}

}  // namespace
}  // namespace shlight
