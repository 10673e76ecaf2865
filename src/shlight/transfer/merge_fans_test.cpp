#include "shlight/transfer/merge_fans.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "shlight/scene/shapes.h"
#include "shlight/sh/sphere_samples.h"
#include "shlight/transfer/transfer_test_util.h"

namespace shlight {
namespace {

// A cone, its triangles' corners in each sequence in turn, from `first_corner` on.
struct Cone {
  std::vector<Vec3f> positions = {{0, 0.5f, 0}};
  std::vector<std::uint32_t> indices;
};
Cone make_cone(std::uint32_t rim, std::uint32_t first_corner, bool is_reversed) {
  Cone cone;
  for (std::uint32_t k = 0; k <= rim; ++k) {
    const double angle = 2 * std::numbers::pi * k / rim;
    cone.positions.push_back({static_cast<float>(std::cos(angle)), 0, static_cast<float>(-std::sin(angle))});
    if (k == rim) break;
    std::uint32_t corners[3] = {0, k + 1, k + 2};
    if (is_reversed) std::swap(corners[1], corners[2]);
    for (std::uint32_t c = 0; c < 3; ++c) cone.indices.push_back(corners[(c + first_corner + k) % 3]);
  }
  return cone;
}

TEST(MergeFans, LeavesModelsAlone) {
  const Mesh sphere = make_sphere(1, 64), knot = make_torus_knot({});
  for (const Mesh& mesh : {sphere, knot}) EXPECT_FALSE(merge_fans(mesh.positions, mesh.indices, 1e-7f));
  EXPECT_FALSE(merge_fans({}, {}, 1e-7f));
  const Cone small = make_cone(kLeastFan - 1, 0, false);
  EXPECT_FALSE(merge_fans(small.positions, small.indices, 1e-7f));
}

// The merged cone is within the tolerance of the true one, and its hits name points of the true one.
TEST(MergeFans, HitsLieOnTheFan) {
  constexpr float kTolerance = 1e-6f;
  // Embree's u and v of triangles as thin as these, seen from the distance 2: a quarter of what one of them is wide.
  constexpr double kTrueTo = 3e-5;
  for (const std::uint32_t first_corner : {0u, 1u, 2u})
    for (const bool is_reversed : {false, true}) {
      const Cone cone = make_cone(50'000, first_corner, is_reversed);
      const auto fans = merge_fans(cone.positions, cone.indices, kTolerance);
      ASSERT_TRUE(fans);
      // A circle's chord of the angle φ is off by φ²/8.
      const double pieces = 2 * std::numbers::pi / std::sqrt(8 * double{kTolerance});
      EXPECT_LT(static_cast<double>(fans->indices.size() / 3), 1.1 * pieces);
      EXPECT_EQ(fans->first_triangle.back(), 50'000u);

      const auto tracer = make_embree_tracer(cone.positions, cone.indices);
      std::vector<Ray> rays;
      for (const Vec3d& d : make_sphere_samples(1, 32, 1).directions) {
        if (std::hypot(d.x, d.z) > 0.999) continue;
        Ray ray;
        ray.origin = {static_cast<float>(d.x), 2, static_cast<float>(d.z)};
        ray.direction = {0, -1, 0};
        ray.far = std::numeric_limits<float>::infinity();
        rays.push_back(ray);
      }
      std::vector<Hit> hits(rays.size());
      tracer->find_hits(rays, hits);
      for (std::size_t j = 0; j < rays.size(); ++j) {
        ASSERT_LT(hits[j].triangle, 50'000u);
        const std::uint32_t* v = cone.indices.data() + 3 * hits[j].triangle;
        const Vec3f p = (1 - hits[j].u - hits[j].v) * cone.positions[v[0]] + hits[j].u * cone.positions[v[1]] +
                        hits[j].v * cone.positions[v[2]];
        EXPECT_NEAR(p.x, rays[j].origin.x, kTrueTo);
        EXPECT_NEAR(p.z, rays[j].origin.z, kTrueTo);
        EXPECT_NEAR(p.y, 0.5 * (1 - std::hypot(double{p.x}, double{p.z})), kTrueTo);
      }
    }
}

// A rim of teeth stays: nothing of it is straight.
TEST(MergeFans, KeepsWhatIsNotStraight) {
  Cone cone = make_cone(20'000, 0, false);
  for (std::size_t k = 1; k < cone.positions.size(); k += 2) cone.positions[k].y += 1e-3f;
  const auto fans = merge_fans(cone.positions, cone.indices, 1e-6f);
  ASSERT_TRUE(fans);
  EXPECT_EQ(fans->indices, cone.indices);
}

}  // namespace
}  // namespace shlight
