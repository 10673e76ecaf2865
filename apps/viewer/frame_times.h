#pragma once

#include <cstddef>
#include <vector>

namespace shlight::viewer {

// How long frames take: all of a frame, and what of it is not drawing.
class FrameTimes {
 public:
  struct Frame {
    double total_ms = 0, own_ms = 0;
  };
  void add(const Frame& frame);
  std::size_t count() const { return count_; }
  // The newest last; at most kKept.
  const std::vector<Frame>& kept() const { return kept_; }

  struct Summary {
    Frame median, p99, max;
  };
  Summary summary() const;
  void clear() { kept_.clear(); }

  static constexpr std::size_t kKept = 240;

 private:
  std::vector<Frame> kept_;
  std::size_t count_ = 0;
};

}  // namespace shlight::viewer
