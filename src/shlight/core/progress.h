#pragma once

#include <functional>

namespace shlight {

// How a long operation tells its caller how far it is, and asks whether to go on. Called from one thread at a time with
// the fraction done, in [0, 1], never decreasing; returning false stops the operation, which then throws Cancelled.
// An empty function means: nobody watches, never stop.
using Progress = std::function<bool(double fraction_done)>;

// Reports `fraction_done`; throws Cancelled where the watcher asks to stop.
void report_progress(const Progress& progress, double fraction_done);

}  // namespace shlight
