#include "gl_thread.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <string>
#include <vector>

namespace shlight::viewer {
namespace {

using namespace std::chrono_literals;

const GlThread::Hooks kNoHooks = {[] {}, [] {}, [] {}};

TEST(GlThread, DoesAllInSequenceOnOneThreadWithItsContext) {
  std::vector<std::string> events;
  std::thread::id worker;
  {
    GlThread thread({[&] {
                       worker = std::this_thread::get_id();
                       events.push_back("begin");
                     },
                     [&] { events.push_back("end"); }, [&] { events.push_back("done"); }});
    thread.run([&] { events.push_back("a"); });
    thread.run([&] { events.push_back(std::this_thread::get_id() == worker ? "b" : "elsewhere"); });
  }
  EXPECT_NE(worker, std::this_thread::get_id());
  EXPECT_EQ(events, (std::vector<std::string>{"begin", "a", "done", "b", "done", "end"}));
}

TEST(GlThread, HandsOnResultsAndErrors) {
  GlThread thread(kNoHooks);
  auto six = thread.run([] { return 6; });
  auto error = thread.run([]() -> int { throw std::runtime_error("no"); });
  EXPECT_EQ(six.get(), 6);
  EXPECT_THROW(error.get(), std::runtime_error);
  EXPECT_EQ(thread.run([] { return 7; }).get(), 7) << "goes on after an error";
}

struct Mourned {
  std::thread::id* died_on;
  ~Mourned() { *died_on = std::this_thread::get_id(); }
};

TEST(GlThread, WhatItOwnsDiesThere) {
  std::thread::id worker, here, with_a_job;
  {
    GlThread thread(kNoHooks);
    worker = thread.run([] { return std::this_thread::get_id(); }).get();
    auto object = thread.own(std::make_unique<Mourned>(&here));
    object.reset();
    // A job that holds the last of it: it dies with the job, which must not wait for itself.
    thread.run([object = thread.own(std::make_unique<Mourned>(&with_a_job))] {});
  }
  EXPECT_EQ(here, worker);
  EXPECT_EQ(with_a_job, worker);
}

TEST(GlThread, GivesWayToTheWindowsFrameButNotForEver) {
  GlThread thread(kNoHooks);
  thread.run([&] { thread.give_way(); }).get();  // nobody draws

  std::atomic<bool> drawn = false;
  thread.begin_window_frame();
  auto after = thread.run([&] {
    thread.give_way(60s);
    return drawn.load();
  });
  std::this_thread::sleep_for(5ms);
  drawn = true;
  thread.end_window_frame();
  EXPECT_TRUE(after.get());

  thread.begin_window_frame();
  EXPECT_EQ(thread.run([&] { thread.give_way(); }).wait_for(10s), std::future_status::ready);
}

}  // namespace
}  // namespace shlight::viewer
