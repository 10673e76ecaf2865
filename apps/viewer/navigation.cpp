#include "navigation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace shlight::viewer {
namespace {

constexpr double kDegreesAcross = 200;  // that dragging over the whole height turns

}  // namespace

void orbit(Settings& settings, double right, double up) {
  Camera& camera = settings.camera;
  camera.azimuth = std::remainder(camera.azimuth - kDegreesAcross * right, 360);
  camera.elevation = std::clamp(camera.elevation - kDegreesAcross * up, -90.0, 90.0);
}

void pan(Settings& settings, const Extent& extent, double aspect, double right, double up) {
  pan_camera(settings.camera, extent, aspect, right, up);
  // As far as `render` takes.
  constexpr double kFarthest = 100;
  for (double* v : {&settings.camera.target.x, &settings.camera.target.y, &settings.camera.target.z})
    *v = std::clamp(*v, -kFarthest, kFarthest);
}

// What is behind the model follows the pointer: about the vertical, and about the camera's own horizontal axis.
void turn_light(Settings& settings, double right, double up) {
  constexpr double kRadians = kDegreesAcross * std::numbers::pi / 180;
  const double azimuth = settings.camera.azimuth * std::numbers::pi / 180;
  const double half = 0.5 * kRadians * up;
  const Rotation tilt = rotation_from_quaternion(std::cos(half), std::sin(half) * std::cos(azimuth), 0,
                                                 -std::sin(half) * std::sin(azimuth));
  settings.rotate_light = tilt * rotation_about_y(-kRadians * right) * settings.rotate_light;
}

void zoom(Settings& settings, double steps) {
  constexpr double kStep = 1.12;
  settings.camera.zoom = std::clamp(settings.camera.zoom * std::pow(kStep, steps), 0.01, 100.0);
}

}  // namespace shlight::viewer
