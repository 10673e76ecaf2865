#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "shlight/render/frame_renderer.h"

namespace shlight {

// Draws frames of one FrameRenderer in parts that take about as long as they are given, for windows that have to stay
// alive while drawing takes long: instance by instance, large ones by ranges of their triangles, what has few triangles
// but many pixels by rows. How long each takes is learnt from the last frame. Pixels are those of
// FrameRenderer::draw().
class FrameInParts {
 public:
  // Of as many instances as the scene will have. `renderer` has to outlive this.
  explicit FrameInParts(const FrameRenderer& renderer) : renderer_(&renderer) {}

  // Begins a frame; what was begun is forgotten.
  void begin(const GpuScene& scene);
  // Draws on, for about so long or until the picture is there, and waits until the device has done it. `drawing` and
  // `frame` are the same for all parts of a frame, and `scene` is drawing.scene. True once the picture is there.
  bool draw(GpuScene& scene, const Drawing& drawing, const FrameParams& frame, double ms);

  bool going_on() const { return step_ < steps_.size(); }
  // What the parts drawn since begin() took, without what was between them.
  double spent_ms() const { return spent_ms_; }

 private:
  enum class Kind { kClear, kTriangles, kSurfaceRows, kBackground, kAverage, kPicture };
  static constexpr int kSlices = 16;
  struct Step {
    Kind kind;
    TriangleRange triangles;
    // How long each slice took when it was last drawn, as some hold many more pixels than others; negative where
    // that is not known.
    std::array<double, kSlices> ms;

    Step(Kind k, TriangleRange t) : kind(k), triangles(t) { ms.fill(-1); }
    bool is_known() const;
    // From one share of it to another, of what is known.
    double expected_ms(double begin, double end) const;
    // Calls `change` with each slice of a share.
    template <class Change>
    void change(double begin, double end, const Change& change);
  };
  // The share of a step that is drawn next.
  double next_share(const Step& step, double ms) const;
  void draw_triangles(GpuScene& scene, const Drawing& drawing, const FrameParams& frame, TriangleRange triangles) const;
  void draw_share(GpuScene& scene, const Drawing& drawing, const FrameParams& frame, const Step& step,
                  double share) const;

  const FrameRenderer* renderer_;
  std::vector<Step> steps_;
  std::size_t step_ = 0;
  double done_ = 0;  // of the step
  double spent_ms_ = 0;
};

}  // namespace shlight
