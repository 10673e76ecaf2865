#include "frame_times.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace shlight::viewer {
namespace {

TEST(FrameTimes, SummariseWhatIsKept) {
  FrameTimes times(240, true);
  EXPECT_EQ(times.summary().max.total_ms, 0);
  for (int i = 1; i <= 1000; ++i) times.add({static_cast<double>(i), 1, {}});
  EXPECT_EQ(times.count(), 1000u);
  EXPECT_EQ(times.kept().size(), 240u);
  const FrameTimes::Summary s = times.summary();  // of 761 … 1000
  EXPECT_NEAR(s.median.total_ms, 880.5, 1);
  EXPECT_NEAR(s.p99.total_ms, 998, 1);
  EXPECT_EQ(s.max.total_ms, 1000);
  EXPECT_EQ(s.max.own_ms, 1);
}

TEST(FrameTimes, TheCardsTimesComeLaterAndForSomeFramesOnly) {
  FrameTimes times(10, true);
  for (int i = 0; i < 30; ++i) times.add({1, 1, {}});
  EXPECT_FALSE(times.summary().max.gpu_ms);
  times.set_gpu(19, 100);  // not kept any more
  times.set_gpu(30, 100);  // not there yet
  EXPECT_FALSE(times.summary().max.gpu_ms);
  times.set_gpu(20, 3);
  times.set_gpu(25, 5);
  times.set_gpu(29, 4);
  EXPECT_EQ(times.summary().median.gpu_ms, 4);
  EXPECT_EQ(times.summary().max.gpu_ms, 5);
  EXPECT_EQ(times.kept()[5].gpu_ms, 5);
}

TEST(ProcessAge, GrowsAsTheClockDoes) {
  const double first = process_age_ms();
  if (first == 0) GTEST_SKIP() << "this system does not tell";
  EXPECT_GT(first, 0);
  EXPECT_LT(first, 600'000) << "this test has not run for that long";
  std::this_thread::sleep_for(std::chrono::milliseconds(60));
  const double grown = process_age_ms() - first;
  EXPECT_GE(grown, 40);
}

}  // namespace
}  // namespace shlight::viewer
