#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "shlight/render/gl.h"

namespace shlight {

// How long the graphics card takes for what is asked of it, by GL_EXT_disjoint_timer_query. Never waits for the card:
// results are read when they have come, which may be some frames later. Needs the context in which it was made.
class GpuTimer {
 public:
  // Without the extension, a timer that measures nothing.
  GpuTimer();

  bool available() const { return available_; }
  // What is drawn between these is measured and has this number. Where too many measurements are still on their way,
  // it is left out.
  void begin(std::size_t number);
  void end();

  struct Time {
    std::size_t number = 0;
    double ms = 0;
  };
  // The oldest measurement that has come in and was not taken yet, if there is one. Those during which the card's clock
  // was disturbed are lost.
  std::optional<Time> take();

 private:
  struct Measurement {
    gl::Query query;
    std::size_t number = 0;
  };
  std::array<Measurement, 8> ring_;
  std::size_t first_ = 0, waiting_ = 0;  // of ring_
  bool available_ = false, measuring_ = false;
};

}  // namespace shlight
