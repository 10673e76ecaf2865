#pragma once

#include <memory>
#include <optional>

#include "picture_targets.h"
#include "shlight/render/frame_renderer.h"

namespace shlight::viewer {

// Draws a light as a balloon. Made anywhere; all else on the GlThread.
class BalloonPainter {
 public:
  explicit BalloonPainter(GlThread& thread) : targets_(thread) {}

  // `balloon` as make_balloon makes it, turned with the light, from the side on which `camera` stands.
  std::shared_ptr<const PictureTarget> paint(const std::shared_ptr<const Scene>& balloon, const Rotation& rotation,
                                             const Camera& camera, int width, int height);

 private:
  std::shared_ptr<const Scene> balloon_;
  Rotation rotation_;
  std::optional<GpuScene> gpu_scene_;  // of both
  std::optional<SurfaceRenderer> renderer_;
  std::optional<Background> background_;
  std::optional<FrameRenderer> frame_;
  PictureTargets targets_;
};

}  // namespace shlight::viewer
