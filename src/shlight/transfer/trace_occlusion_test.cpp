// Shadowed transfer against closed forms, through bake_transfer.

#include "shlight/transfer/trace_occlusion.h"

#include <gtest/gtest.h>

#include "shlight/scene/builtin_scene.h"
#include "shlight/scene/shapes.h"
#include "shlight/scene/transform.h"
#include "shlight/transfer/choose_density.h"
#include "shlight/transfer/transfer_test_util.h"

namespace shlight {
namespace {

using std::numbers::pi;

BakeParams make_params(TransferKind kind, int samples) {
  BakeParams params;
  params.kind = kind;
  params.samples = samples;
  return params;
}

const BakeParams kShadowed1024 = make_params(TransferKind::kShadowed, 1024);

// Several shapes in each other's shade.
Scene make_small_scene() {
  TorusKnotParams knot;
  knot.along = 128, knot.around = 16;
  Scene scene = make_test_scene({make_torus_knot(knot), make_sheet({-5, -4, 5}, {10, 0, 0}, {0, 0, -10}, 12)});
  scene.instances.push_back({0, multiply(make_translation({4, 2, 1}), make_scaling({0.3f, 0.4f, 0.3f}))});
  return scene;
}

// A room whose roof is of slats: light comes in through gaps of 3 degrees at most, half as wide as a cell of the
// adaptive plan. All that faces outward is black from where the sites are.
Scene make_slatted_room() {
  constexpr int kSlats = 16;
  constexpr float kHalf = 4, kHeight = 2, kStride = 2 * kHalf / kSlats, kGap = 0.1f;
  const Vec3f x = {2 * kHalf, 0, 0}, y = {0, kHeight, 0}, z = {0, 0, 2 * kHalf}, corner = {-kHalf, 0, -kHalf};
  Mesh room = make_sheet(corner, z, x, 16);
  for (const auto& [from, a, b] :
       {std::array{corner, x, y}, std::array{corner + z, y, x}, std::array{corner, y, z}, std::array{corner + x, z, y}})
    append(room, make_sheet(from, a, b, 4));
  for (int k = 0; k < kSlats; ++k) {
    const Vec3f at = corner + y + Vec3f{kStride * static_cast<float>(k), 0, 0};
    append(room, make_sheet(at, {kStride - kGap, 0, 0}, z, 1));
  }
  return make_test_scene({room});
}

TEST(Shadowed, ConvexShapesHaveTheirCosineTransfer) {
  const Scene scene = make_test_scene({make_sphere(1, 40), make_rounded_box({1, 2, 3}, 0.1f, 3, 0.3f)});
  Scene apart = scene;
  apart.instances[1].to_world = multiply(make_translation({100, 0, 0}), make_rotation({1, 2, 3}, 30));
  for (Scene one : {make_test_scene({scene.meshes[0]}), make_test_scene({scene.meshes[1]})}) {
    one.instances[0].to_world = apart.instances[1].to_world;
    const Transfer cosine = bake_transfer(one, make_params(TransferKind::kCosine, 0));
    for (const int samples : {0, 1024}) {
      const Transfer shadowed = bake_transfer(one, make_params(TransferKind::kShadowed, samples));
      double largest = 0;
      for (std::size_t i = 0; i < cosine.coefficients.size(); ++i)
        largest = std::max(largest, std::abs(double{shadowed.coefficients[i]} - double{cosine.coefficients[i]}));
      EXPECT_LT(largest, 1e-3);
    }
  }
}

TEST(Shadowed, InsideOfAClosedBoxAllIsBlack) {
  for (const float degrees : {0.0f, 31.0f}) {
    Scene scene = make_test_scene({make_box({-1, -2, -3}, {1, 2, 3}, 6, false)});
    scene.instances[0].to_world = make_rotation({3, 1, 2}, degrees);
    const Transfer transfer = bake_transfer(scene, kShadowed1024);
    // A ray in a million may slip between two triangles; the closed form less the samples' sum leaves 1e-3.
    for (std::size_t v = 0; v < transfer.num_vertices(); ++v)
      EXPECT_LT(transfer.ambient_occlusion[v], 2e-3) << "vertex " << v;
  }
}

TEST(Shadowed, ARectangleAboveAPlaneHidesItsFormFactor) {
  // From a point of the floor below the middle of a parallel a x b rectangle at height h (Howell, A Catalog of
  // Radiation Heat Transfer Configuration Factors, B-3, four times a quarter).
  const double a = 2, b = 3, h = 0.8, x = a / (2 * h), y = b / (2 * h);
  const double rx = std::sqrt(1 + x * x), ry = std::sqrt(1 + y * y);
  const double hidden = 2 / pi * (x / rx * std::atan(y / rx) + y / ry * std::atan(x / ry));
  const Scene scene = make_test_scene(
      {make_sheet({-6, 0, 6}, {12, 0, 0}, {0, 0, -12}, 2), make_sheet({-1, 0.8f, 1.5f}, {2, 0, 0}, {0, 0, -3}, 1)});
  for (const int samples : {0, 4096}) {
    const Transfer transfer = bake_transfer(scene, make_params(TransferKind::kShadowed, samples));
    EXPECT_NEAR(transfer.ambient_occlusion[4], 1 - hidden, 0.01) << hidden;
    EXPECT_NEAR(under_uniform_light(transfer, 4), 1 - hidden, 0.01);
    // The upper side of the rectangle sees only sky.
    EXPECT_NEAR(transfer.ambient_occlusion[9], 1, 1e-5);
  }
}

TEST(Shadowed, ASphereAboveAPlaneHidesItsConeOfLight) {
  // A sphere of radius r in the distance d at the angle θ from the normal, wholly above the horizon: (r/d)² cos θ.
  constexpr int kSteps = 8;
  const Scene scene = make_test_scene({make_sheet({-4, 0, 4}, {8, 0, 0}, {0, 0, -8}, kSteps), make_sphere(1, 64)});
  Scene raised = scene;
  raised.instances[1].to_world = make_translation({0, 1.6f, 0});
  const Transfer transfer = bake_transfer(raised, make_params(TransferKind::kShadowed, 4096));
  int checked = 0;
  for (std::size_t v = 0; v < raised.meshes[0].positions.size(); ++v) {
    const Vec3d way = Vec3d{0, 1.6, 0} - vec_cast<double>(raised.meshes[0].positions[v]);
    const double d = std::sqrt(dot(way, way)), cosine = way.y / d;
    if (std::asin(1 / d) + std::acos(cosine) > pi / 2) continue;
    EXPECT_NEAR(transfer.ambient_occlusion[v], 1 - cosine / (d * d), 0.01);
    // What is hidden is up: the bent normal leans away from the sphere's foot.
    const Vec3f p = raised.meshes[0].positions[v], bent = transfer.bent_normals[v];
    EXPECT_NEAR(dot(bent, bent), 1, 1e-5);
    if (p.x != 0 || p.z != 0) {
      EXPECT_GT(bent.x * p.x + bent.z * p.z, 0);
    }
    ++checked;
  }
  EXPECT_GE(checked, 81);
}

TEST(Shadowed, ClassicSamplingConvergesToTheSame) {
  const Scene scene = make_small_scene();
  const Transfer transfer = bake_transfer(scene, make_params(TransferKind::kShadowed, 4096));
  BakeParams classic = make_params(TransferKind::kShadowed, 16384);
  classic.method = TransferMethod::kMonteCarlo;
  // Uniform jittered points, the same for every vertex, leave 1.3e-2 at 4096 samples; anything wrong with a weight or a
  // frame leaves percents.
  const Transfer sampled = bake_transfer(scene, classic);
  const double difference = relative_difference(sampled, transfer);
  EXPECT_LT(difference, 8e-3);
  // All vertices have the same directions and so much the same error: one pair of sets says less about it.
  EXPECT_NEAR(sampled.estimated_error, difference, 0.5 * difference);
}

TEST(Shadowed, ErrorFallsLikeThePowerThreeQuarters) {
  const Scene scene = make_small_scene();
  const Transfer truth = bake_transfer(scene, make_params(TransferKind::kShadowed, 16384));
  const auto error = [&](int samples) {
    const Transfer transfer = bake_transfer(scene, make_params(TransferKind::kShadowed, samples));
    const double difference = relative_difference(transfer, truth);
    // The pilot has one site in 16 of a small scene.
    EXPECT_NEAR(transfer.estimated_error, difference, 0.3 * difference) << samples << " samples";
    return difference;
  };
  const double coarse = error(64), fine = error(1024);
  EXPECT_LT(fine, coarse / std::pow(16, 0.7)) << coarse << " to " << fine;
}

// Where a box stands on a floor, a few vertices around its foot have most of the error.
TEST(Shadowed, ErrorOfFewVerticesIsKnownToo) {
  const Scene scene = make_test_scene({make_sheet({-4, 0, 4}, {8, 0, 0}, {0, 0, -8}, 20),
                                       make_box({-0.7f, 1e-3f, -0.7f}, {0.7f, 1.5f, 0.7f}, 4, true)});
  const Transfer truth = bake_transfer(scene, make_params(TransferKind::kShadowed, 16384));
  for (const std::uint64_t seed : {11u, 12u, 13u}) {
    BakeParams params = make_params(TransferKind::kShadowed, 0);
    params.seed = seed;
    const Transfer transfer = bake_transfer(scene, params);
    const double error = relative_difference(transfer, truth);
    // All vertices are in the pilot, and two pairs of samples differ in what they meet.
    EXPECT_NEAR(transfer.estimated_error, error, 0.3 * error) << "seed " << seed;
  }
}

TEST(Shadowed, AutomaticSamplesReachTheWantedErrorAndSayHowWell) {
  const Scene scene = make_small_scene();
  BakeParams truth_params = make_params(TransferKind::kShadowed, 16384);
  truth_params.seed = 99;
  const Transfer truth = bake_transfer(scene, truth_params);
  for (const float wanted : {0.02f, 0.008f}) {
    BakeParams params = make_params(TransferKind::kShadowed, 0);
    params.error = wanted;
    const Transfer transfer = bake_transfer(scene, params);
    const double error = relative_difference(transfer, truth);
    // The pilot knows its error to about a tenth, the density's rounding and the power law add as much.
    EXPECT_LT(error, 1.25 * double{wanted}) << transfer.estimated_error;
    EXPECT_NEAR(transfer.estimated_error, error, 0.3 * error);
    // With the same rays spread evenly the error is larger.
    const int average = static_cast<int>(transfer.rays / transfer.num_vertices());
    const Transfer even = bake_transfer(scene, make_params(TransferKind::kShadowed, average));
    EXPECT_LT(error, relative_difference(even, truth)) << average << " rays a vertex";
  }
}

// What every bake with automatic samples misses is in no estimate that compares two of them: it must be small.
TEST(Shadowed, AutomaticSamplesFindSmallOpenings) {
  const Scene scene = make_slatted_room();
  const Transfer truth = bake_transfer(scene, make_params(TransferKind::kShadowed, 16384));
  BakeParams params = make_params(TransferKind::kShadowed, 0);
  params.seed = 2;
  params.error = 0.06f;
  const Transfer transfer = bake_transfer(scene, params);
  double open = 0, open_truth = 0;
  for (std::size_t v = 0; v < truth.num_vertices(); ++v) {
    open += double{transfer.ambient_occlusion[v]};
    open_truth += double{truth.ambient_occlusion[v]};
  }
  EXPECT_LT(open_truth, 0.2 * static_cast<double>(truth.num_vertices())) << "hardly open";
  EXPECT_NEAR(open / open_truth, 1, 0.01);
  const double error = relative_difference(transfer, truth);
  EXPECT_NEAR(transfer.estimated_error, error, 0.2 * error);
}

}  // namespace
}  // namespace shlight
