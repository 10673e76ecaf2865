#include "shlight/core/quantile.h"

#include <gtest/gtest.h>

namespace shlight {
namespace {

TEST(Quantile, IsOneOfTheValues) {
  const std::vector<double> odd = {5, 1, 4, 2, 3}, even = {4, 1, 3, 2};
  EXPECT_EQ(quantile(odd, 0), 1);
  EXPECT_EQ(quantile(odd, 1), 5);
  EXPECT_EQ(quantile(odd, 0.25), 2);
  EXPECT_EQ(median(odd), 3);
  EXPECT_EQ(median(even), 3) << "the larger of the two in the middle";
  EXPECT_EQ(median({7}), 7);
}

TEST(Quantile, LeavesOneOfAHundredAboveIt) {
  std::vector<double> values(101);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<double>((37 * i) % values.size());
  EXPECT_EQ(quantile(values, 0.99), 99);
}

}  // namespace
}  // namespace shlight
