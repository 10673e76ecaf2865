#include "task.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

namespace shlight::viewer {
namespace {

// Polls until there are news, as frames do.
template <class Result>
typename Task<Result>::News next(Task<Result>& task) {
  for (;;) {
    if (auto news = task.poll()) return *news;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

TEST(Task, PublishesAndIsDoneOnce) {
  Task<int> task;
  int runs = 0;
  const auto request = [&] {
    task.request(
        "a", [&](const auto& publish, const Progress&) { publish(++runs); }, false);
  };
  request();
  EXPECT_EQ(next(task).result, 1);
  while (task.busy()) task.poll();
  request();
  EXPECT_FALSE(task.busy()) << "the same work is not done again";
  EXPECT_EQ(runs, 1);
}

TEST(Task, OnlyTheNewestOfManyRequestsCounts) {
  Task<int> task;
  std::atomic<bool> go = false;
  std::atomic<int> runs = 0;
  for (int i = 0; i < 10; ++i)
    task.request(
        std::to_string(i),
        [&, i](const auto& publish, const Progress&) {
          while (!go) std::this_thread::yield();
          ++runs;
          publish(i);
        },
        false);
  go = true;
  EXPECT_EQ(next(task).key, "0") << "what runs may end";
  EXPECT_EQ(next(task).result, 9);
  EXPECT_EQ(runs, 2);
}

TEST(Task, HurryStopsWhatRunsWithoutAWord) {
  Task<int> task;
  const auto forever = [](const auto&, const Progress& progress) {
    for (;;) report_progress(progress, 0);
  };
  task.request("old", forever, true);
  task.request(
      "new", [](const auto& publish, const Progress&) { publish(7); }, true);
  const auto news = next(task);
  EXPECT_EQ(news.key, "new");
  EXPECT_EQ(news.error, "");
  task.request("again", forever, true);
  task.cancel();
  while (task.busy()) EXPECT_FALSE(task.poll().has_value());
}

TEST(Task, TellsErrors) {
  Task<int> task;
  task.request(
      "a", [](const auto&, const Progress&) { throw Error("file", "is odd", "an even one"); }, false);
  const auto news = next(task);
  EXPECT_EQ(news.error, "file: is odd: an even one");
  EXPECT_FALSE(news.result.has_value());
}

}  // namespace
}  // namespace shlight::viewer
