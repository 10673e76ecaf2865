#pragma once

#include <cstddef>
#include <deque>
#include <optional>

namespace shlight::viewer {

inline constexpr std::size_t kShownFrames = 240;

// How long frames take: all of a frame, and what of it is not drawing; and the pictures that came with them, which are
// drawn beside them: all of drawing, and the graphics card alone.
class FrameTimes {
 public:
  struct Frame {
    double total_ms = 0, own_ms = 0;
    std::optional<double> picture_ms, gpu_ms;  // where a picture came, and where the driver tells
  };
  // Keeps so many frames.
  explicit FrameTimes(std::size_t most) : most_(most) {}

  void add(const Frame& frame);
  // Of all frames since the beginning.
  std::size_t count() const { return count_; }
  // The newest last; at most as many as the constructor was told.
  const std::deque<Frame>& kept() const { return kept_; }

  struct Summary {
    Frame median, p99, max;
  };
  Summary summary() const;
  void clear() { kept_.clear(); }

 private:
  std::size_t most_;
  std::deque<Frame> kept_;
  std::size_t count_ = 0;
};

}  // namespace shlight::viewer
