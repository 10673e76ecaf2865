#include "frame_times.h"

#include <algorithm>

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
  if (kept_.size() > kKept) kept_.erase(kept_.begin());
}

FrameTimes::Summary FrameTimes::summary() const {
  if (kept_.empty()) return {};
  std::vector<double> total, own;
  for (const Frame& frame : kept_) total.push_back(frame.total_ms), own.push_back(frame.own_ms);
  const auto of = [&](double q) { return Frame{quantile(total, q), quantile(own, q)}; };
  return {of(0.5), of(0.99), of(1)};
}

}  // namespace shlight::viewer
