#include "shlight/core/process.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>
#include <vector>

namespace shlight {
namespace {

TEST(PeakMemory, RemembersWhatIsGivenBack) {
  if (peak_memory() == 0) GTEST_SKIP() << "this system tells none";
  constexpr std::size_t kBytes = 64 << 20;
  reset_peak_memory();
  const std::uint64_t before = peak_memory();
  // Written to, or the system would not give it; large enough to be given back at once.
  EXPECT_EQ(std::vector<char>(kBytes, 'x')[before % kBytes], 'x');
  const std::uint64_t after = peak_memory();
  // Some of it may come from what the process already held.
  EXPECT_GT(after, before + kBytes / 2);
  EXPECT_LT(after, before + 2 * kBytes);
}

TEST(PeakMemory, ResidentMemoryForgetsWhatIsGivenBack) {
  if (resident_memory() == 0) GTEST_SKIP() << "this system tells none";
  constexpr std::size_t kBytes = 64 << 20;
  const std::uint64_t before = resident_memory();
  {
    const std::vector<char> held(kBytes, 'x');
    EXPECT_GT(resident_memory(), before + kBytes / 2) << held[before % kBytes];
    EXPECT_LE(resident_memory(), peak_memory());
  }
  EXPECT_LT(resident_memory(), before + kBytes / 2);
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
}  // namespace shlight
