#include "shlight/scene/pick.h"

#include <gtest/gtest.h>

#include <cmath>

#include "shlight/scene/shapes.h"

namespace shlight {
namespace {

// Two balls behind each other, seen along −Z.
Scene two_balls() {
  Scene scene;
  scene.meshes.push_back(make_sphere(1, 40));
  scene.materials.emplace_back();
  scene.instances.resize(2);
  scene.instances[0].to_world[14] = -3;
  scene.instances[1].to_world[14] = 3;
  return scene;
}

TEST(Pick, FindsTheVertexInFront) {
  const Scene scene = two_balls();
  Camera camera;
  camera.azimuth = camera.elevation = 0;
  const auto picked = pick_vertex(scene, make_view(camera, scene_extent(scene), 1.5), 0, 0);
  ASSERT_TRUE(picked);
  EXPECT_NEAR(picked->position.z, 4, 0.01);
  EXPECT_NEAR(std::hypot(picked->position.x, picked->position.y), 0, 0.1);
  const std::size_t first = scene.meshes[0].positions.size();
  ASSERT_GE(picked->vertex, first) << "of the second instance";
  const Vec3f p = scene.meshes[0].positions[picked->vertex - first];
  EXPECT_NEAR(p.z + 3, picked->position.z, 1e-6);
}

TEST(Pick, FindsWhatIsAtThePointOfWidePictures) {
  const Scene scene = two_balls();
  Camera camera;
  camera.azimuth = 90, camera.elevation = 0;  // looks along −X: the second ball, at +Z, is at the left
  const View view = make_view(camera, scene_extent(scene), 2);
  const auto front = place_in_picture(view, {1, 0, 3});
  ASSERT_TRUE(front);
  EXPECT_LT(front->x, 0);
  EXPECT_NEAR(front->y, 0, 1e-12);
  const auto picked = pick_vertex(scene, view, front->x, 0);
  ASSERT_TRUE(picked);
  EXPECT_NEAR(picked->position.x, 1, 0.02);
  EXPECT_NEAR(picked->position.z, 3, 0.15);
  EXPECT_FALSE(pick_vertex(scene, view, front->x, 0.95)) << "above it there is nothing";
}

}  // namespace
}  // namespace shlight
