#include "shlight/transfer/ambient_occlusion.h"

#include <gtest/gtest.h>

#include "shlight/scene/shapes.h"
#include "shlight/scene/transform.h"
#include "shlight/transfer/cosine_transfer.h"
#include "shlight/transfer/transfer_test_util.h"

namespace shlight {
namespace {

using std::numbers::pi;

BakeParams make_params(int samples, int bands = 2) {
  BakeParams params;
  params.samples = samples;
  params.bands = bands;
  return params;
}

Vec3d unit(Vec3d v) {
  return (1 / std::sqrt(dot(v, v))) * v;
}

double degrees_between(Vec3f a, Vec3d b) {
  const Vec3d u = unit(vec_cast<double>(a)), across = cross(u, b);
  return 180 / pi * std::atan2(std::sqrt(dot(across, across)), dot(u, b));
}

TEST(AmbientOcclusion, OpenSurfacesAreOpenAlongTheirNormals) {
  for (const Vec3f normal : {Vec3f{0, 1, 0}, Vec3f{0, 0, -1}, Vec3f{0.36f, 0.48f, 0.8f}}) {
    std::vector<float> cosine(9);
    eval_cosine_transfer(3, std::span(&normal, 1), cosine);
    EXPECT_NEAR(eval_ambient_occlusion(cosine), 1, 1e-6);
    EXPECT_LT(degrees_between(eval_bent_normal(cosine, {1, 0, 0}), vec_cast<double>(normal)), 1e-4);
    // Half as open, but nowhere to lean to.
    for (float& c : cosine) c /= 2;
    EXPECT_NEAR(eval_ambient_occlusion(cosine), 0.5, 1e-6);
    EXPECT_LT(degrees_between(eval_bent_normal(cosine, {1, 0, 0}), vec_cast<double>(normal)), 1e-4);
  }
}

TEST(AmbientOcclusion, WhatIsClosedKeepsItsNormal) {
  const std::vector<float> none = {1e-7f, -1e-6f, 1e-6f, 0};
  EXPECT_NEAR(eval_ambient_occlusion(none), 0, 1e-6);
  EXPECT_EQ(eval_bent_normal(none, {0, 1, 0}), (Vec3f{0, 1, 0}));
  EXPECT_EQ(eval_ambient_occlusion(std::vector<float>{-1e-4f}), 0);
}

// At the foot of a wall without end half of the sky is left, x > 0, of which the mean is ∫ y (x, y, z)/π ds =
// (2/(3π), 1/3, 0).
TEST(AmbientOcclusion, AWallHidesHalfAndBendsTheNormalAway) {
  const Scene scene = make_test_scene(
      {make_sheet({0, 0, 1}, {2, 0, 0}, {0, 0, -2}, 2), make_sheet({0, 0, 4000}, {0, 0, -8000}, {0, 4000, 0}, 1)});
  for (const int bands : {1, 2, 5}) {
    const Transfer transfer = bake_transfer(scene, make_params(4096, bands));
    // The middle of the floor's edge.
    const std::size_t foot = 3;
    ASSERT_EQ(scene.meshes[0].positions[foot], (Vec3f{0, 0, 0}));
    // 4096 samples leave a few thousandths in each coefficient.
    EXPECT_NEAR(transfer.ambient_occlusion[foot], 0.5, 0.005);
    EXPECT_LT(degrees_between(transfer.bent_normals[foot], unit({2 / (3 * pi), 1.0 / 3, 0})), 0.5);
  }
}

// A sphere above the horizon hides a cone of half angle α around w: of ∫ n·s (s, 1)/π ds the cone has
// (a n + b (n·w) w)/π and sin²α n·w, with a + b = ∫ (s·w)² ds = 2π(1 − cos³α)/3 and 3a + b = ∫ ds = 2π(1 − cos α).
TEST(AmbientOcclusion, ASphereHidesAndBendsByItsCone) {
  const Vec3d middle = {0, 1.6, 0}, up = {0, 1, 0};
  Scene scene = make_test_scene({make_sheet({-4, 0, 4}, {8, 0, 0}, {0, 0, -8}, 8), make_sphere(1, 32)});
  scene.instances[1].to_world = make_translation(vec_cast<float>(middle));
  const Transfer transfer = bake_transfer(scene, make_params(4096));
  int checked = 0;
  double most_bent = 0;
  for (std::size_t v = 0; v < scene.meshes[0].positions.size(); ++v) {
    const Vec3d way = middle - vec_cast<double>(scene.meshes[0].positions[v]);
    const double d = std::sqrt(dot(way, way)), sine = 1 / d, cosine = std::sqrt(1 - sine * sine);
    const Vec3d w = (1 / d) * way;
    if (std::asin(sine) + std::acos(w.y) > pi / 2) continue;
    const double along = 2 * pi * (1 - std::pow(cosine, 3)) / 3, a = (2 * pi * (1 - cosine) - along) / 2;
    const Vec3d mean = 2.0 / 3 * up - 1 / pi * (a * up + (along - a) * w.y * w);
    // The sphere is made of flat pieces, and samples are some thousands.
    EXPECT_NEAR(transfer.ambient_occlusion[v], 1 - sine * sine * w.y, 0.005);
    EXPECT_LT(degrees_between(transfer.bent_normals[v], unit(mean)), 0.5);
    most_bent = std::max(most_bent, degrees_between(transfer.bent_normals[v], up));
    ++checked;
  }
  EXPECT_EQ(checked, 81);
  EXPECT_GT(most_bent, 5);
}

}  // namespace
}  // namespace shlight
