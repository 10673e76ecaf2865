#include "shlight/core/parallel.h"

#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "shlight/core/assert.h"

namespace shlight {
namespace {

#ifdef __SANITIZE_THREAD__
// oneTBB is not compiled with the thread sanitizer, which therefore sees nothing of its synchronisation and takes every
// loop for a race. With plain threads it sees the races of the bodies, which it is run for.
void run_on_threads(std::size_t count, int threads, const std::function<void(std::size_t)>& body) {
  std::atomic<std::size_t> next = 0;
  std::exception_ptr first_error;
  std::once_flag has_error;
  const auto work = [&] {
    for (std::size_t i = next++; i < count; i = next++) try {
        body(i);
      } catch (...) {
        std::call_once(has_error, [&] { first_error = std::current_exception(); });
        next = count;
      }
  };
  {
    std::vector<std::jthread> workers;
    for (int i = 1; i < threads; ++i) workers.emplace_back(work);
    work();
  }
  if (first_error) std::rethrow_exception(first_error);
}
#else
void run_on_threads(std::size_t count, int threads, const std::function<void(std::size_t)>& body) {
  tbb::task_arena arena(threads);
  arena.execute([&] { tbb::parallel_for(std::size_t{0}, count, body); });
}
#endif

}  // namespace

void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& body) {
  SHLIGHT_ASSERT_GE(threads, 0);
  // One thread needs no scheduler, whose start alone costs about a millisecond.
  if (threads == 1 || count <= 1) {
    for (std::size_t i = 0; i < count; ++i) body(i);
    return;
  }
  // More threads than processors gain nothing, and oneTBB complains about them on stderr.
  const int processors = tbb::info::default_concurrency();
  run_on_threads(count, threads == 0 ? processors : std::min(threads, processors), body);
}

}  // namespace shlight
