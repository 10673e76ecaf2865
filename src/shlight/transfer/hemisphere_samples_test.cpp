#include "shlight/transfer/hemisphere_samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "shlight/sh/basis.h"
#include "shlight/sh/zonal.h"

namespace shlight {
namespace {

TEST(HemisphereSamples, SumsAreThoseOfTheBasis) {
  constexpr int kBands = 7;
  const HemisphereSamples samples = make_hemisphere_samples(kBands, 700, false, 3, 1, 0);
  const std::vector<std::uint32_t> picks = {0, 3, 4, 17, 255, 256, 257, 500, 699};
  const std::vector<float> weights = {0.5f, 0.25f, 0.125f, 0.5f, 0.25f, 0, 0.5f, 0.25f, 0.125f};
  std::vector<double> sums(49, 1.0), expected(49, 1.0), basis(49);
  add_rows(samples.row(2, 0), samples.row_size, picks, weights, sums);
  for (std::size_t j = 0; j < picks.size(); ++j) {
    const std::size_t k = 2 * samples.set_size + picks[j];
    eval_basis(kBands, Vec3d{samples.x[k], samples.y[k], samples.z[k]}, std::span<double>(basis));
    for (std::size_t i = 0; i < 49; ++i) expected[i] += double{weights[j]} * basis[i];
  }
  // Directions and values are rounded to floats.
  for (std::size_t i = 0; i < 49; ++i) EXPECT_NEAR(sums[i], expected[i], 5e-6) << "coefficient " << i;
}

TEST(HemisphereSamples, TheirMeanIsTheCosineLobe) {
  constexpr int kBands = 6;
  constexpr std::size_t kCount = 4096;
  for (const bool by_cell : {false, true}) {
    const HemisphereSamples samples = make_hemisphere_samples(kBands, kCount, by_cell, 2, 5, 0);
    std::vector<std::uint32_t> all(kCount);
    std::iota(all.begin(), all.end(), 0u);
    for (std::size_t set = 0; set < 2; ++set) {
      std::vector<double> sums(36);
      add_rows(samples.row(set, 0), samples.row_size, all, std::vector<float>(kCount, 1.0f / kCount), sums);
      // What the points' discrepancy leaves; random ones would leave 4e-3.
      constexpr double kTolerance = 4e-4;
      for (int l = 0; l < kBands; ++l)
        for (int m = -l; m <= l; ++m)
          EXPECT_NEAR(sums[static_cast<std::size_t>(coefficient_index(l, m))],
                      m == 0 ? cosine_lobe(l) / std::acos(-1.0) : 0.0, kTolerance)
              << "degree " << l << ", " << m;
    }
  }
}

TEST(HemisphereSamples, ByCellIsTheSamePointsInAnotherSequence) {
  const HemisphereSamples plain = make_hemisphere_samples(2, 2 * kCells, false, 1, 9, 0);
  const HemisphereSamples by_cell = make_hemisphere_samples(2, 2 * kCells, true, 1, 9, 0);
  for (std::size_t block = 0; block < 2; ++block) {
    const auto begin = static_cast<std::ptrdiff_t>(block * kCells);
    std::vector<float> a(plain.x.begin() + begin, plain.x.begin() + begin + kCells);
    std::vector<float> b(by_cell.x.begin() + begin, by_cell.x.begin() + begin + kCells);
    std::ranges::sort(a), std::ranges::sort(b);
    EXPECT_EQ(a, b);
  }
  // The same cell of both blocks: directions that differ by no more than a cell is wide.
  for (std::size_t c = 0; c < kCells; ++c) {
    EXPECT_NEAR(by_cell.x[c], by_cell.x[kCells + c], 0.3);
    EXPECT_NEAR(by_cell.y[c], by_cell.y[kCells + c], 0.3);
  }
}

TEST(HemisphereSamples, AreUnitVectorsAboveTheHorizon) {
  const HemisphereSamples samples = make_hemisphere_samples(1, 1000, false, 4, 2, 0);
  for (std::size_t k = 0; k < samples.x.size(); ++k) {
    const Vec3f d = {samples.x[k], samples.y[k], samples.z[k]};
    EXPECT_NEAR(dot(d, d), 1, 1e-6);
    EXPECT_GE(d.z, 0);
  }
}

}  // namespace
}  // namespace shlight
