#include "shlight/truth/plane.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "shlight/truth/truth_test_util.h"

namespace shlight {
namespace {

// Values in [0, 1] are stored as floats twice.
constexpr double kFloatTolerance = 3e-7;

TEST(Plane, SeparableFilterIsTheDoubleSum) {
  const Plane plane = noise_plane(13, 9, 1);
  const std::vector<double> along_x = {0.1, -0.4, 0.3, 0.7, 0.2}, along_y = {0.5, 0.25, -0.1};
  const Plane filtered = filter_separably(plane, along_x, along_y, 2);
  for (int y = 0; y < plane.height; ++y)
    for (int x = 0; x < plane.width; ++x) {
      double expected = 0;
      for (int j = -1; j <= 1; ++j)
        for (int i = -2; i <= 2; ++i)
          expected += along_x[static_cast<std::size_t>(i + 2)] * along_y[static_cast<std::size_t>(j + 1)] *
                      plane.at(std::clamp(x + i, 0, plane.width - 1), std::clamp(y + j, 0, plane.height - 1));
      EXPECT_NEAR(filtered.at(x, y), expected, kFloatTolerance) << x << " " << y;
    }
}

TEST(Plane, FiltersLargerThanThePictureKeepAConstant) {
  Plane plane(2, 1);
  plane.values = {0.5f, 0.5f};
  const std::vector<double> wide = make_gaussian(4, 12);
  for (const float v : filter_separably(plane, wide, wide, 1).values) EXPECT_NEAR(v, 0.5, kFloatTolerance);
}

TEST(Plane, GaussianHasItsVariance) {
  const std::vector<double> kernel = make_gaussian(2, 12);
  double sum = 0, variance = 0;
  for (int x = -12; x <= 12; ++x) {
    sum += kernel[static_cast<std::size_t>(x + 12)];
    variance += x * x * kernel[static_cast<std::size_t>(x + 12)];
  }
  EXPECT_NEAR(sum, 1, 1e-15);
  EXPECT_NEAR(variance, 4, 1e-6);  // what lies beyond six deviations
}

}  // namespace
}  // namespace shlight
