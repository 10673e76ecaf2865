#include "shlight/scene/weld.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace shlight {
namespace {

TEST(Weld, GroupsAreNumberedByFirstRow) {
  const float rows[] = {1, 2, 3, 4, 1, 2, 0.0f, 4, -0.0f, 4};
  const Weld weld = weld_rows(rows, 2);
  EXPECT_EQ(weld.group, (std::vector<std::uint32_t>{0, 1, 0, 2, 2}));
  EXPECT_EQ(weld.first, (std::vector<std::uint32_t>{0, 1, 3}));
}

TEST(Weld, NothingGivesNothing) {
  const Weld weld = weld_positions({});
  EXPECT_TRUE(weld.group.empty() && weld.first.empty());
}

TEST(Weld, NaNEqualsItself) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(weld_rows(std::vector<float>{nan, 1, nan}, 1).group, (std::vector<std::uint32_t>{0, 1, 0}));
}

// Two rows are in one group exactly if they are equal; a lattice has many equal rows and many near ones.
TEST(Weld, AgreesWithComparingAllPairs) {
  std::mt19937 random(1);
  std::vector<Vec3f> positions(600);
  const auto coordinate = [&] { return static_cast<float>(random() % 5) - 2; };
  for (Vec3f& p : positions) p = {coordinate(), coordinate(), coordinate()};
  const Weld weld = weld_positions(positions);
  for (std::size_t i = 0; i < positions.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      ASSERT_EQ(weld.group[i] == weld.group[j], positions[i] == positions[j]) << i << " " << j;
}

}  // namespace
}  // namespace shlight
