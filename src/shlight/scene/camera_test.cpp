#include "shlight/scene/camera.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "shlight/scene/shapes_test_util.h"

namespace shlight {
namespace {

// m (v, 1), with the fourth component that the matrix makes divided out.
Vec3d transform(const Mat4d& m, Vec3d v) {
  const auto row = [&](std::size_t r) { return m[r] * v.x + m[4 + r] * v.y + m[8 + r] * v.z + m[12 + r]; };
  return 1 / row(3) * Vec3d{row(0), row(1), row(2)};
}

// In normalised device coordinates.
Vec3d project(const View& view, Vec3d p) {
  return transform(view.view_to_clip, transform(view.world_to_view, p));
}

// The largest |x|, |y|, |z| of the vertices in normalised device coordinates.
Vec3d largest_ndc(const View& view, const Scene& scene) {
  Vec3d largest;
  for (const Vec3f& p : scene.meshes[0].positions) {
    const Vec3d ndc = project(view, vec_cast<double>(p));
    largest = {std::max(largest.x, std::abs(ndc.x)), std::max(largest.y, std::abs(ndc.y)),
               std::max(largest.z, std::abs(ndc.z))};
  }
  return largest;
}

TEST(Camera, AzimuthAndElevationLookWhereTheySay) {
  struct Case {
    double azimuth, elevation;
    Vec3d right, up;
  };
  for (const Case& c : {Case{0, 0, {1, 0, 0}, {0, 1, 0}}, Case{90, 0, {0, 0, -1}, {0, 1, 0}},
                        Case{180, 0, {-1, 0, 0}, {0, 1, 0}}, Case{0, 90, {1, 0, 0}, {0, 0, -1}}}) {
    Camera camera;
    camera.azimuth = c.azimuth;
    camera.elevation = c.elevation;
    const View view = make_view(camera, {}, 1);
    const Vec3d right = project(view, 0.1 * c.right), up = project(view, 0.1 * c.up);
    const Vec3d toward = cross(c.right, c.up);
    EXPECT_GT(right.x, 0.01) << c.azimuth << " " << c.elevation;
    EXPECT_NEAR(right.y, 0, 1e-12);
    EXPECT_NEAR(up.x, 0, 1e-12);
    EXPECT_GT(up.y, 0.01) << c.azimuth << " " << c.elevation;
    EXPECT_LT(project(view, 0.1 * toward).z, project(view, -0.1 * toward).z) << "what is nearer has less depth";
  }
}

// Inside the picture from everywhere, and at least this much of its tighter axis.
constexpr double kLeastFill = 0.55;

TEST(Camera, FramesModelsOfAnyShapeSizeAndPlace) {
  for (const Vec3d half_axes : {Vec3d{1, 1, 1}, Vec3d{1, 0.05, 1}, Vec3d{0.1, 1, 0.1}, Vec3d{1, 0.3, 2}})
    for (const double size : {1e-20, 1.0, 1e18})
      for (const double aspect : {0.5, 1.0, 16.0 / 9, 3.0})
        for (const double elevation : {-90.0, -20.0, 0.0, 15.0, 60.0, 90.0}) {
          Mesh mesh = make_ellipsoid(size * half_axes, 24);
          const auto away = static_cast<float>(5 * size);
          for (Vec3f& p : mesh.positions) p = p + Vec3f{away, -away, away};
          const Scene scene = make_test_scene(mesh);
          Camera camera;
          camera.elevation = elevation;
          const Vec3d ndc = largest_ndc(make_view(camera, scene_extent(scene), aspect), scene);
          const auto where = testing::Message() << half_axes.y << " " << size << " " << aspect << " " << elevation;
          EXPECT_LT(std::max({ndc.x, ndc.y, ndc.z}), 1) << where;
          // From straight above a stick shows its tip only.
          if (std::abs(elevation) < 90) {
            EXPECT_GT(std::max(ndc.x, ndc.y), kLeastFill) << where;
          }
        }
}

TEST(Camera, DistanceDoesNotChangeWithAzimuth) {
  const Scene scene = make_test_scene(make_ellipsoid({3, 1, 0.2}));
  const Extent extent = scene_extent(scene);
  Camera camera;
  const double distance = make_view(camera, extent, 1.5).world_to_view[14];
  camera.azimuth = 77;
  EXPECT_NEAR(make_view(camera, extent, 1.5).world_to_view[14], distance, 1e-12);
}

TEST(Camera, ZoomIsSoManyTimesNearer) {
  Camera camera;
  const double distance = project(make_view(camera, {}, 1), {}).z;
  camera.zoom = 20;  // in the model
  const View view = make_view(camera, {}, 1);
  EXPECT_TRUE(std::isfinite(distance));
  EXPECT_LT(std::abs(project(view, {}).z), 1) << "the centre is still between near and far";
}

TEST(Camera, EmptyAndFlatScenesHaveAnExtent) {
  EXPECT_EQ(scene_extent({}).radius, 1);
  Mesh point = make_square();
  for (Vec3f& p : point.positions) p = {3, 4, 5};
  const Extent extent = scene_extent(make_test_scene(point));
  EXPECT_EQ(extent.radius, 1);
  EXPECT_EQ(extent.center, (Vec3d{3, 4, 5}));
  for (const double elevation : {0.0, 90.0}) {
    const Scene square = make_test_scene(make_square());
    Camera camera;
    camera.azimuth = 90;  // edge-on
    camera.elevation = elevation;
    EXPECT_LT(largest_ndc(make_view(camera, scene_extent(square), 1), square).y, 1);
  }
}

TEST(Camera, ExtentFollowsInstances) {
  Mat4f to_world = kIdentity;
  to_world[0] = to_world[5] = to_world[10] = 2;
  to_world[12] = 7;
  const Extent extent = scene_extent(make_test_scene(make_ellipsoid({1, 1, 1}), {1, 1, 1}, to_world));
  EXPECT_NEAR(extent.center.x, 7, 1e-5);
  EXPECT_NEAR(extent.radius, 2, 1e-5);
  EXPECT_NEAR(extent.half_height, 2, 1e-5);
}

TEST(Camera, TurnsAroundItsTarget) {
  const Extent extent = {{3, -2, 5}, 4, 3, 2};
  Camera camera;
  camera.target = {0.5, -0.25, 0.125};
  for (const double azimuth : {0.0, 70.0, 200.0})
    for (const double elevation : {-40.0, 0.0, 65.0}) {
      camera.azimuth = azimuth, camera.elevation = elevation;
      const Vec3d middle = project(make_view(camera, extent, 1.5), extent.center + extent.radius * camera.target);
      EXPECT_NEAR(middle.x, 0, 1e-12);
      EXPECT_NEAR(middle.y, 0, 1e-12);
    }
}

TEST(Camera, PlacesPointsWhereTheyAreDrawn) {
  const Extent extent = {{3, -2, 5}, 4, 3, 2};
  Camera camera;
  camera.azimuth = 70, camera.elevation = 20;
  const View view = make_view(camera, extent, 1.5);
  const Vec3d point = {2, -1, 6}, drawn = project(view, point);
  const auto place = place_in_picture(view, point);
  ASSERT_TRUE(place);
  EXPECT_NEAR(place->x, drawn.x, 1e-12);
  EXPECT_NEAR(place->y, drawn.y, 1e-12);
  camera.azimuth = 0, camera.elevation = 0;
  EXPECT_FALSE(place_in_picture(make_view(camera, {}, 1), {0, 0, 100})) << "behind the eye";
}

// A quarter of the picture's height is half of normalised device coordinates.
TEST(Camera, PanningMovesWhatIsAtTheTargetWithThePointer) {
  const Extent extent = {{3, -2, 5}, 4, 3, 2};
  constexpr double kAspect = 1.6;
  Camera camera;
  camera.azimuth = 130, camera.elevation = 25, camera.zoom = 2;
  const Vec3d held = extent.center;
  pan_camera(camera, extent, kAspect, 0.25, -0.125);
  const Vec3d moved = project(make_view(camera, extent, kAspect), held);
  EXPECT_NEAR(moved.x, 0.5 / kAspect, 1e-9);
  EXPECT_NEAR(moved.y, -0.25, 1e-9);
}

}  // namespace
}  // namespace shlight
