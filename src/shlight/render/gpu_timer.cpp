#include "shlight/render/gpu_timer.h"

#include <epoxy/gl.h>

#include "shlight/core/assert.h"

namespace shlight {

GpuTimer::GpuTimer() : available_(epoxy_has_gl_extension("GL_EXT_disjoint_timer_query")) {
  if (!available_) return;
  for (Measurement& measurement : ring_) measurement.query = gl::make_query();
  gl::get_integer(GL_GPU_DISJOINT_EXT);  // reading forgets what was before
}

void GpuTimer::begin(std::size_t number) {
  SHLIGHT_ASSERT_EQ(measuring_, false);
  if (!available_ || waiting_ == ring_.size()) return;
  Measurement& next = ring_[(first_ + waiting_) % ring_.size()];
  next.number = number;
  glBeginQuery(GL_TIME_ELAPSED_EXT, next.query.id());
  measuring_ = true;
}

void GpuTimer::end() {
  if (!measuring_) return;
  glEndQuery(GL_TIME_ELAPSED_EXT);
  measuring_ = false;
  ++waiting_;
}

std::optional<GpuTimer::Time> GpuTimer::take() {
  if (waiting_ == 0) return std::nullopt;
  const Measurement& oldest = ring_[first_];
  GLuint is_there = GL_FALSE;
  glGetQueryObjectuiv(oldest.query.id(), GL_QUERY_RESULT_AVAILABLE, &is_there);
  if (!is_there) return std::nullopt;
  GLuint64 nanoseconds = 0;
  glGetQueryObjectui64vEXT(oldest.query.id(), GL_QUERY_RESULT, &nanoseconds);
  // After the result: what disturbs the clock later does not matter. What else is on its way may be disturbed, too.
  const bool disturbed = gl::get_integer(GL_GPU_DISJOINT_EXT) != 0;
  const std::size_t lost = disturbed ? waiting_ : 1;
  first_ = (first_ + lost) % ring_.size();
  waiting_ -= lost;
  if (disturbed) return std::nullopt;
  return Time{oldest.number, 1e-6 * static_cast<double>(nanoseconds)};
}

}  // namespace shlight
