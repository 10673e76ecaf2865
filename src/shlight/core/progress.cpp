#include "shlight/core/progress.h"

#include "shlight/core/error.h"

namespace shlight {

void report_progress(const Progress& progress, double fraction_done) {
  if (progress && !progress(fraction_done)) throw Cancelled();
}

}  // namespace shlight
