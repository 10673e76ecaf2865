#pragma once

#include <cstddef>
#include <deque>
#include <optional>

namespace shlight::viewer {

inline constexpr std::size_t kShownFrames = 240;

// How long frames take: all of a frame, what of it is not drawing, and the graphics card alone.
class FrameTimes {
 public:
  struct Frame {
    double total_ms = 0, own_ms = 0;
    std::optional<double> gpu_ms;  // comes later, if ever
  };
  // Keeps so many frames; `knows_gpu`: whether the card's times are going to come.
  FrameTimes(std::size_t most, bool knows_gpu) : most_(most), knows_gpu_(knows_gpu) {}

  void add(const Frame& frame);
  // The card's time of the frame with this number, counted from 0; nothing happens where that is not kept any more.
  void set_gpu(std::size_t number, double ms);
  bool knows_gpu() const { return knows_gpu_; }
  // Of all frames since the beginning: the number of the next one.
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
  bool knows_gpu_;
  std::deque<Frame> kept_;
  std::size_t count_ = 0;
};

// How long this process has been running, in ms, to 10 ms: what libraries take to load is in it. 0 where the system
// does not tell.
double process_age_ms();

}  // namespace shlight::viewer
