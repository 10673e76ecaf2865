#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <thread>
#include <type_traits>
#include <utility>

namespace shlight::viewer {

template <class Result>
bool is_ready(const std::future<Result>& future) {
  return future.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

// A thread that draws, with an OpenGL context that shares objects with the window's: neither long pictures nor drivers
// that compile shaders hold up the window's frames. What is drawn is complete, on the card too, before others see it.
class GlThread {
 public:
  struct Hooks {
    std::function<void()> begin, end;  // on the thread: make its context current, and let it go
    std::function<void()> job_done;    // on the thread, after each job
  };
  explicit GlThread(Hooks hooks);
  GlThread(const GlThread&) = delete;
  GlThread& operator=(const GlThread&) = delete;
  // Does first what it was asked for.
  ~GlThread();

  // Calls `job` there, after all that it was asked for before. The result, or what was thrown, is in the future, which
  // may be thrown away.
  template <class Job>
  auto run(Job job) {
    using Result = std::invoke_result_t<Job>;
    const auto task = std::make_shared<std::packaged_task<Result()>>(std::move(job));
    post([task] { (*task)(); });
    return task->get_future();
  }

  // On the thread, between parts of long work: lets the window draw a frame first, if it is about to. They would get in
  // each other's way on a card that does one thing at a time, and that frame is what is waited for.
  void give_way(std::chrono::milliseconds at_most = std::chrono::milliseconds(50));
  // On the window's thread, around what it draws.
  void begin_window_frame();
  void end_window_frame();

  // For what has OpenGL objects that only this thread may delete, as those that contexts do not share: it dies here,
  // whoever lets it go last. Must be let go before the thread ends.
  template <class T>
  std::shared_ptr<T> own(std::unique_ptr<T> object) {
    return std::shared_ptr<T>(object.release(), [this](T* dead) { post([dead] { delete dead; }); });
  }

 private:
  void post(std::function<void()> job);
  void work();

  Hooks hooks_;
  std::mutex mutex_;
  std::condition_variable news_, window_drawn_;
  std::deque<std::function<void()>> jobs_;
  bool ending_ = false;
  bool window_draws_ = false;
  std::thread thread_;
};

}  // namespace shlight::viewer
