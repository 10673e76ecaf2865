#include "shlight/truth/path_samples.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace shlight {
namespace {

// The mean over pixels of a product of one number each of two pairs is 1/4 where they are independent.
TEST(PathSamples, PairsAreIndependent) {
  const PathSamples samples(16, 1, 1);
  constexpr int kPixels = 2000;
  for (const auto& [first, second] : {std::pair{0u, 1u}, {1u, 2u}, {0u, 130u}}) {
    double sum = 0;
    for (std::uint64_t pixel = 0; pixel < kPixels; ++pixel)
      for (std::size_t path = 0; path < 16; ++path)
        sum += samples.at(pixel, 3, first, path).x * samples.at(pixel, 3, second, path).y;
    // The deviation of the product is sqrt(1/9 − 1/16) = 0.22; sets of points make it less, not more.
    EXPECT_NEAR(sum / (16 * kPixels), 0.25, 4 * 0.22 / std::sqrt(16.0 * kPixels));
  }
}

// A smooth function's mean over well-spread points is much nearer to its integral than over random ones.
TEST(PathSamples, PointsOfAPairAreWellSpread) {
  constexpr std::size_t kSize = 64;
  const PathSamples samples(kSize, 2, 1);
  double squares = 0;
  constexpr int kPixels = 300;
  for (std::uint64_t pixel = 0; pixel < kPixels; ++pixel) {
    double sum = 0;
    for (std::size_t path = 0; path < kSize; ++path) {
      const auto p = samples.at(pixel, 0, 1, path);
      ASSERT_TRUE(p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1);
      sum += p.x * p.y;
    }
    squares += std::pow(sum / kSize - 0.25, 2);
  }
  EXPECT_LT(std::sqrt(squares / kPixels), 0.22 / std::sqrt(kSize) / 3);
}

TEST(PathSamples, SeedsReplicatesAndPixelsDiffer) {
  const PathSamples a(16, 1, 1), b(16, 2, 1);
  EXPECT_NE(a.at(0, 0, 0, 0).x, b.at(0, 0, 0, 0).x);
  EXPECT_NE(a.at(0, 0, 0, 0).x, a.at(0, 1, 0, 0).x);
  EXPECT_NE(a.at(0, 0, 0, 0).x, a.at(1, 0, 0, 0).x);
  EXPECT_EQ(a.at(5, 3, 2, 7).y, PathSamples(16, 1, 3).at(5, 3, 2, 7).y);
}

}  // namespace
}  // namespace shlight
