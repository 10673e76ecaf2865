#include "gl_thread.h"

#include "patience.h"

namespace shlight::viewer {

GlThread::GlThread(Hooks hooks) : hooks_(std::move(hooks)), thread_([this] { work(); }) {}

GlThread::~GlThread() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  news_.notify_one();
  thread_.join();
}

void GlThread::give_way(std::chrono::milliseconds at_most) {
  std::unique_lock lock(mutex_);
  window_drawn_.wait_for(lock, at_most, [this] { return !window_draws_; });
}

void GlThread::begin_window_frame() {
  const std::lock_guard lock(mutex_);
  window_draws_ = true;
}

void GlThread::end_window_frame() {
  {
    const std::lock_guard lock(mutex_);
    window_draws_ = false;
  }
  window_drawn_.notify_one();
}

void GlThread::post(std::function<void()> job) {
  {
    const std::lock_guard lock(mutex_);
    jobs_.push_back(std::move(job));
  }
  news_.notify_one();
}

void GlThread::work() {
  hooks_.begin();
  be_patient(Patience::kDraws);
  std::unique_lock lock(mutex_);
  while (true) {
    news_.wait(lock, [this] { return ending_ || !jobs_.empty(); });
    if (jobs_.empty()) break;
    std::function<void()> job = std::move(jobs_.front());
    jobs_.pop_front();
    lock.unlock();
    job();
    job = nullptr;  // what it holds may die, and be posted
    hooks_.job_done();
    lock.lock();
  }
  hooks_.end();
}

}  // namespace shlight::viewer
