#include "shlight/transfer/clustered_pca.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

#include "shlight/scene/builtin_scene.h"
#include "shlight/transfer/transfer_test_util.h"

namespace shlight {
namespace {

// Transfer of the given rows, each of all coefficients of all channels.
Transfer make_transfer(int bands, int channels, std::vector<float> coefficients) {
  Transfer transfer;
  transfer.bands = bands;
  transfer.channels = channels;
  transfer.coefficients = std::move(coefficients);
  const std::size_t row = static_cast<std::size_t>(channels * num_coefficients(bands));
  transfer.ambient_occlusion.assign(transfer.coefficients.size() / row, 1);
  transfer.bent_normals.assign(transfer.num_vertices(), {0, 1, 0});
  transfer.first_vertex = {0, transfer.num_vertices()};
  return transfer;
}

Transfer decompressed(Transfer transfer, const ClusteredPca& pca) {
  transfer.coefficients = pca_coefficients(pca);
  return transfer;
}

double error_of(const Transfer& transfer, int clusters, int components) {
  const PcaParams params = {.clusters = clusters, .components = components};
  return relative_difference(decompressed(transfer, compress_pca(transfer, params)), transfer);
}

// Rows on a few flats through points that are `apart` from each other, each vertex on the one that its number says.
Transfer make_flats(int flats, int dimensions, std::size_t vertices, int channels = 1, float apart = 20) {
  std::mt19937 random(3);
  std::normal_distribution<float> normal;
  const int bands = 4;
  const std::size_t row = static_cast<std::size_t>(channels * num_coefficients(bands));
  std::vector<float> points(static_cast<std::size_t>(flats * (dimensions + 1)) * row);
  for (float& p : points) p = normal(random);
  std::vector<float> coefficients;
  for (std::size_t v = 0; v < vertices; ++v) {
    const std::size_t first = v % static_cast<std::size_t>(flats) * static_cast<std::size_t>(dimensions + 1) * row;
    std::vector<float> weights(static_cast<std::size_t>(dimensions));
    for (float& w : weights) w = normal(random);
    for (std::size_t i = 0; i < row; ++i) {
      float value = apart * points[first + i];
      for (std::size_t j = 0; j < weights.size(); ++j) value += weights[j] * points[first + (j + 1) * row + i];
      coefficients.push_back(value);
    }
  }
  return make_transfer(bands, channels, std::move(coefficients));
}

// What is of so low a dimension comes back but for the steps of weights, half of 1/32767 of the largest each.
TEST(ClusteredPca, FlatsAreFound) {
  constexpr double kSteps = 1e-4;
  for (const int channels : {1, 3}) {
    EXPECT_LT(error_of(make_flats(1, 3, 200, channels), 1, 3), kSteps);
    EXPECT_LT(error_of(make_flats(5, 3, 1000, channels), 5, 3), kSteps);
    EXPECT_GT(error_of(make_flats(5, 3, 1000, channels), 5, 2), 100 * kSteps);
    // All through one point: only the distance from flats tells them apart, not that from means.
    EXPECT_LT(error_of(make_flats(2, 2, 400, channels, 0), 2, 2), kSteps);
    EXPECT_LT(error_of(make_flats(3, 2, 600, channels, 0), 3, 2), kSteps);
  }
}

// One cluster's error is what the eigenvalues of the other components add up to. Here they are known: coordinates are
// independent, of variance 1/(i + 1)², and turned by a reflection.
TEST(ClusteredPca, OneClusterLeavesTheSmallEigenvalues) {
  constexpr int kBands = 3, kRow = 9, kComponents = 4;
  constexpr std::size_t kVertices = 4000;
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  std::vector<double> axis(kRow);
  double square = 0;
  for (double& a : axis) a = normal(random), square += a * a;
  std::vector<float> coefficients;
  double all = 0;
  for (std::size_t v = 0; v < kVertices; ++v) {
    std::vector<double> x(kRow);
    double along = 0;
    for (std::size_t i = 0; i < kRow; ++i) x[i] = normal(random) / static_cast<double>(i + 1), along += x[i] * axis[i];
    for (std::size_t i = 0; i < kRow; ++i) {
      coefficients.push_back(static_cast<float>(x[i] - 2 * along / square * axis[i]));
      all += x[i] * x[i];
    }
  }
  double left = 0;
  for (int i = kComponents; i < kRow; ++i) left += 1.0 / ((i + 1) * (i + 1));
  // Four thousand samples know their variances to √(2/4000), a fortieth.
  const double expected = std::sqrt(left * kVertices / all);
  EXPECT_NEAR(error_of(make_transfer(kBands, 1, coefficients), 1, kComponents), expected, expected / 40);
}

// More clusters or more components are no worse, on a real bake.
TEST(ClusteredPca, MoreIsBetter) {
  BakeParams params;
  params.bands = 4;
  params.samples = 64;
  const Transfer transfer = bake_transfer(make_knot_scene(), params);
  double before = 1;
  for (const int components : {1, 3, 7, 16}) {
    const double error = error_of(transfer, 4, components);
    EXPECT_LT(error, before) << components;
    before = error;
  }
  // As many components as coefficients lose nothing but steps.
  EXPECT_LT(before, 1e-4);
  before = 1;
  for (const int clusters : {1, 4, 16}) {
    const double error = error_of(transfer, clusters, 3);
    EXPECT_LT(error, before) << clusters;
    before = error;
  }
}

TEST(ClusteredPca, ClustersAreAsManyAsThereAreVerticesFor) {
  EXPECT_EQ(num_pca_clusters({}, 0), 1);
  EXPECT_EQ(num_pca_clusters({}, 255), 1);
  EXPECT_EQ(num_pca_clusters({}, 2560), 10);
  EXPECT_EQ(num_pca_clusters({}, 10'000'000), 256);
  EXPECT_EQ(num_pca_clusters({.clusters = 40}, 30), 30);
  EXPECT_EQ(num_pca_clusters({.clusters = 40}, 10'000'000), 40);
}

TEST(ClusteredPca, FewVerticesAreExact) {
  for (const std::size_t vertices : {1u, 2u, 7u}) {
    const Transfer transfer = make_flats(static_cast<int>(vertices), 1, vertices);
    const ClusteredPca pca = compress_pca(transfer, {.clusters = 16, .components = 3});
    EXPECT_EQ(pca.clusters, static_cast<int>(vertices));
    EXPECT_EQ(pca.num_vertices(), vertices);
    EXPECT_LT(relative_difference(decompressed(transfer, pca), transfer), 1e-4);
  }
  // One row many times: all but one cluster are for nobody.
  const Transfer same = make_transfer(1, 1, std::vector<float>(100, .25f));
  EXPECT_EQ(pca_coefficients(compress_pca(same)), same.coefficients);
  const Transfer dark = make_transfer(2, 3, std::vector<float>(120, 0.0f));
  EXPECT_EQ(pca_coefficients(compress_pca(dark)), dark.coefficients);
  EXPECT_EQ(compress_pca(make_transfer(2, 1, {})).num_vertices(), 0u);
}

// More vertices than clusters are found on.
TEST(ClusteredPca, ManyVerticesAreTrainedOnSome) {
  EXPECT_LT(error_of(make_flats(3, 2, 40000), 3, 2), 1e-4);
}

TEST(ClusteredPca, HasTheSameBitsOnAnyNumberOfThreads) {
  const Transfer transfer = make_flats(40, 3, 2500, 3);
  const ClusteredPca one = compress_pca(transfer, {.clusters = 16, .threads = 1});
  const ClusteredPca all = compress_pca(transfer, {.clusters = 16});
  EXPECT_EQ(one.table, all.table);
  EXPECT_EQ(one.codes, all.codes);
  EXPECT_NE(compress_pca(transfer, {.clusters = 16, .seed = 2}).codes, one.codes);
}

// L·x by rows of the table is L·x by coefficients, with fewer bands and with more.
TEST(ClusteredPca, LightOnTheTableIsLightOnTheVertices) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> value(-1, 1);
  for (const int channels : {1, 3}) {
    const Transfer transfer = make_flats(10, 5, 300, channels);
    const ClusteredPca pca = compress_pca(transfer, {.clusters = 4, .components = 3});
    const std::vector<float> coefficients = pca_coefficients(pca);
    for (const int bands : {2, 4, 6}) {
      RgbCoefficients light(bands);
      for (Rgb& c : light.values()) c = {value(random), value(random), value(random)};
      const std::vector<Rgb> rows = light_pca(pca, light);
      for (std::size_t v = 0; v < pca.num_vertices(); ++v) {
        const std::int16_t* code = &pca.codes[4 * v];
        Rgb sum = rows[static_cast<std::size_t>(4 * code[0])], expected;
        for (std::size_t j = 1; j < 4; ++j)
          sum += static_cast<double>(code[j]) * rows[static_cast<std::size_t>(4 * code[0]) + j];
        const auto a = [&](std::size_t c, std::size_t i) {
          return double{
              coefficients[(v * static_cast<std::size_t>(channels) + c % static_cast<std::size_t>(channels)) * 16 + i]};
        };
        for (std::size_t i = 0; i < std::min<std::size_t>(16, light.size()); ++i)
          expected += {light[i].r * a(0, i), light[i].g * a(1, i), light[i].b * a(2, i)};
        // Coefficients up to 100 are rounded to float.
        EXPECT_NEAR(sum.r, expected.r, 1e-4);
        EXPECT_NEAR(sum.g, expected.g, 1e-4);
        EXPECT_NEAR(sum.b, expected.b, 1e-4);
      }
    }
  }
}

}  // namespace
}  // namespace shlight
