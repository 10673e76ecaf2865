// What bake_transfer promises besides right numbers: the same bits, checkpoints, clear errors.

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "shlight/core/error.h"
#include "shlight/core/file.h"
#include "shlight/core/temporary_folder.h"
#include "shlight/scene/builtin_scene.h"
#include "shlight/scene/load_scene.h"
#include "shlight/scene/shapes.h"
#include "shlight/scene/transform.h"
#include "shlight/transfer/transfer_test_util.h"

namespace shlight {
namespace {

BakeParams make_params(TransferKind kind, int samples) {
  BakeParams params;
  params.kind = kind;
  params.samples = samples;
  params.bounces = 2;
  return params;
}

// A few thousand sites, so that there are several batches; some triangles coincide.
Scene make_busy_scene() {
  Scene scene = make_test_scene({make_sphere(1, 24), make_sheet({-3, 0, 3}, {6, 0, 0}, {0, 0, -6}, 20),
                                 make_box({-1, 0, -1}, {1, 1, 1}, 8, true)});
  scene.instances[0].to_world = make_translation({0, 2, 0});
  scene.instances.push_back({1, kIdentity});
  scene.materials[1].base_color = {0.9f, 0.3f, 0.1f};
  return scene;
}

bool same_bits(const Transfer& a, const Transfer& b) {
  return a.coefficients == b.coefficients && a.ambient_occlusion == b.ambient_occlusion &&
         a.bent_normals == b.bent_normals && a.hash == b.hash && a.rays == b.rays;
}

TEST(BakeTransfer, SameBitsOnAnyNumberOfThreads) {
  const Scene scene = make_busy_scene();
  for (const int samples : {0, 128}) {
    BakeParams params = make_params(TransferKind::kInterreflected, samples);
    params.error = 0.02f;
    params.threads = 1;
    const Transfer one = bake_transfer(scene, params);
    for (const int threads : {2, 3, 0}) {
      params.threads = threads;
      EXPECT_TRUE(same_bits(bake_transfer(scene, params), one)) << threads << " threads, samples " << samples;
    }
  }
}

TEST(BakeTransfer, ABrokenRunGoesOnToTheSameBits) {
  const Scene scene = make_busy_scene();
  const TemporaryFolder folder;
  for (const int samples : {0, 2048}) {
    BakeParams params = make_params(TransferKind::kInterreflected, samples);
    params.error = 0.02f;
    const Transfer unbroken = bake_transfer(scene, params);
    params.checkpoint = folder / std::to_string(samples);
    // Stopped at every report, from the first to the last.
    Transfer resumed;
    int stops = 0;
    double furthest = 0;
    for (bool is_done = false; !is_done;) {
      int reports = 0;
      try {
        // One report comes before there is anything to save.
        resumed = bake_transfer(scene, params, [&](const BakeStatus& s) {
          EXPECT_GE(s.fraction_done, reports == 0 ? 0 : furthest);
          furthest = std::max(furthest, s.fraction_done);
          return ++reports < 2 || s.fraction_done >= 1;
        });
        is_done = true;
      } catch (const Cancelled&) {
        ASSERT_LT(++stops, 100);
      }
    }
    EXPECT_GE(stops, 2);
    EXPECT_TRUE(same_bits(resumed, unbroken)) << samples << " samples";
    // What is done stays done.
    EXPECT_TRUE(same_bits(bake_transfer(scene, params), unbroken));
  }
}

TEST(BakeTransfer, RefusesACheckpointOfSomethingElse) {
  const Scene scene = make_test_scene({make_sphere(1, 8)});
  const TemporaryFolder folder;
  BakeParams params = make_params(TransferKind::kShadowed, 64);
  params.checkpoint = folder / "checkpoint";
  bake_transfer(scene, params);
  const std::vector<std::byte> good = read_file(params.checkpoint, 1 << 30);

  params.samples = 65;
  EXPECT_THROW(bake_transfer(scene, params), Error);
  params.samples = 64;
  for (const std::size_t place : {std::size_t{0}, std::size_t{20}, good.size() / 2, good.size() - 1}) {
    std::vector<std::byte> bad = good;
    bad[place] ^= std::byte{1};
    write_file(params.checkpoint, bad);
    EXPECT_THROW(bake_transfer(scene, params), Error) << "byte " << place;
  }
  for (const std::size_t length : {std::size_t{0}, std::size_t{8}, good.size() - 1}) {
    write_file(params.checkpoint, std::span(good).first(length));
    EXPECT_THROW(bake_transfer(scene, params), Error) << length << " bytes";
  }
}

TEST(BakeTransfer, StopsWhenAskedTo) {
  const Scene scene = make_busy_scene();
  EXPECT_THROW(bake_transfer(scene, make_params(TransferKind::kShadowed, 64), [](const BakeStatus&) { return false; }),
               Cancelled);
  EXPECT_THROW(bake_transfer(scene, make_params(TransferKind::kShadowed, 64), watch([](double f) { return f < 1; })),
               Cancelled);
}

TEST(BakeTransfer, TheLastStatusIsOfTheWhole) {
  const Scene scene = make_busy_scene();
  for (const TransferKind kind : {TransferKind::kCosine, TransferKind::kShadowed, TransferKind::kInterreflected})
    for (const int samples : {0, 64}) {
      BakeParams params = make_params(kind, samples);
      params.error = 0.02f;
      BakeStatus last;
      const Transfer transfer = bake_transfer(scene, params, [&](const BakeStatus& status) {
        last = status;
        return true;
      });
      EXPECT_EQ(last.fraction_done, 1);
      EXPECT_EQ(last.rays, transfer.rays);
      EXPECT_EQ(last.seconds, transfer.seconds);
      EXPECT_GT(last.seconds, 0);
      EXPECT_EQ(last.rays_per_second, static_cast<double>(transfer.rays) / transfer.seconds);
      EXPECT_EQ(last.seconds_left, 0);
      EXPECT_EQ(transfer.rays > 0, kind != TransferKind::kCosine);
    }
}

TEST(BakeTransfer, HashKnowsWhatCounts) {
  const Scene scene = make_busy_scene();
  const BakeParams params;
  const std::uint64_t hash = hash_bake(scene, params);
  EXPECT_EQ(hash, hash_bake(make_busy_scene(), BakeParams{}));
  BakeParams threads = params;
  threads.threads = 5;
  threads.checkpoint = "somewhere";
  EXPECT_EQ(hash, hash_bake(scene, threads));

  std::vector<std::uint64_t> others;
  const auto with_scene = [&](auto change) {
    Scene other = make_busy_scene();
    change(other);
    others.push_back(hash_bake(other, params));
  };
  const auto with_params = [&](auto change) {
    BakeParams other;
    change(other);
    others.push_back(hash_bake(scene, other));
  };
  with_scene([](Scene& s) { s.meshes[0].positions[3].x += 1e-6f; });
  with_scene([](Scene& s) { s.meshes[0].normals[3].x += 1e-6f; });
  with_scene([](Scene& s) { std::swap(s.meshes[1].indices[3], s.meshes[1].indices[4]); });
  with_scene([](Scene& s) { s.instances[1].to_world[12] += 1e-3f; });
  with_scene([](Scene& s) { s.instances.pop_back(); });
  with_scene([](Scene& s) { s.materials[1].base_color.y = 0; });
  with_scene([](Scene& s) { s.meshes[0].colors.assign(s.meshes[0].positions.size(), {1, 1, 1}); });
  with_scene([](Scene& s) { s.textures.push_back({1, 1, {1, 2, 3, 4}}); });
  with_params([](BakeParams& p) { p.bands = 4; });
  with_params([](BakeParams& p) { p.samples = 100; });
  with_params([](BakeParams& p) { p.seed = 2; });
  with_params([](BakeParams& p) { p.kind = TransferKind::kCosine; });
  others.push_back(hash);
  std::ranges::sort(others);
  EXPECT_EQ(std::ranges::adjacent_find(others), others.end());
}

TEST(BakeTransfer, RefusesWhatItCannotBake) {
  const auto expect_refused = [](auto change_scene, auto change_params) {
    Scene scene = make_test_scene({make_sphere(1, 4)});
    BakeParams params = make_params(TransferKind::kShadowed, 16);
    change_scene(scene);
    change_params(params);
    EXPECT_THROW(bake_transfer(scene, params), Error);
    params.kind = TransferKind::kCosine;
    if (params.bands > 0) {
      EXPECT_THROW(bake_transfer(scene, params), Error);
    }
  };
  const auto same = [](auto&) {};
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();
  expect_refused([](Scene& s) { s.meshes[0].positions[2].y = kNan; }, same);
  expect_refused([](Scene& s) { s.meshes[0].positions[2].y = kInf; }, same);
  expect_refused([](Scene& s) { s.meshes[0].normals[2] = {}; }, same);
  expect_refused([](Scene& s) { s.meshes[0].normals[2].x = kNan; }, same);
  expect_refused([](Scene& s) { s.meshes[0].normals.pop_back(); }, same);
  expect_refused([](Scene& s) { s.meshes[0].colors.resize(3); }, same);
  expect_refused([](Scene& s) { s.meshes[0].indices[5] = 1000000; }, same);
  expect_refused([](Scene& s) { s.meshes[0].indices.pop_back(); }, same);
  expect_refused([](Scene& s) { s.meshes[0].material = 1; }, same);
  expect_refused([](Scene& s) { s.instances[0].mesh = 1; }, same);
  expect_refused([](Scene& s) { s.instances[0].to_world[5] = 0; }, same);
  expect_refused([](Scene& s) { s.instances[0].to_world[5] = -1; }, same);
  expect_refused([](Scene& s) { s.instances[0].to_world[12] = kNan; }, same);
  expect_refused([](Scene& s) { s.materials[0].texture = 0; }, same);
  expect_refused(same, [](BakeParams& p) { p.bands = 0; });
  expect_refused(same, [](BakeParams& p) { p.bands = kMaxTransferBands + 1; });
  expect_refused(same, [](BakeParams& p) { p.samples = -1; });
  expect_refused(same, [](BakeParams& p) { p.samples = kMaxTransferSamples + 1; });
  expect_refused(same, [](BakeParams& p) { p.samples = 0, p.error = 0; });
  expect_refused(same, [](BakeParams& p) { p.samples = 0, p.error = kNan; });
  expect_refused(same, [](BakeParams& p) { p.bounces = -1; });
  expect_refused(same, [](BakeParams& p) { p.samples = 0, p.method = TransferMethod::kMonteCarlo; });
}

TEST(BakeTransfer, OddMeshesAreBaked) {
  for (const TransferKind kind : {TransferKind::kCosine, TransferKind::kShadowed, TransferKind::kInterreflected})
    for (const int samples : {0, 16}) {
      const BakeParams params = make_params(kind, samples);
      EXPECT_EQ(bake_transfer(Scene{}, params).num_vertices(), 0u);
      EXPECT_EQ(bake_transfer(make_test_scene({Mesh{}}), params).num_vertices(), 0u);

      // Triangles without area, an empty mesh, a mesh without triangles, vertices that are used twice or never.
      Mesh odd = make_sphere(1, 6);
      const std::uint32_t last = static_cast<std::uint32_t>(odd.positions.size() - 1);
      odd.indices.insert(odd.indices.end(), {0, 0, 0, 0, 1, 0, 0, last, last});
      for (int k = 0; k < 2; ++k) odd.positions.push_back({3, 0, 0}), odd.normals.push_back({1, 0, 0});
      Mesh points = odd;
      points.indices.clear();
      const Transfer transfer = bake_transfer(make_test_scene({odd, Mesh{}, points}), params);
      ASSERT_EQ(transfer.first_vertex.size(), 4u);
      EXPECT_EQ(transfer.first_vertex[2], transfer.first_vertex[1]);
      EXPECT_EQ(transfer.first_vertex[3], transfer.num_vertices());
      for (const float value : transfer.coefficients) ASSERT_TRUE(std::isfinite(value));
      for (const Vec3f& bent : transfer.bent_normals) ASSERT_NEAR(dot(bent, bent), 1, 1e-5);
      // The lonely vertices see out to their side.
      EXPECT_NEAR(transfer.ambient_occlusion[odd.positions.size() - 1], 1, 1e-5);
    }
}

TEST(BakeTransfer, AHugeFanIsBaked) {
  constexpr std::uint32_t kRim = 1'000'000;
  Mesh fan;
  fan.positions.push_back({0, 0.5f, 0});
  for (std::uint32_t k = 0; k < kRim; ++k) {
    const double angle = 2 * std::numbers::pi * k / kRim;
    fan.positions.push_back({static_cast<float>(std::cos(angle)), 0, static_cast<float>(-std::sin(angle))});
    fan.indices.insert(fan.indices.end(), {0, k + 1, (k + 1) % kRim + 1});
  }
  fan.normals.assign(fan.positions.size(), {0, 1, 0});
  const Transfer transfer = bake_transfer(make_test_scene({fan}), make_params(TransferKind::kShadowed, 1));
  EXPECT_EQ(transfer.num_vertices(), kRim + 1);
  EXPECT_NEAR(transfer.ambient_occlusion[0], 1, 1e-5);
}

TEST(BakeTransfer, AScaledWorldIsTheSameWorld) {
  // Units of kilometres or of microns, far from the origin: only rounding differs, in a few rays.
  const Scene scene = make_busy_scene();
  const BakeParams params = make_params(TransferKind::kShadowed, 256);
  const Transfer expected = bake_transfer(scene, params);
  for (const float scale : {1e-6f, 1e3f}) {
    Scene scaled = scene;
    for (Instance& instance : scaled.instances)
      instance.to_world = multiply(make_scaling({scale, scale, scale}), instance.to_world);
    EXPECT_LT(relative_difference(bake_transfer(scaled, params), expected), 2e-2) << scale;
  }
}

TEST(BakeTransfer, TenBandsOfTheStillLife) {
  BakeParams params = make_params(TransferKind::kInterreflected, 32);
  params.bands = 10;
  params.bounces = 1;
  const Scene scene = make_scene("builtin:scene");
  const Transfer ten = bake_transfer(scene, params);
  ASSERT_EQ(ten.coefficients.size(), 300 * num_vertices(scene));
  for (const float value : ten.coefficients) ASSERT_TRUE(std::isfinite(value));
  // Fewer bands are the first of more.
  params.bands = 1;
  const Transfer one = bake_transfer(scene, params);
  for (std::size_t v = 0; v < one.num_vertices(); ++v) {
    ASSERT_NEAR(one.coefficients[3 * v + 1], ten.coefficients[300 * v + 100], 1e-5);
    ASSERT_NEAR(one.ambient_occlusion[v], ten.ambient_occlusion[v], 1e-5);
  }
}

TEST(BakeTransfer, StatusReadsWell) {
  BakeStatus status;
  EXPECT_EQ(to_text(status), "0 %");
  status = {0.431, 9, 163'800'000, 18.2e6, 12};
  EXPECT_EQ(to_text(status), "43 %, 18.2 million rays/s, 12 s left");
  status.seconds_left = 300;
  EXPECT_EQ(to_text(status), "43 %, 18.2 million rays/s, 5 min left");
}

}  // namespace
}  // namespace shlight
