#include "balloon_painter.h"

namespace shlight::viewer {
namespace {

// What the balloon is lit by: soft, and bright from everywhere.
RgbCoefficients soft_light() {
  RgbCoefficients light(2);
  light[0] = {2.6, 2.6, 2.6};
  light.at(1, -1) = {0.9, 0.9, 0.9};
  light.at(1, 0) = {0.35, 0.35, 0.35};
  return light;
}

RgbCoefficients grey() {
  RgbCoefficients light(1);
  light[0] = {0.085, 0.09, 0.1};
  return light;
}

}  // namespace

std::shared_ptr<const PictureTarget> BalloonPainter::paint(const std::shared_ptr<const Scene>& balloon,
                                                           const Camera& camera, int width, int height) {
  if (!renderer_) {
    renderer_.emplace(IrradianceRenderer(soft_light()));
    background_.emplace(grey());
  }
  if (balloon_ != balloon) {
    gpu_scene_.emplace(*balloon);
    balloon_ = balloon;
  }
  if (!frame_ || frame_->width() != width || frame_->height() != height) frame_.emplace(width, height);
  Camera seen;
  seen.azimuth = camera.azimuth, seen.elevation = camera.elevation, seen.zoom = 1;
  const Extent ball;  // balloons have radius 1
  frame_->draw({*gpu_scene_, ball, *renderer_, &*background_, {}}, {seen, {}, 0, ToneCurve::kFilmic});
  const auto target = targets_.free_one(width, height);
  frame_->swap_picture(*target);
  gl::finish();
  return target;
}

}  // namespace shlight::viewer
