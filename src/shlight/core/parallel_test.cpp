#include "shlight/core/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

namespace shlight {
namespace {

TEST(Parallel, CallsEachIndexOnceOnAnyNumberOfThreads) {
  for (const int threads : {0, 1, 2, 5}) {
    std::vector<std::atomic<int>> calls(1000);
    parallel_for(calls.size(), threads, [&](std::size_t i) { ++calls[i]; });
    for (const auto& count : calls) EXPECT_EQ(count, 1);
  }
}

TEST(Parallel, RethrowsTheBodysException) {
  for (const int threads : {1, 2})
    EXPECT_THROW(parallel_for(100, threads,
                              [](std::size_t i) {
                                if (i == 50) throw std::runtime_error("x");
                              }),
                 std::runtime_error);
}

}  // namespace
}  // namespace shlight
