#include "shlight/transfer/bounce.h"

#include <gtest/gtest.h>

#include "shlight/scene/builtin_scene.h"
#include "shlight/scene/shapes.h"
#include "shlight/scene/transform.h"
#include "shlight/transfer/trace_occlusion.h"
#include "shlight/transfer/transfer_test_util.h"

namespace shlight {
namespace {

using std::numbers::pi;

BakeParams make_params(int samples, int bounces) {
  BakeParams params;
  params.kind = TransferKind::kInterreflected;
  params.samples = samples;
  params.bounces = bounces;
  return params;
}

// One bounce of light that leaves each site with the coefficients `light`; what reaches each vertex, in red.
std::vector<double> bounce_once(const Scene& scene, const std::function<float(Vec3f normal)>& light) {
  const WorldMesh world = make_world_mesh(scene);
  const Sites sites = make_sites(world, 0);
  const auto tracer = make_embree_tracer(world.positions, world.indices);
  const Surfaces surfaces(scene, world);
  const SamplePlan plan = make_fixed_plan(2, 4096, 1, 0);
  OcclusionWorkspace occlusion;
  trace_occlusion(*tracer, sites, 0, sites.size(), plan, 1, occlusion);
  std::vector<std::uint8_t> packed;
  for (const SiteOcclusion& o : occlusion.occlusion) pack_occlusion(plan, o, packed);
  std::vector<float> before(12 * sites.size()), after(12 * sites.size());
  for (std::size_t site = 0; site < sites.size(); ++site) before[12 * site] = light(sites.normals[site]);
  BounceWorkspace workspace;
  gather_bounce({*tracer, sites, surfaces, plan, 1, before}, 0, sites.size(), packed, after, workspace);
  std::vector<double> result;
  for (const std::uint32_t site : sites.of_vertex) result.push_back(double{after[12 * site]});
  return result;
}

// A closed box whose walls all shine alike: every point of it receives as much, and reflects ρ of it.
TEST(Bounce, ClosedBoxLitFromInsideReceivesAllThatItsWallsSend) {
  const Scene scene = make_test_scene({make_box({-1, -1, -1}, {1, 1, 1}, 4, false)}, {0.7f, 0.7f, 0.7f});
  for (const double received : bounce_once(scene, [](Vec3f) { return 1.0f; })) EXPECT_NEAR(received, 0.7, 0.01);
}

TEST(Bounce, OneWallSendsItsFormFactor) {
  // In a cube, the middle of a wall sees the opposite wall under 0.2394 (Howell B-3 with a = b = c: 4 times the factor
  // of a quarter) and the four others under a quarter of the rest each.
  const double opposite = 2 / pi * 2 * (0.5 / std::sqrt(1.25) * std::atan(0.5 / std::sqrt(1.25)));
  const Scene scene = make_test_scene({make_box({-1, -1, -1}, {1, 1, 1}, 4, false)}, {1, 1, 1});
  const std::vector<double> received = bounce_once(scene, [](Vec3f normal) { return normal.y > 0.5f ? 1.0f : 0.0f; });
  const Mesh& box = scene.meshes[0];
  int checked = 0;
  for (std::size_t v = 0; v < received.size(); ++v) {
    const Vec3f p = box.positions[v], n = box.normals[v];
    const Vec3f from_middle = p + n;  // a wall's middle lies at minus its normal
    if (dot(from_middle, from_middle) > 1e-6f) continue;
    const double expected = n.y < -0.5f ? opposite : n.y > 0.5f ? 0 : (1 - opposite) / 4;
    EXPECT_NEAR(received[v], expected, 0.01 * std::max(expected, 0.2));
    ++checked;
  }
  EXPECT_EQ(checked, 6);
}

// White furnace: where nothing absorbs light, all that is open becomes as bright as the light.
TEST(Bounce, WhiteFurnaceTendsToOne) {
  TorusKnotParams knot;
  knot.along = 160, knot.around = 20;
  Scene scene = make_test_scene({make_torus_knot(knot), make_sphere(1, 16)}, {1, 1, 1});
  scene.instances[1].to_world = make_translation({0, 0, 1.6f});
  double last = 1;
  for (const int bounces : {0, 2, 8, 32}) {
    const Transfer transfer = bake_transfer(scene, make_params(256, bounces));
    double missing = 0, largest = 0;
    for (std::size_t v = 0; v < transfer.num_vertices(); ++v)
      for (std::size_t c = 0; c < 3; ++c) {
        missing += std::abs(1 - under_uniform_light(transfer, v, c));
        largest = std::max(largest, under_uniform_light(transfer, v, c));
      }
    missing /= 3 * static_cast<double>(transfer.num_vertices());
    EXPECT_LT(largest, 1 + 1e-4) << "more light leaves than came, after " << bounces;
    EXPECT_LT(missing, 0.7 * last);
    last = missing;
  }
  EXPECT_LT(last, 0.01);
}

TEST(Bounce, NoBouncesAreShadowedTransfer) {
  const Scene scene = make_test_scene({make_sheet({-3, 0, 3}, {6, 0, 0}, {0, 0, -6}, 8), make_sphere(1, 16)});
  BakeParams params = make_params(256, 0);
  const Transfer none = bake_transfer(scene, params);
  params.kind = TransferKind::kShadowed;
  const Transfer shadowed = bake_transfer(scene, params);
  ASSERT_EQ(none.channels, 3);
  for (std::size_t v = 0; v < shadowed.num_vertices(); ++v)
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t i = 0; i < 25; ++i)
        ASSERT_EQ(none.coefficients[(3 * v + c) * 25 + i], shadowed.coefficients[25 * v + i]);
}

TEST(Bounce, ARedWallBleedsOntoAWhiteFloor) {
  Scene scene = make_test_scene(
      {make_sheet({0, 0, 2}, {4, 0, 0}, {0, 0, -4}, 8), make_sheet({0, 0, -2}, {0, 4, 0}, {0, 0, 4}, 8)},
      {0.9f, 0.9f, 0.9f});
  ASSERT_GT(scene.meshes[1].normals[0].x, 0);
  scene.materials[1].base_color = {0.8f, 0.1f, 0.0f};
  const Transfer transfer = bake_transfer(scene, make_params(1024, 1));
  // Beside the wall's middle. It hides up to half of the sky, itself as open as the floor leaves it (more than half).
  const std::size_t beside = 4 * 9 + 1;
  const double r = under_uniform_light(transfer, beside, 0), g = under_uniform_light(transfer, beside, 1),
               b = under_uniform_light(transfer, beside, 2), open = double{transfer.ambient_occlusion[beside]};
  EXPECT_NEAR(b, open, 1e-6);
  EXPECT_NEAR((g - b) / (r - b), 0.1 / 0.8, 1e-4);
  EXPECT_GT(r - b, 0.8 * 0.5 * (1 - open));
  EXPECT_LT(r - b, 0.8 * (1 - open));
}

}  // namespace
}  // namespace shlight
