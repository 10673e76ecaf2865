#include "shlight/transfer/contacts.h"

#include <gtest/gtest.h>

#include <limits>

#include "shlight/scene/shapes.h"
#include "shlight/scene/transform.h"
#include "shlight/sh/rotation.h"
#include "shlight/transfer/tracer.h"
#include "shlight/transfer/transfer_test_util.h"

namespace shlight {
namespace {

// A box that stands on a floor or a wall, all turned as one, so that no plane is exactly in floats.
struct Still {
  WorldMesh world;
  Sites sites;
  std::unique_ptr<Tracer> tracer;
  Rotation turn;
};

Still make_still(Scene scene, float degrees) {
  const Mat4f turn = make_rotation({1, 2, 3}, degrees);
  for (Instance& instance : scene.instances) instance.to_world = turn;
  Still still;
  still.world = make_world_mesh(scene);
  still.sites = make_sites(still.world, 0);
  still.tracer = make_embree_tracer(still.world.positions, still.world.indices);
  const auto row = [&](std::size_t i) { return Vec3d{turn[i], turn[4 + i], turn[8 + i]}; };
  still.turn = {{row(0), row(1), row(2)}};
  return still;
}

bool is_occluded(const Still& still, std::size_t site, Vec3d direction) {
  Ray ray;
  ray.origin = still.sites.origins[site];
  const Vec3d d = still.turn((1 / std::sqrt(dot(direction, direction))) * direction);
  ray.direction = vec_cast<float>(d);
  ray.far = std::numeric_limits<float>::infinity();
  still.tracer->find_occluded(std::span(&ray, 1));
  return ray.far < 0;
}

// The sites of a mesh's vertices whose place and normal, before the turn, satisfy a condition.
template <class Condition>
std::vector<std::size_t> sites_where(const Still& still, const Scene& scene, std::size_t instance,
                                     const Condition& condition) {
  std::vector<std::size_t> result;
  const Mesh& mesh = scene.meshes[instance];
  for (std::size_t v = 0; v < mesh.positions.size(); ++v)
    if (condition(mesh.positions[v], mesh.normals[v]))
      result.push_back(still.sites.of_vertex[still.world.first_vertex[instance] + v]);
  return result;
}

class Contacts : public testing::TestWithParam<float> {};
INSTANTIATE_TEST_SUITE_P(Turns, Contacts, testing::Values(0.0f, 17.0f, 123.0f));

TEST_P(Contacts, FeetOfABoxOnAFloorDoNotSeeThroughIt) {
  const Scene scene =
      make_test_scene({make_sheet({-3, 0, 3}, {6, 0, 0}, {0, 0, -6}, 7), make_box({-1, 0, -1}, {1, 1, 1}, 4, true)});
  const Still still = make_still(scene, GetParam());
  const auto feet = sites_where(still, scene, 1, [](Vec3f p, Vec3f n) { return p.y == 0 && n.x == 1; });
  ASSERT_EQ(feet.size(), 5u);
  for (const std::size_t site : feet)
    for (const double down : {1e-3, 1e-2, 0.1, 1.0, 30.0}) {
      EXPECT_TRUE(is_occluded(still, site, {1, -down, 0.3})) << "falls by " << down;
      EXPECT_FALSE(is_occluded(still, site, {1, down, 0.3})) << "rises by " << down;
    }
}

TEST_P(Contacts, FloorBesideAWallSeesTheWallAndTheSky) {
  // A wall of a single sheet whose front looks away from the floor: the floor's own side counts, not the wall's.
  const Scene scene = make_test_scene(
      {make_sheet({0, 0, 1}, {2, 0, 0}, {0, 0, -2}, 4), make_sheet({0, 0, 1}, {0, 2, 0}, {0, 0, -2}, 4)});
  ASSERT_LT(scene.meshes[1].normals[0].x, 0);
  const Still still = make_still(scene, GetParam());
  const auto foot = sites_where(still, scene, 0, [](Vec3f p, Vec3f) { return p.x == 0 && std::abs(p.z) < 0.9f; });
  ASSERT_EQ(foot.size(), 3u);
  for (const std::size_t site : foot)
    for (const double side : {1e-3, 0.1, 1.0}) {
      EXPECT_TRUE(is_occluded(still, site, {-side, 1, 0.1}));
      EXPECT_FALSE(is_occluded(still, site, {side, 1, 0.1}));
    }
}

TEST_P(Contacts, ASharpValleyHidesWhatItsSidesHide) {
  // Two sheets that meet at the line x = z = 0, 8 degrees apart, with one normal along the line.
  const float slope = std::tan(4 * 3.14159265f / 180);
  Mesh valley;
  valley.positions = {{0, 0, 1}, {0, 0, -1}, {slope, 1, 1}, {slope, 1, -1}, {-slope, 1, 1}, {-slope, 1, -1}};
  valley.normals = {{0, 1, 0}, {0, 1, 0}, {-1, 0, 0}, {-1, 0, 0}, {1, 0, 0}, {1, 0, 0}};
  valley.indices = {0, 2, 1, 1, 2, 3, 0, 1, 4, 1, 5, 4};
  const Still still = make_still(make_test_scene({valley}), GetParam());
  const std::size_t site = still.sites.of_vertex[0];
  for (const double side : {-2.0, -1.0, -0.2, 0.2, 1.0, 2.0})
    EXPECT_TRUE(is_occluded(still, site, {side, 1, -0.5})) << "to the side by " << side;
  for (const double side : {-0.03, 0.0, 0.03})
    EXPECT_FALSE(is_occluded(still, site, {side, 1, -0.5})) << "to the side by " << side;
}

TEST(ContactsAlone, OriginsOfSmoothClosedShapesLieOnTheirNormals) {
  TorusKnotParams knot;
  knot.along = 96, knot.around = 16;
  const WorldMesh world = make_world_mesh(make_test_scene({make_torus_knot(knot), make_sphere(4, 24)}));
  const Sites sites = make_sites(world, 0);
  for (std::size_t site = 0; site < sites.size(); ++site) {
    const Vec3d way = vec_cast<double>(sites.origins[site] - sites.positions[site]);
    const double length = std::sqrt(dot(way, way));
    EXPECT_LT(length, 3e-6 * double{world.radius});
    // To what rounding leaves of so short a way.
    EXPECT_GT(dot(way, vec_cast<double>(sites.normals[site])), 0.8 * length);
  }
}

}  // namespace
}  // namespace shlight
