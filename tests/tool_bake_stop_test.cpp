// A bake that is stopped, killed, or has no room to write in.

#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <thread>

#include "tool_test_util.h"

namespace shlight {
namespace {

class ToolBakeStop : public ToolTest {
 protected:
  // Some seconds of work in many parts, with a checkpoint after each.
  static std::vector<std::string> bake(const std::string& output, const std::string& model = "builtin:scene") {
    return {"bake", model,       "-o", output,      "--transfer", "interreflected", "--bands", "2", "--samples",
            "100",  "--bounces", "1",  "--threads", "1",          "--checkpoint",   "0"};
  }

  // Bakes until a checkpoint is there, and ends it with the signal.
  ToolRun stop(const std::string& output, int signal) const {
    using namespace std::chrono_literals;
    const std::filesystem::path checkpoint = output + ".checkpoint";
    const auto last_change = [&] {
      std::error_code missing;
      return std::filesystem::last_write_time(checkpoint, missing);
    };
    const auto before = last_change();
    ToolProcess tool(bake(output));
    for (int i = 0; i < 30'000 && last_change() == before; ++i) std::this_thread::sleep_for(1ms);
    tool.send(signal);
    return tool.wait();
  }
};

TEST_F(ToolBakeStop, WhatGoesOnEndsInTheSameBytes) {
  run(bake(path("whole.glb")));
  const std::string whole = text_of(path("whole.glb"));
  for (const int signal : {SIGINT, SIGKILL}) {
    const std::string file = path("stopped.glb");
    std::filesystem::remove(file);
    // Twice: what goes on can be stopped too.
    for (int time = 0; time < 2; ++time) {
      const ToolRun stopped = stop(file, signal);
      if (signal == SIGINT) {
        EXPECT_EQ(stopped.exit_code, 1) << stopped;
        EXPECT_NE(stopped.err.find("the same command goes on from there"), std::string::npos) << stopped;
        EXPECT_TRUE(stopped.err.ends_with("shlight bake: stopped before it was done\n")) << stopped;
      } else {
        EXPECT_EQ(stopped.signal, SIGKILL) << stopped;
      }
      EXPECT_FALSE(std::filesystem::exists(file));
      EXPECT_TRUE(std::filesystem::exists(file + ".checkpoint"));
    }
    const ToolRun done = run(bake(file));
    EXPECT_NE(done.err.find("goes on from where an earlier bake stopped"), std::string::npos) << done;
    EXPECT_TRUE(text_of(file) == whole) << "signal " << signal;
    EXPECT_FALSE(std::filesystem::exists(file + ".checkpoint"));
  }
}

TEST_F(ToolBakeStop, AnothersCheckpointIsRefused) {
  const std::string file = path("a.glb"), checkpoint = file + ".checkpoint";
  stop(file, SIGINT);
  const std::string text = text_of(checkpoint);
  expect_refused(bake(file, "builtin:knot"), checkpoint, "was made for another scene or other settings");
  write("a.glb.checkpoint", text.substr(0, text.size() / 2));
  expect_refused(bake(file), checkpoint, "is damaged");
  EXPECT_FALSE(std::filesystem::exists(file));
}

// A limit of the size of files behaves as a disk that becomes full.
TEST_F(ToolBakeStop, AFullDiskLeavesTheOldFile) {
  const std::string file = path("a.glb");
  const std::vector<std::string> bake = {"bake", "builtin:sphere", "-o", file, "--transfer", "cosine"};
  run(bake);
  expect_refused(bake, file, "cannot be written (File too large)", {.max_file_bytes = 100'000});
  EXPECT_EQ(run_json({"info", file})["transfer"], "cosine");
}

}  // namespace
}  // namespace shlight
