#include "frame_times.h"

#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

namespace shlight::viewer {
namespace {

double quantile(std::vector<double> values, double q) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(q * static_cast<double>(values.size() - 1) + 0.5);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace

void FrameTimes::add(const Frame& frame) {
  ++count_;
  kept_.push_back(frame);
  if (kept_.size() > most_) kept_.pop_front();
}

FrameTimes::Summary FrameTimes::summary() const {
  if (kept_.empty()) return {};
  std::vector<double> total, own, picture, gpu;
  for (const Frame& frame : kept_) {
    total.push_back(frame.total_ms), own.push_back(frame.own_ms);
    if (frame.picture_ms) picture.push_back(*frame.picture_ms);
    if (frame.gpu_ms) gpu.push_back(*frame.gpu_ms);
  }
  const auto of_some = [](const std::vector<double>& values, double q) {
    return values.empty() ? std::nullopt : std::optional(quantile(values, q));
  };
  const auto of = [&](double q) {
    return Frame{quantile(total, q), quantile(own, q), of_some(picture, q), of_some(gpu, q)};
  };
  return {of(0.5), of(0.99), of(1)};
}

// From proc(5): the 22nd field of stat is when the process started, in ticks since the machine did; the first of uptime
// is now, in seconds.
double process_age_ms() {
  constexpr int kStartField = 22;
  std::ifstream stat("/proc/self/stat"), uptime("/proc/uptime");
  double now = 0, start = 0;
  std::string field;
  // The second field is the program's name between brackets, in which there may be anything.
  std::getline(stat, field, ')');
  for (int i = 3; i < kStartField; ++i) stat >> field;
  if (!(stat >> start) || !(uptime >> now)) return 0;
  return 1000 * (now - start / static_cast<double>(::sysconf(_SC_CLK_TCK)));
}

}  // namespace shlight::viewer
