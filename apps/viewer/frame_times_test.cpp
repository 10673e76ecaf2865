#include "frame_times.h"

#include <gtest/gtest.h>

namespace shlight::viewer {
namespace {

TEST(FrameTimes, SummariseWhatIsKept) {
  FrameTimes times(240);
  EXPECT_EQ(times.summary().max.total_ms, 0);
  for (int i = 1; i <= 1000; ++i) times.add({static_cast<double>(i), 1, {}, {}});
  EXPECT_EQ(times.count(), 1000u);
  EXPECT_EQ(times.kept().size(), 240u);
  const FrameTimes::Summary s = times.summary();  // of 761 … 1000
  EXPECT_NEAR(s.median.total_ms, 880.5, 1);
  EXPECT_NEAR(s.p99.total_ms, 998, 1);
  EXPECT_EQ(s.max.total_ms, 1000);
  EXPECT_EQ(s.max.own_ms, 1);
}

TEST(FrameTimes, PicturesComeWithSomeFramesOnly) {
  FrameTimes times(10);
  times.add({1, 1, 100, 100});  // not kept
  for (int i = 0; i < 10; ++i) times.add({1, 1, {}, {}});
  EXPECT_FALSE(times.summary().max.picture_ms);
  EXPECT_FALSE(times.summary().max.gpu_ms);
  times.add({1, 1, 7, 3});
  times.add({1, 1, 9, {}});
  times.add({1, 1, 8, 5});
  EXPECT_EQ(times.summary().median.picture_ms, 8);
  EXPECT_EQ(times.summary().max.picture_ms, 9);
  EXPECT_EQ(times.summary().max.gpu_ms, 5);
}

}  // namespace
}  // namespace shlight::viewer
