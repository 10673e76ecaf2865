// Ctrl-C, SIGTERM and a closed terminal.

#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <thread>

#include "tool_test_util.h"

namespace shlight {
namespace {

class ToolStop : public ToolDrawingTest {};

// Days of work; ends within this many seconds of the signal.
constexpr double kPatience = 10;

TEST_F(ToolStop, LeavesNothingHalfDone) {
  const std::string old = write("old.png", "old");
  const auto before = contents();
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    // As early as it can be handled, and while frames are drawn.
    for (const int delay_ms : {0, 1500}) {
      const std::string output = delay_ms > 0 ? old : path("new.png");
      ToolProcess tool({"render", "builtin:sphere", "--frames", "1000000", "--size", "160x120", "-o", output},
                       {.timeout = 2 * kPatience});
      ASSERT_TRUE(tool.wait_until_it_handles(signal));
      std::this_thread::sleep_for(std::chrono::milliseconds(delay_ms));
      tool.send(signal);
      const ToolRun run = tool.wait();
      EXPECT_EQ(run.exit_code, 1) << run;
      EXPECT_EQ(run.err, "shlight render: stopped before it was done\n") << signal;
      EXPECT_EQ(run.out, "");
      EXPECT_LT(run.seconds, kPatience) << run;
      EXPECT_TRUE(contents() == before) << "signal " << signal << " after " << delay_ms << " ms";
    }
}

TEST_F(ToolStop, ASecondSignalEndsItAtOnce) {
  ToolProcess tool({"render", "builtin:sphere", "--frames", "1000000", "--size", "160x120", "-o", path("a.png")},
                   {.timeout = 2 * kPatience});
  ASSERT_TRUE(tool.wait_until_it_handles(SIGINT));
  tool.send(SIGINT);
  tool.send(SIGINT);
  const ToolRun run = tool.wait();
  EXPECT_TRUE(run.signal == SIGINT || run.exit_code == 1) << run;
  EXPECT_LT(run.seconds, kPatience);
  EXPECT_TRUE(contents().empty());
}

}  // namespace
}  // namespace shlight
