#include "frame_times.h"

#include <algorithm>
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

void FrameTimes::set_gpu(std::size_t number, double ms) {
  const std::size_t first = count_ - kept_.size();
  if (number >= first && number < count_) kept_[number - first].gpu_ms = ms;
}

FrameTimes::Summary FrameTimes::summary() const {
  if (kept_.empty()) return {};
  std::vector<double> total, own, gpu;
  for (const Frame& frame : kept_) {
    total.push_back(frame.total_ms), own.push_back(frame.own_ms);
    if (frame.gpu_ms) gpu.push_back(*frame.gpu_ms);
  }
  const auto of = [&](double q) {
    return Frame{quantile(total, q), quantile(own, q), gpu.empty() ? std::nullopt : std::optional(quantile(gpu, q))};
  };
  return {of(0.5), of(0.99), of(1)};
}

}  // namespace shlight::viewer
