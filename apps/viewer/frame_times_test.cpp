#include "frame_times.h"

#include <gtest/gtest.h>

namespace shlight::viewer {
namespace {

TEST(FrameTimes, SummariseWhatIsKept) {
  FrameTimes times;
  EXPECT_EQ(times.summary().max.total_ms, 0);
  for (int i = 1; i <= 1000; ++i) times.add({static_cast<double>(i), 1});
  EXPECT_EQ(times.count(), 1000u);
  EXPECT_EQ(times.kept().size(), FrameTimes::kKept);
  const FrameTimes::Summary s = times.summary();  // of 761 … 1000
  EXPECT_NEAR(s.median.total_ms, 880.5, 1);
  EXPECT_NEAR(s.p99.total_ms, 998, 1);
  EXPECT_EQ(s.max.total_ms, 1000);
  EXPECT_EQ(s.max.own_ms, 1);
}

}  // namespace
}  // namespace shlight::viewer
