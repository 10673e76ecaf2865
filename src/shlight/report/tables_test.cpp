#include "shlight/report/tables.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "shlight/brdf/lambert.h"
#include "shlight/light/builtin_light.h"
#include "shlight/light/project_image.h"
#include "shlight/sh/basis.h"
#include "shlight/sh/sphere_samples.h"

// Cells of the tables, derived once more in plain loops.

namespace shlight {
namespace {

constexpr double kPi = std::numbers::pi;

// 4π/N Σ max(0, n·s) Y_i(s).
std::vector<double> sample_cosine(const SphereSamples& samples, Vec3d normal) {
  std::vector<double> sums(static_cast<std::size_t>(num_coefficients(samples.bands))), basis(sums.size());
  for (const Vec3d& s : samples.directions) {
    eval_basis_recursive<double>(samples.bands, s, basis);
    for (std::size_t i = 0; i < sums.size(); ++i)
      sums[i] += 4 * kPi / static_cast<double>(samples.directions.size()) * std::max(0.0, dot(normal, s)) * basis[i];
  }
  return sums;
}

// The relative error of sampling the clamped cosine about every `each`-th normal: of degree l it is Â_l Y_lm, with
// Â = π, 2π/3, π/4, 0, −π/24.
double cosine_error(const Mesh& mesh, std::size_t each, const SphereSamples& samples) {
  constexpr std::array<double, 5> kHat = {kPi, 2 * kPi / 3, kPi / 4, 0, -kPi / 24};
  double difference = 0, square = 0;
  for (std::size_t v = 0; v < mesh.normals.size(); v += each) {
    const Vec3d normal = vec_cast<double>(mesh.normals[v]);
    const std::vector<double> sampled = sample_cosine(samples, (1 / std::sqrt(dot(normal, normal))) * normal);
    std::vector<double> basis(sampled.size());
    eval_basis_recursive<double>(samples.bands, normal, basis);
    for (int l = 0; l < samples.bands; ++l)
      for (int m = -l; m <= l; ++m) {
        const auto i = static_cast<std::size_t>(coefficient_index(l, m));
        const double truth = kHat[static_cast<std::size_t>(l)] * basis[i];
        difference += (sampled[i] - truth) * (sampled[i] - truth), square += truth * truth;
      }
  }
  return std::sqrt(difference / square);
}

TEST(Tables, LightErrorByHand) {
  constexpr int kSize = 64, kSamples = 100;
  const auto light = make_studio_light();
  const LightRow row = measure_light_row(*light, kSize, kSamples);

  const Environment map = {light->picture({Layout::kAngularMap, kSize}), Layout::kAngularMap};
  const RgbCoefficients truth = project_image_by_pixels(map, 3);
  double mean_square = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const SphereSamples samples = make_sphere_samples(3, 10, seed);
    RgbCoefficients sampled(3);
    for (const Vec3d& s : samples.directions) add_delta(s, 4 * kPi / kSamples * eval_nearest(map, s), sampled);
    double error = 0, largest = 0;
    for (std::size_t i = 0; i < 9; ++i)
      for (double Rgb::*c : {&Rgb::r, &Rgb::g, &Rgb::b}) {
        error = std::max(error, std::abs(sampled[i].*c - truth[i].*c));
        largest = std::max(largest, std::abs(truth[i].*c));
      }
    mean_square += error / largest * error / largest / 5;
  }
  EXPECT_NEAR(row.classic.error, std::sqrt(mean_square), 1e-9);
  EXPECT_GT(row.classic.error, 1e-3) << "a hundred samples scatter";
  EXPECT_LT(row.exact.error, 1e-6);
  EXPECT_LT(row.lat_long.error, 1e-6);
}

TEST(Tables, TransferErrorByHand) {
  const Scene knot = make_table_knot(46, 13);
  const TransferRow row = measure_transfer_row(knot, 100);
  EXPECT_EQ(row.vertices, 598u) << "as the thesis's first model";
  EXPECT_EQ(row.triangles, 1196u);
  // Sampled in float, in runs.
  EXPECT_NEAR(row.classic.error, cosine_error(knot.meshes[0], 1, make_sphere_samples(3, 10, 1)), 1e-6);
  EXPECT_LT(row.own.error, 1e-6);
}

// Lambert's f_r is ρ/π, so that F* is the clamped cosine's.
TEST(Tables, BrdfErrorByHand) {
  const BrdfRow row = measure_brdf_row(*make_lambert({1, 1, 1}), 100);
  EXPECT_NEAR(row.classic.error, cosine_error(make_table_knot(64, 16).meshes[0], 8, make_sphere_samples(5, 10, 1)),
              1e-6);
  EXPECT_LT(row.own.error, 0.1 * row.classic.error);
  EXPECT_LT(row.lookup.error, 1e-4);
}

TEST(Tables, KnotsHaveTheThesissNumbers) {
  for (const auto& [along, around, vertices] :
       {std::array<std::size_t, 3>{475, 37, 17575}, std::array<std::size_t, 3>{457, 68, 31076}})
    EXPECT_EQ(num_vertices(make_table_knot(static_cast<int>(along), static_cast<int>(around))), vertices);
  for (const auto& [along, around, triangles] :
       {std::array<std::size_t, 3>{67, 8, 1072}, std::array<std::size_t, 3>{480, 36, 34560},
        std::array<std::size_t, 3>{419, 72, 60336}})
    EXPECT_EQ(num_triangles(make_table_knot(static_cast<int>(along), static_cast<int>(around))), triangles);
}

}  // namespace
}  // namespace shlight
