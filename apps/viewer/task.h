#pragma once

#include <algorithm>
#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "patience.h"
#include "shlight/core/error.h"
#include "shlight/core/progress.h"

namespace shlight::viewer {

// How many threads work that goes on beside the window may take: one processor is the window's.
inline int worker_threads() {
  return static_cast<int>(std::max(1u, std::thread::hardware_concurrency()) + 1) / 2;
}

// Long work on a thread of its own, one at a time, of which only the newest request counts: a frame never waits for it.
// Work is known by a key that says all it depends on.
template <class Result>
class Task {
 public:
  // `patient` work takes a lower priority than the window's.
  explicit Task(bool patient = true) : patient_(patient) {}

  // What the work is given: call `publish` as often as there is something better to show.
  using Publish = std::function<void(Result)>;
  using Work = std::function<void(const Publish& publish, const Progress& progress)>;

  ~Task() {
    if (job_) job_->stop = true;
  }

  // Asks for the work of `key`, unless that is running, done or has failed already. What is running is asked to stop
  // where `hurry`, else it may end first, so that there is something to see while a slider is dragged.
  void request(const std::string& key, Work work, bool hurry) {
    if (key == wanted_) return;
    wanted_ = key;
    next_ = std::move(work);
    if (job_ && hurry) job_->stop = true;
    advance();
  }
  // Forgets what was asked for, and stops it.
  void cancel() {
    next_ = {};
    wanted_.clear();
    if (job_) job_->stop = true;
  }

  struct News {
    std::string key;
    std::optional<Result> result;
    std::string error;  // where it failed
  };
  // What has come since the last call, if anything; once a frame.
  std::optional<News> poll() {
    std::optional<News> news;
    if (job_) {
      const bool ended = job_->ended;
      const std::lock_guard lock(job_->mutex);
      if (job_->result || (ended && !job_->error.empty() && !job_->stop))
        news = {job_->key, std::exchange(job_->result, {}), std::exchange(job_->error, {})};
      if (ended) job_->thread.join();
    }
    if (job_ && !job_->thread.joinable()) job_.reset();
    advance();
    return news;
  }

  bool busy() const { return job_ || next_; }
  double fraction() const { return job_ ? job_->fraction.load() : 0; }
  const std::string& wanted() const { return wanted_; }

 private:
  struct Job {
    std::string key;
    std::mutex mutex;
    std::optional<Result> result;
    std::string error;
    std::atomic<double> fraction = 0;
    std::atomic<bool> stop = false, ended = false;
    std::thread thread;
    ~Job() {
      if (thread.joinable()) thread.join();
    }
  };

  void advance() {
    if (job_ || !next_) return;
    job_ = std::make_unique<Job>();
    job_->key = wanted_;
    job_->thread = std::thread([job = job_.get(), work = std::exchange(next_, {}), patient = patient_] {
      if (patient) be_patient(Patience::kComputes);
      try {
        work(
            [job](Result result) {
              std::optional<Result> news = std::move(result);
              {
                const std::lock_guard lock(job->mutex);
                job->result.swap(news);
              }  // what it replaces may take long to die, and a frame may wait for the mutex
            },
            [job](double fraction) {
              job->fraction = fraction;
              return !job->stop;
            });
      } catch (const Cancelled&) {
      } catch (const std::exception& error) {
        const std::lock_guard lock(job->mutex);
        job->error = error.what();
      }
      job->ended = true;
    });
  }

  bool patient_;
  std::unique_ptr<Job> job_;
  Work next_;
  std::string wanted_;
};

}  // namespace shlight::viewer
