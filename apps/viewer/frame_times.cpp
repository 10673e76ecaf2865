#include "frame_times.h"

#include <vector>

#include "shlight/core/quantile.h"

namespace shlight::viewer {

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

}  // namespace shlight::viewer
