#pragma once

#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>

namespace shlight::viewer {

// From now on, the calling thread, and threads that it starts, leave processors to threads of less patience, the
// window's above all, where those want them.
enum class Patience {
  kDraws,     // pictures: a little less often
  kComputes,  // what goes on beside the window: at once; the system takes its processors to be idle
};
inline void be_patient(Patience patience) {
  constexpr int kNice = 6;
  const sched_param none = {};
  if (patience == Patience::kDraws)
    ::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), kNice);
  else
    ::sched_setscheduler(0, SCHED_IDLE, &none);  // of the calling thread
}

}  // namespace shlight::viewer
