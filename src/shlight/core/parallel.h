#pragma once

#include <cstddef>
#include <functional>

namespace shlight {

// The one place where work is spread over threads.

// Calls `body(i)` once for each i in [0, count), in any order, on at most `threads` threads (0: all there are). An
// exception of the body stops what has not begun and is rethrown. For results that have the same bits whatever the
// number of threads, let each i write its own slot and add the slots up in order afterwards.
void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& body);

}  // namespace shlight
