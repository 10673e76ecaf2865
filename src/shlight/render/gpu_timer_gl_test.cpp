#include "shlight/render/gpu_timer.h"

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <chrono>
#include <optional>

#include "shlight/render/background.h"
#include "shlight/render/render_test_util.h"
#include "shlight/render/targets.h"

namespace shlight {
namespace {

class GpuTimerTest : public GlTest {
 protected:
  // A background of some size, which takes longer the larger it is.
  static void draw(int size) {
    const RadianceTarget target(size, size);
    const Background background(constant_light(1, {1, 1, 1}));
    target.begin();
    background.draw(make_view({}, {}, 1));
    target.resolve();
  }
  static std::optional<GpuTimer::Time> wait_for(GpuTimer& timer) {
    for (int i = 0; i < 1000; ++i) {
      if (const auto time = timer.take()) return time;
      glFinish();
    }
    return std::nullopt;
  }
};

TEST_F(GpuTimerTest, TakesAsLongAsTheCardAndNoLongerThanTheClock) {
  GpuTimer timer;
  if (!timer.available()) GTEST_SKIP() << "no GL_EXT_disjoint_timer_query";
  draw(64);  // compiled
  const auto start = std::chrono::steady_clock::now();
  timer.begin(7);
  draw(1024);
  timer.end();
  const auto time = wait_for(timer);
  const double clock_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  ASSERT_TRUE(time);
  EXPECT_EQ(time->number, 7u);
  EXPECT_GT(time->ms, 0);
  EXPECT_LE(time->ms, clock_ms);
  EXPECT_FALSE(timer.take()) << "taken already";
}

TEST_F(GpuTimerTest, NobodyWhoDoesNotTakeResultsHasToWait) {
  GpuTimer timer;
  if (!timer.available()) GTEST_SKIP() << "no GL_EXT_disjoint_timer_query";
  for (std::size_t i = 0; i < 100; ++i) {
    timer.begin(i);
    draw(8);
    timer.end();
  }
  // The first ones, in their sequence; later ones found no room.
  std::size_t expected = 0;
  while (const auto time = wait_for(timer)) EXPECT_EQ(time->number, expected++);
  EXPECT_GE(expected, 1u);
  EXPECT_LT(expected, 100u);
  timer.begin(200);
  timer.end();
  EXPECT_EQ(wait_for(timer).value_or(GpuTimer::Time{}).number, 200u);
  EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

}  // namespace
}  // namespace shlight
