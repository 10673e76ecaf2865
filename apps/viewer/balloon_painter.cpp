#include "balloon_painter.h"

#include "shlight/scene/transform.h"

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

// Fills the picture from any side: the smallest ball about the middle of its box, which turns with it.
Extent frame_of(const Scene& balloon, const Rotation& rotation) {
  Extent extent = scene_extent(balloon);
  extent.center = rotation(extent.center);
  extent.cylinder_radius = extent.half_height = extent.radius;
  return extent;
}

}  // namespace

std::shared_ptr<const PictureTarget> BalloonPainter::paint(const std::shared_ptr<const Scene>& balloon,
                                                           const Rotation& rotation, const Camera& camera, int width,
                                                           int height) {
  if (!renderer_) {
    renderer_.emplace(IrradianceRenderer(soft_light()));
    background_.emplace(grey());
  }
  if (balloon_ != balloon || rotation_.rows != rotation.rows) {
    Scene turned = *balloon;
    turned.instances.front().to_world = make_rotation(rotation);
    gpu_scene_.emplace(turned);
    balloon_ = balloon, rotation_ = rotation;
  }
  if (!frame_ || frame_->width() != width || frame_->height() != height) frame_.emplace(width, height);
  Camera seen;
  seen.azimuth = camera.azimuth, seen.elevation = camera.elevation, seen.zoom = 1;
  const Drawing drawing = {*gpu_scene_, frame_of(*balloon, rotation), *renderer_, &*background_, {}};
  frame_->draw(drawing, {seen, {}, 0, ToneCurve::kFilmic});
  const auto target = targets_.free_one(width, height);
  frame_->swap_picture(*target);
  gl::finish();
  return target;
}

}  // namespace shlight::viewer
