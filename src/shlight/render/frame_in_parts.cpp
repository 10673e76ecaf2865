#include "shlight/render/frame_in_parts.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

namespace shlight {
namespace {

// Of fewer triangles, all are sent to the device for each group of rows; more are sent once, in groups.
constexpr std::size_t kManyTriangles = 4096;
// The first share of what was never drawn: it may take long.
constexpr double kFirstShare = 1.0 / 32;
constexpr double kSmallestShare = 1.0 / 128;

// The whole number nearest to a share of `count`; both ends of a share are rounded alike, so that shares fit together.
std::size_t share_of(std::size_t count, double share) {
  return static_cast<std::size_t>(std::lround(share * static_cast<double>(count)));
}

double ms_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

void FrameInParts::begin(const GpuScene& scene) {
  std::vector<Step> steps;
  std::size_t first = 0;
  for (const std::size_t count : scene.num_triangles()) {
    const TriangleRange all = {first, first + count};
    steps.push_back({count >= kManyTriangles ? Kind::kTriangles : Kind::kSurfaceRows, all});
    first += count;
  }
  for (const Kind kind : {Kind::kBackground, Kind::kAverage, Kind::kPicture}) steps.push_back({kind, {}});
  // What was learnt of the scene stays.
  if (steps.size() == steps_.size())
    for (std::size_t i = 0; i < steps.size(); ++i) steps[i].ms = steps_[i].ms;
  steps_ = std::move(steps);
  step_ = 0, done_ = 0, spent_ms_ = 0;
  renderer_->clear();
}

double FrameInParts::next_share(const Step& step, double ms) const {
  const double left = 1 - done_;
  if (step.kind == Kind::kPicture) return left;  // is shown at once
  if (step.ms < 0) return std::min(kFirstShare, left);
  if (step.ms * left <= ms) return left;
  return std::clamp(ms / step.ms, std::min(kSmallestShare, left), left);
}

void FrameInParts::draw_triangles(GpuScene& scene, const Drawing& drawing, const FrameParams& frame,
                                  TriangleRange triangles) const {
  if (triangles.begin == triangles.end) return;
  scene.set_range(triangles);
  renderer_->add_surfaces(drawing, frame);
  scene.set_range({});
}

void FrameInParts::draw_share(GpuScene& scene, const Drawing& drawing, const FrameParams& frame, const Step& step,
                              double share) const {
  const double end = done_ + share;
  if (step.kind == Kind::kTriangles) {
    const std::size_t count = step.triangles.end - step.triangles.begin;
    return draw_triangles(scene, drawing, frame,
                          {step.triangles.begin + share_of(count, done_), step.triangles.begin + share_of(count, end)});
  }
  const auto rows = static_cast<std::size_t>(renderer_->height());
  const auto first = static_cast<GLint>(share_of(rows, done_)), last = static_cast<GLint>(share_of(rows, end));
  glEnable(GL_SCISSOR_TEST);
  glScissor(0, first, renderer_->width(), last - first);
  if (step.kind == Kind::kSurfaceRows)
    draw_triangles(scene, drawing, frame, step.triangles);
  else if (step.kind == Kind::kBackground)
    renderer_->add_background(drawing, frame);
  else if (step.kind == Kind::kAverage)
    renderer_->average();
  else
    renderer_->make_picture(drawing, frame);
  glDisable(GL_SCISSOR_TEST);
}

bool FrameInParts::draw(GpuScene& scene, const Drawing& drawing, const FrameParams& frame, double ms) {
  if (!going_on()) return true;
  const auto start = std::chrono::steady_clock::now();
  const std::size_t first = step_;
  double expected = 0, share = 0;
  TriangleRange whole = {0, 0};  // of whole instances, which are drawn at once
  do {
    const Step& step = steps_[step_];
    share = next_share(step, ms - expected);
    const bool is_surface = step.kind == Kind::kTriangles || step.kind == Kind::kSurfaceRows;
    if (is_surface && share == 1) {
      if (whole.begin == whole.end) whole.begin = step.triangles.begin;
      whole.end = step.triangles.end;
    } else {
      draw_triangles(scene, drawing, frame, std::exchange(whole, {0, 0}));
      draw_share(scene, drawing, frame, step, share);
    }
    expected += share * std::max(step.ms, 0.0);
    done_ += share;
    constexpr double kRounding = 1e-9;
    if (done_ >= 1 - kRounding) ++step_, done_ = 0;
    // What is not known is drawn alone.
  } while (steps_[first].ms >= 0 && going_on() && done_ == 0 && steps_[step_].ms >= 0 && expected < ms);
  draw_triangles(scene, drawing, frame, whole);
  gl::finish();
  const double took = ms_since(start);

  // Of one step, its time is known now; several were all as much slower or faster as together.
  constexpr double kLeast = 1e-3, kMostChange = 2;
  const std::size_t last = done_ > 0 ? step_ : step_ - 1;
  if (first == last)
    steps_[first].ms = took / share;
  else
    for (std::size_t i = first; i <= last; ++i)
      steps_[i].ms *= std::clamp(took / std::max(expected, kLeast), 1 / kMostChange, kMostChange);
  spent_ms_ += took;
  return !going_on();
}

}  // namespace shlight
