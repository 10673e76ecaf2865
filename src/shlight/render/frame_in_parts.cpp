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
// The first share of what was never drawn is as small: it may take long.
constexpr double kSmallestShare = 1.0 / 128;
constexpr double kRounding = 1e-9;

// The whole number nearest to a share of `count`; both ends of a share are rounded alike, so that shares fit together.
std::size_t share_of(std::size_t count, double share) {
  return static_cast<std::size_t>(std::lround(share * static_cast<double>(count)));
}

double ms_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

bool FrameInParts::Step::is_known() const {
  return std::ranges::all_of(ms, [](double t) { return t >= 0; });
}

double FrameInParts::Step::expected_ms(double begin, double end) const {
  double sum = 0;
  for (int i = 0; i < kSlices; ++i) {
    const double overlap = std::min(end * kSlices, i + 1.0) - std::max(begin * kSlices, static_cast<double>(i));
    sum += std::max(overlap, 0.0) * std::max(ms[static_cast<std::size_t>(i)], 0.0);
  }
  return sum;
}

template <class Change>
void FrameInParts::Step::change(double begin, double end, const Change& change) {
  for (int i = 0; i < kSlices; ++i)
    if (i + 1 > begin * kSlices + kRounding && i < end * kSlices - kRounding) change(ms[static_cast<std::size_t>(i)]);
}

void FrameInParts::begin(const GpuScene& scene) {
  std::vector<Step> steps = {Step(Kind::kClear, {})};
  std::size_t first = 0;
  for (const std::size_t count : scene.num_triangles()) {
    const TriangleRange all = {first, first + count};
    steps.emplace_back(count >= kManyTriangles ? Kind::kTriangles : Kind::kSurfaceRows, all);
    first += count;
  }
  for (const Kind kind : {Kind::kBackground, Kind::kAverage, Kind::kPicture}) steps.emplace_back(kind, TriangleRange());
  // What was learnt of the scene stays.
  if (steps.size() == steps_.size())
    for (std::size_t i = 0; i < steps.size(); ++i) steps[i].ms = steps_[i].ms;
  steps_ = std::move(steps);
  step_ = 0, done_ = 0, spent_ms_ = 0;
}

double FrameInParts::next_share(const Step& step, double ms) const {
  if (step.kind == Kind::kClear) return 1;            // of all pixels, which drivers do faster
  if (step.kind == Kind::kPicture) return 1 - done_;  // is shown at once
  double end = done_, left = ms;
  while (end < 1 - kRounding) {
    const int i = static_cast<int>(end * kSlices + kRounding);
    const double end_of_it = (i + 1.0) / kSlices;
    double of_it = step.ms[static_cast<std::size_t>(i)];
    const bool is_known = of_it >= 0;
    if (!is_known) {
      // Drawn alone, and taken to be like the one before.
      if (end > done_) break;
      if (i > 0) of_it = step.ms[static_cast<std::size_t>(i) - 1];
      if (of_it < 0) return std::min(kSmallestShare, end_of_it - done_);
    }
    const double rest = of_it * (end_of_it - end) * kSlices;
    if (rest > left) {
      end = std::min(end + left / of_it / kSlices, end_of_it);
      break;
    }
    left -= rest;
    end = end_of_it;
    if (!is_known) break;
  }
  return std::min(std::max(end - done_, kSmallestShare), 1 - done_);
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
  if (step.kind == Kind::kClear) return renderer_->clear();
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
  const double begin = done_;
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
    expected += step.expected_ms(done_, done_ + share);
    done_ += share;
    if (done_ >= 1 - kRounding) ++step_, done_ = 0;
    // What is not known is drawn alone.
  } while (steps_[first].is_known() && going_on() && done_ == 0 && steps_[step_].is_known() && expected < ms);
  draw_triangles(scene, drawing, frame, whole);
  gl::finish();
  const double took = ms_since(start);

  // Of one step, its time is known now; several were all as much slower or faster as together.
  constexpr double kLeast = 1e-3, kMostChange = 2;
  const std::size_t last = done_ > 0 ? step_ : step_ - 1;
  const double end = done_ > 0 ? done_ : 1;
  if (first == last) steps_[first].change(begin, end, [&](double& t) { t = took / (end - begin) / kSlices; });
  const double slower = std::clamp(took / std::max(expected, kLeast), 1 / kMostChange, kMostChange);
  for (std::size_t i = first; first < last && i <= last; ++i)
    steps_[i].change(i == first ? begin : 0, i == last ? end : 1, [&](double& t) { t *= slower; });
  spent_ms_ += took;
  return !going_on();
}

}  // namespace shlight
