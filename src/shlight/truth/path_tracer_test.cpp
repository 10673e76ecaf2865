#include "shlight/truth/path_tracer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "shlight/brdf/make_brdf.h"
#include "shlight/brdf/metallic_roughness.h"
#include "shlight/core/error.h"
#include "shlight/light/light.h"
#include "shlight/scene/builtin_scene.h"
#include "shlight/scene/shapes.h"
#include "shlight/scene/shapes_test_util.h"
#include "shlight/truth/brute_force.h"
#include "shlight/truth/truth_test_util.h"

namespace shlight {
namespace {

// So many deviations off is a mistake, not chance: one test in 10⁵ would show it.
constexpr double kMostDeviations = 4.5;

ImageLight uniform_light(Rgb radiance) {
  return ImageLight({constant_image(4, 2, radiance), Layout::kLatLong});
}

PathTraceParams small_picture(TransferKind kind, int samples) {
  PathTraceParams params;
  params.width = 48, params.height = 32;
  params.transfer = kind;
  params.samples = samples;
  params.show_background = false;
  return params;
}

PathTraceParams seen_from_above(TransferKind kind, int samples, double zoom) {
  PathTraceParams params = small_picture(kind, samples);
  params.camera.azimuth = 0, params.camera.elevation = 90, params.camera.zoom = zoom;
  return params;
}

// The mean over pixels of a channel, its deviation as the pixels' variances have it, and the mean of what is expected.
struct Summary {
  int pixels = 0;
  double mean = 0, deviation = 0, expected = 0;
};
Summary summarize(const PathTraceResult& result, const std::function<std::optional<double>(int x, int y)>& expected) {
  Summary s;
  for (int y = 0; y < result.radiance.height; ++y)
    for (int x = 0; x < result.radiance.width; ++x)
      if (const auto value = expected(x, y)) {
        ++s.pixels;
        s.mean += result.radiance.rgb(x, y).g, s.deviation += result.variance.rgb(x, y).g, s.expected += *value;
      }
  s.mean /= s.pixels, s.expected /= s.pixels, s.deviation = std::sqrt(s.deviation) / s.pixels;
  return s;
}

// `tolerance`, relative, is what the mesh or the pixels' size takes off, not noise.
void expect_mean(const Summary& s, double tolerance, const std::string& where) {
  EXPECT_GT(s.pixels, 50) << where;
  EXPECT_NEAR(s.mean, s.expected, kMostDeviations * s.deviation + tolerance * s.expected)
      << where << ", deviation " << s.deviation;
  EXPECT_LT(s.deviation, 0.01 * s.expected) << where;
}

// Floats that radiance is stored in.
constexpr double kRounding = 1e-6;

Scene with_reflectance(Scene scene, float rho) {
  for (Material& material : scene.materials) material.base_color = {rho, rho, rho};
  return scene;
}

TEST(PathTracer, ConvexThingsInAFurnaceAreTheirReflectance) {
  const ImageLight light = uniform_light({2, 2, 2});
  for (const TransferKind kind : {TransferKind::kCosine, TransferKind::kShadowed, TransferKind::kInterreflected})
    for (const float rho : {1.0f, 0.3f}) {
      const PathTraceResult result =
          trace_paths(with_reflectance(make_sphere_scene(), rho), light, small_picture(kind, 64));
      expect_mean(summarize(result,
                            [&](int x, int y) {
                              const bool is_inside = std::hypot(x - 23.5, y - 15.5) < 13;
                              return is_inside ? std::optional(2.0 * rho) : std::nullopt;
                            }),
                  kRounding, std::to_string(static_cast<int>(kind)) + " " + std::to_string(rho));
    }
}

// In a white furnace nothing can be seen: a white thing, however concave, is as bright as what is around it. Bounces
// that are cut off, after 64, take less than the tolerance.
TEST(PathTracer, WhiteThingsVanishInAFurnace) {
  constexpr double kCutOff = 1e-3;
  PathTraceParams params = small_picture(TransferKind::kInterreflected, 64);
  params.bounces = 64;
  params.show_background = true;
  for (const Scene& scene : {make_still_life_scene(), make_knot_scene()}) {
    const PathTraceResult result = trace_paths(with_reflectance(scene, 1), uniform_light({1, 1, 1}), params);
    expect_mean(summarize(result, [](int, int) { return 1.0; }), kCutOff, "furnace");
    for (int y = 0; y < params.height; ++y)
      for (int x = 0; x < params.width; ++x)
        EXPECT_NEAR(result.radiance.rgb(x, y).g, 1, 0.3) << x << " " << y << ": no crack, no seam";
  }
}

// A disc of radiance L and half angle α, the sphere of a distant lamp, at the angle θ from a plane's normal:
// E = π L sin²α cos θ.
TEST(PathTracer, PlanesUnderADiscHaveItsClosedForm) {
  constexpr double kHalfAngle = 0.35, kTheta = 0.7, kRho = 0.5;
  const FunctionLight light([](Vec3d) { return Rgb{}; },
                            {{{std::sin(kTheta), 0, std::cos(kTheta)}, kHalfAngle, {1, 7, 3}}});
  for (const TransferKind kind : {TransferKind::kCosine, TransferKind::kShadowed}) {
    PathTraceParams params = small_picture(kind, 64);
    params.camera = {0, 0, 4, 35};
    const PathTraceResult result = trace_paths(make_test_scene(make_square(), {kRho, kRho, kRho}), light, params);
    const double expected = kRho * 7 * std::pow(std::sin(kHalfAngle), 2) * std::cos(kTheta);
    expect_mean(summarize(result, [&](int, int) { return expected; }), kRounding, "disc");
  }
}

// The same light comes from elsewhere where it is turned.
TEST(PathTracer, LightsTurn) {
  constexpr double kHalfAngle = 0.3;
  const FunctionLight light([](Vec3d) { return Rgb{}; }, {{{1, 0, 0}, kHalfAngle, {1, 1, 1}}});
  PathTraceParams params = small_picture(TransferKind::kShadowed, 64);
  params.camera = {0, 0, 4, 35};
  params.rotate_light = rotation_about_y(-std::numbers::pi / 2);  // from +X to +Z
  const PathTraceResult result = trace_paths(make_test_scene(make_square()), light, params);
  expect_mean(summarize(result, [&](int, int) { return std::pow(std::sin(kHalfAngle), 2); }), kRounding, "turned");
}

// A hollow half sphere that is open at the top, seen from there. All its points see each other alike: of what comes to
// one, half comes through the opening and half from the bowl. With the reflectance ρ and b bounces
//
//     ρ/2 (1 + ρ/2 + … + (ρ/2)^b).
Mesh make_bowl() {
  constexpr int kRings = 64, kColumns = 128;
  Mesh mesh;
  for (int i = 0; i <= kRings; ++i)
    for (int j = 0; j <= kColumns; ++j) {
      const double theta = std::numbers::pi / 2 * i / kRings, phi = 2 * std::numbers::pi * j / kColumns;
      const Vec3d d = {std::sin(theta) * std::cos(phi), -std::cos(theta), std::sin(theta) * std::sin(phi)};
      mesh.positions.push_back(vec_cast<float>(d));
      mesh.normals.push_back(vec_cast<float>(-d));
    }
  for (std::uint32_t i = 0; i < kRings; ++i)
    for (std::uint32_t j = 0; j < kColumns; ++j) {
      const std::uint32_t a = i * (kColumns + 1) + j, b = a + kColumns + 1;
      for (const std::uint32_t v : {a, b, a + 1, a + 1, b, b + 1}) mesh.indices.push_back(v);
    }
  return mesh;
}

TEST(PathTracer, BowlsHaveTheirClosedForm) {
  // Flat quads a 64th of a right angle wide lie that much inside of the sphere and see their neighbours.
  constexpr double kMeshTolerance = 1.5e-3;
  constexpr float kRho = 0.8f;
  const Scene scene = make_test_scene(make_bowl(), {kRho, kRho, kRho});
  const auto in_bowl = [](double expected) {
    return [expected](int x, int y) {
      return std::hypot(x - 23.5, y - 15.5) < 9 ? std::optional(expected) : std::nullopt;
    };
  };
  const ImageLight light = uniform_light({1, 1, 1});
  for (const int bounces : {0, 1, 4}) {
    PathTraceParams params = seen_from_above(TransferKind::kInterreflected, 128, 1);
    params.bounces = bounces;
    double expected = 0;
    for (int b = 0; b <= bounces; ++b) expected += std::pow(double{kRho} / 2, b + 1);
    expect_mean(summarize(trace_paths(scene, light, params), in_bowl(expected)), kMeshTolerance,
                std::to_string(bounces) + " bounces");
  }
  expect_mean(
      summarize(trace_paths(scene, light, seen_from_above(TransferKind::kShadowed, 128, 1)), in_bowl(double{kRho} / 2)),
      kMeshTolerance, "shadowed");
  expect_mean(
      summarize(trace_paths(scene, light, seen_from_above(TransferKind::kCosine, 128, 1)), in_bowl(double{kRho})),
      kRounding, "cosine");
}

// A sphere of radius r whose centre stands at the height h over a plane takes r² h / d³ of a uniform sky's irradiance
// from a point at the distance d from the centre.
TEST(PathTracer, SpheresShadePlanesByTheirClosedForm) {
  constexpr float kRadius = 0.3f;
  constexpr double kHeight = 0.5;
  Scene scene = make_test_scene(make_sphere(kRadius, 64), {1, 1, 1});
  Mesh floor;
  floor.positions = {{-2, -0.5f, 2}, {2, -0.5f, 2}, {2, -0.5f, -2}, {-2, -0.5f, -2}};
  floor.normals.assign(4, {0, 1, 0});
  floor.indices = {0, 1, 2, 0, 2, 3};
  scene.meshes.push_back(floor);
  scene.instances.push_back({1, kIdentity});

  const PathTraceParams params = seen_from_above(TransferKind::kShadowed, 256, 1.6);
  const PathTraceResult result = trace_paths(scene, uniform_light({1, 1, 1}), params);
  const Extent extent = scene_extent(scene);
  const View view = make_view(params.camera, extent, 1.5);
  // Where a pixel lies on the floor, seen straight from above.
  const double depth = -(view.world_to_view[6] * -0.5 + view.world_to_view[14]) * extent.radius;
  const auto expected = [&](double from, double to) {
    return [&, from, to](int x, int y) -> std::optional<double> {
      const double px = (2 * (x + 0.5) / 48 - 1) / view.view_to_clip[0] * depth;
      const double pz = (2 * (y + 0.5) / 32 - 1) / view.view_to_clip[5] * depth;
      const double aside = std::hypot(px, pz), d = std::hypot(aside, kHeight);
      if (aside < from || aside > to) return {};
      return 1 - kRadius * kRadius * kHeight / (d * d * d);
    };
  };
  // Pixels are 1/12 wide here, over which the shade's slope cancels and its curvature leaves this.
  constexpr double kPixelTolerance = 3e-3;
  expect_mean(summarize(result, expected(0.6, 0.8)), kPixelTolerance, "near");
  expect_mean(summarize(result, expected(0.8, 1.1)), kPixelTolerance, "further");
}

// The camera sees a single sheet from behind lit from there.
TEST(PathTracer, BacksAreLitFromTheirSide) {
  Image picture(4, 2);
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 4; ++x) {
      const bool is_back = x == 0 || x == 3;  // toward +Z
      picture.set_rgb(x, y, is_back ? Rgb{3, 3, 3} : Rgb{1, 1, 1});
    }
  const ImageLight light({picture, Layout::kLatLong});
  const Scene scene = make_test_scene(make_square());  // faces +Z
  for (const TransferKind kind : {TransferKind::kCosine, TransferKind::kShadowed, TransferKind::kInterreflected})
    for (const auto& [azimuth, expected] : {std::pair{0.0, 3.0}, {180.0, 1.0}}) {
      PathTraceParams params = small_picture(kind, 64);
      params.camera = {azimuth, 0, 4, 35};
      const PathTraceResult result = trace_paths(scene, light, params);
      expect_mean(summarize(result, [e = expected](int, int) { return e; }), kRounding, std::to_string(azimuth));
    }
}

// A plane, nearly every point of which is seen from one direction, by its radiance as brute force has it.
void expect_brute_force(const Scene& scene, const Brdf* of_all, const Brdf& expected, const std::string& where) {
  const auto light = load_light("builtin:studio").light;
  PathTraceParams params = small_picture(TransferKind::kShadowed, 256);
  params.width = params.height = 12;
  params.camera = {40, 25, 200, 1};
  params.brdf = of_all;
  params.gloss = true;
  const PathTraceResult result = trace_paths(scene, *light, params);
  // Toward the eye, from the middle of the picture; over the rest the direction changes by half a degree, the more and
  // the less of which cancel.
  constexpr double kViewTolerance = 1e-3;
  const double azimuth = 40 * std::numbers::pi / 180, elevation = 25 * std::numbers::pi / 180;
  const Vec3d eye = {std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
                     std::cos(elevation) * std::cos(azimuth)};
  BruteForceParams brute_force;
  brute_force.tolerance = 1e-4;
  const double radiance = reference_radiance(*light, expected, {}, eye, brute_force).value.g;
  expect_mean(summarize(result, [&](int, int) { return radiance; }), kViewTolerance, where);
}

// The square's u grows toward +X: the axes of its frame are the world's.
TEST(PathTracer, BrdfsAgreeWithBruteForce) {
  for (const char* material :
       {"oren-nayar:rho=0.8,sigma=0.6", "ward-aniso:rd=0.1,rs=0.3,sx=0.15,sy=0.5", "cook-torrance:m=0.25,f0=0.9"}) {
    const auto brdf = make_brdf(material);
    expect_brute_force(make_test_scene(make_square()), brdf.get(), *brdf, material);
  }
}

TEST(PathTracer, GlossOfMaterialsAgreesWithBruteForce) {
  Scene scene = make_test_scene(make_square(), {0.7f, 0.6f, 0.2f});
  scene.materials[0].gloss = MetallicRoughness{0.3f, 0.5f};
  const auto brdf = make_metallic_roughness({0.7, 0.6, 0.2}, 0.3, 0.5);
  expect_brute_force(scene, nullptr, *brdf, "metallic-roughness");
}

// A model of the surfaces that is Lambert's is their own.
TEST(PathTracer, LambertsModelIsTheColor) {
  const auto brdf = make_brdf("lambert:rho=0.8");
  PathTraceParams params = seen_from_above(TransferKind::kInterreflected, 64, 1);
  params.brdf = brdf.get();
  const PathTraceResult result = trace_paths(make_test_scene(make_bowl(), {0, 0, 0}), uniform_light({1, 1, 1}), params);
  params.brdf = nullptr;
  const PathTraceResult own =
      trace_paths(make_test_scene(make_bowl(), {0.8f, 0.8f, 0.8f}), uniform_light({1, 1, 1}), params);
  const auto all = [](int, int) { return 0.0; };
  const Summary a = summarize(result, all), b = summarize(own, all);
  EXPECT_GT(b.mean, 0.1);
  EXPECT_NEAR(a.mean, b.mean, kMostDeviations * std::hypot(a.deviation, b.deviation));
}

// Blocks of 8 x 8 pixels of two seeds differ by what their variances allow: not more, or something is biased or the
// variances are too small; and not less.
TEST(PathTracer, SeedsDifferByTheirVariance) {
  const auto light = load_light("builtin:sky").light;
  const Scene scene = make_still_life_scene();
  PathTraceParams params = small_picture(TransferKind::kInterreflected, 64);
  params.width = 96, params.height = 64;
  params.show_background = true;
  const PathTraceResult a = trace_paths(scene, *light, params);
  params.seed = 2;
  const PathTraceResult b = trace_paths(scene, *light, params);
  double squares = 0;
  int blocks = 0;
  for (int top = 0; top < params.height; top += 8)
    for (int left = 0; left < params.width; left += 8) {
      double difference = 0, variance = 0;
      for (int y = top; y < top + 8; ++y)
        for (int x = left; x < left + 8; ++x) {
          difference += luminance(a.radiance.rgb(x, y) - b.radiance.rgb(x, y));
          // Of one random number, so that channels go together.
          for (const PathTraceResult* r : {&a, &b}) {
            const Rgb v = r->variance.rgb(x, y);
            variance += std::pow(luminance({std::sqrt(v.r), std::sqrt(v.g), std::sqrt(v.b)}), 2);
          }
        }
      if (variance == 0) continue;  // nothing but a smooth sky
      const double z = difference / std::sqrt(variance);
      EXPECT_LT(std::abs(z), kMostDeviations) << left << " " << top;
      squares += z * z;
      ++blocks;
    }
  ASSERT_GT(blocks, 60);
  // The mean of n squares has a deviation of sqrt(2/n).
  EXPECT_NEAR(squares / blocks, 1, kMostDeviations * std::sqrt(2.0 / blocks)) << blocks << " blocks";
}

TEST(PathTracer, BitsAreTheSameOnAnyNumberOfThreads) {
  const Scene scene = make_still_life_scene();
  PathTraceParams params = small_picture(TransferKind::kInterreflected, 20);
  params.threads = 1;
  const PathTraceResult one = trace_paths(scene, uniform_light({1, 2, 3}), params);
  params.threads = 3;
  const PathTraceResult three = trace_paths(scene, uniform_light({1, 2, 3}), params);
  EXPECT_EQ(one.radiance.values, three.radiance.values);
  EXPECT_EQ(one.variance.values, three.variance.values);
  EXPECT_EQ(one.samples, 32) << "rounded up";
  EXPECT_EQ(one.rays, three.rays);
}

TEST(PathTracer, BlackLightsAndEmptyScenesArePictures) {
  PathTraceParams params = small_picture(TransferKind::kInterreflected, 16);
  const PathTraceResult black = trace_paths(make_sphere_scene(), uniform_light({}), params);
  EXPECT_EQ(black.radiance.values, Image(48, 32).values);
  EXPECT_EQ(black.variance.values, Image(48, 32).values);
  params.show_background = true;
  const PathTraceResult empty = trace_paths({}, uniform_light({1, 2, 3}), params);
  EXPECT_EQ(empty.radiance.values, constant_image(48, 32, {1, 2, 3}).values);
}

TEST(PathTracer, StopsWhereTheWatcherWantsIt) {
  int calls = 0;
  EXPECT_THROW(trace_paths(make_sphere_scene(), uniform_light({1, 1, 1}), small_picture(TransferKind::kCosine, 16),
                           [&](double) { return ++calls < 3; }),
               Cancelled);
  EXPECT_EQ(calls, 3);
}

}  // namespace
}  // namespace shlight
