#include "shlight/transfer/sobol.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

namespace shlight {
namespace {

struct Points {
  std::vector<double> x, y;
};

Points make_points(std::uint64_t seed, std::size_t count) {
  Points p{std::vector<double>(count), std::vector<double>(count)};
  make_scrambled_sobol(seed, p.x, p.y);
  return p;
}

TEST(Sobol, EveryBlockOfAPowerOfTwoLiesOneInEachDyadicBox) {
  constexpr int kBits = 8;
  constexpr std::size_t kCount = 1 << kBits;
  const Points p = make_points(3, 4 * kCount);
  for (std::size_t begin = 0; begin < p.x.size(); begin += kCount)
    for (int bits = 0; bits <= kBits; ++bits) {
      std::set<std::size_t> boxes;
      for (std::size_t j = begin; j < begin + kCount; ++j)
        boxes.insert(static_cast<std::size_t>(std::ldexp(p.x[j], bits)) << kBits |
                     static_cast<std::size_t>(std::ldexp(p.y[j], kBits - bits)));
      EXPECT_EQ(boxes.size(), kCount) << "from point " << begin << ", boxes 2^-" << bits << " wide";
    }
}

TEST(Sobol, StaysInTheUnitSquare) {
  const Points p = make_points(1, 10000);
  for (std::size_t j = 0; j < p.x.size(); ++j) {
    ASSERT_TRUE(p.x[j] >= 0 && p.x[j] < 1);
    ASSERT_TRUE(p.y[j] >= 0 && p.y[j] < 1);
  }
}

// Scrambling keeps every point uniform: the mean over many seeds of what one point gives is the integral.
TEST(Sobol, EachPointIsUniformOverSeeds) {
  constexpr int kSeeds = 4000;
  double sum[3] = {};
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const Points p = make_points(seed, 3);
    for (std::size_t j = 0; j < 3; ++j) sum[j] += p.x[j] * p.y[j];
  }
  // xy has the mean 1/4 and the variance 1/9 − 1/16; four standard errors.
  const double tolerance = 4 * std::sqrt((1 / 9.0 - 1 / 16.0) / kSeeds);
  for (const double s : sum) EXPECT_NEAR(s / kSeeds, 0.25, tolerance);
}

TEST(Sobol, SmoothFunctionsConvergeLikeTheThreeHalfthPower) {
  // ∫ e^{x+y} = (e − 1)². Random points would gain a factor of 8 here, these gain 512 but for a logarithm.
  const double exact = std::pow(std::exp(1) - 1, 2);
  const auto rms_error = [&](std::size_t count) {
    double sum = 0;
    for (std::uint64_t seed = 0; seed < 64; ++seed) {
      const Points p = make_points(seed, count);
      double mean = 0;
      for (std::size_t j = 0; j < count; ++j) mean += std::exp(p.x[j] + p.y[j]) / static_cast<double>(count);
      sum += std::pow(mean - exact, 2);
    }
    return std::sqrt(sum / 64);
  };
  EXPECT_LT(rms_error(4096), rms_error(64) / 200);
}

}  // namespace
}  // namespace shlight
