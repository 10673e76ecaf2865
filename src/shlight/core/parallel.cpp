#include "shlight/core/parallel.h"

#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>

#include "shlight/core/assert.h"

namespace shlight {

void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& body) {
  SHLIGHT_ASSERT_GE(threads, 0);
  // One thread needs no scheduler, whose start alone costs about a millisecond.
  if (threads == 1 || count <= 1) {
    for (std::size_t i = 0; i < count; ++i) body(i);
    return;
  }
  // More threads than processors gain nothing, and oneTBB complains about them on stderr.
  const int processors = tbb::info::default_concurrency();
  tbb::task_arena arena(threads == 0 ? processors : std::min(threads, processors));
  arena.execute([&] { tbb::parallel_for(std::size_t{0}, count, body); });
}

}  // namespace shlight
