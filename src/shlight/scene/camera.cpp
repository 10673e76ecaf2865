#include "shlight/scene/camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace shlight {
namespace {

// How much of the half picture the framed shape takes along its tighter axis.
constexpr double kFill = 0.94;

// Nearer than this, in radii, nothing is drawn; matters only where zoom takes the camera into the ball.
constexpr double kMinNear = 1e-3;

double radians(double degrees) {
  return degrees * std::numbers::pi / 180;
}

// The distance at which the ball fits a picture whose half sides have the tangents tan_x and tan_y.
double distance_to_ball(double radius, double tan_x, double tan_y) {
  const double tan_half = std::min(tan_x, tan_y);
  return radius * std::sqrt(1 + 1 / (tan_half * tan_half));
}

// The same for an upright cylinder of radius r and half height h, seen from the elevation e. A point p is inside the
// picture where |p·right| <= (d - p·toward) tan_x and |p·up| <= (d - p·toward) tan_y, so d is the largest
// p·toward + |p·right| / tan_x and p·toward + |p·up| / tan_y of the cylinder's two rims. With a rim's points
// (r cos t, ±h, r sin t), right = (1, 0, 0), up = (0, cos e, -sin e) and toward = (0, sin e, cos e) these are
//
//   ±h sin e + r (sin t cos e + |cos t| / tan_x),   at most  h |sin e| + r √(cos² e + 1 / tan_x²)
//   ±h (sin e ± cos e / tan_y) + r sin t (cos e ∓ sin e / tan_y), with each bracket's absolute value as the most.
double distance_to_cylinder(double r, double h, double elevation, double tan_x, double tan_y) {
  const double s = std::sin(elevation), c = std::cos(elevation);
  const double sideways = h * std::abs(s) + r * std::hypot(c, 1 / tan_x);
  const double top = h * std::abs(s + c / tan_y) + r * std::abs(c - s / tan_y);
  const double bottom = h * std::abs(s - c / tan_y) + r * std::abs(c + s / tan_y);
  return std::max({sideways, top, bottom});
}

double half_tangent(const Camera& camera) {
  return std::tan(0.5 * radians(camera.vertical_fov));
}

double clamped_elevation(const Camera& camera) {
  return radians(std::clamp(camera.elevation, -90.0, 90.0));
}

// Of the eye from what it looks at, in radii of the ball.
double distance_to_target(const Camera& camera, const Extent& extent, double aspect) {
  const double tan_y = half_tangent(camera), tan_x = tan_y * aspect;
  const double framed =
      std::min(distance_to_ball(1, kFill * tan_x, kFill * tan_y),
               distance_to_cylinder(extent.cylinder_radius / extent.radius, extent.half_height / extent.radius,
                                    clamped_elevation(camera), kFill * tan_x, kFill * tan_y));
  return framed / camera.zoom;
}

// The camera's axes in the world: one turned by the azimuth about +Y, then raised; it looks down −toward.
struct CameraAxes {
  Vec3d right, up, toward;
};
CameraAxes camera_axes(const Camera& camera) {
  const double azimuth = radians(camera.azimuth), elevation = clamped_elevation(camera);
  const double sin_a = std::sin(azimuth), cos_a = std::cos(azimuth);
  const double sin_e = std::sin(elevation), cos_e = std::cos(elevation);
  return {{cos_a, 0, -sin_a}, {-sin_e * sin_a, cos_e, -sin_e * cos_a}, {cos_e * sin_a, sin_e, cos_e * cos_a}};
}

}  // namespace

Extent scene_extent(const Scene& scene) {
  const std::optional<Bounds> bounds = world_bounds(scene);
  if (!bounds) return {};
  Extent extent;
  const Vec3d low = vec_cast<double>(bounds->min), high = vec_cast<double>(bounds->max);
  extent.center = 0.5 * (low + high);
  extent.half_height = 0.5 * (high.y - low.y);
  extent.radius = extent.cylinder_radius = 0;
  for (const Instance& instance : scene.instances) {
    const Mat4f& m = instance.to_world;
    for (const Vec3f& q : scene.meshes[instance.mesh].positions) {
      const Vec3d p = vec_cast<double>(q);
      const Vec3d world = {m[0] * p.x + m[4] * p.y + m[8] * p.z + m[12], m[1] * p.x + m[5] * p.y + m[9] * p.z + m[13],
                           m[2] * p.x + m[6] * p.y + m[10] * p.z + m[14]};
      const double aside = std::hypot(world.x - extent.center.x, world.z - extent.center.z);
      extent.cylinder_radius = std::max(extent.cylinder_radius, aside);
      extent.radius = std::max(extent.radius, std::hypot(aside, world.y - extent.center.y));
    }
  }
  if (extent.radius == 0) extent.radius = extent.cylinder_radius = extent.half_height = 1;
  return extent;
}

View make_view(const Camera& camera, const Extent& extent, double aspect) {
  const double tan_y = half_tangent(camera), tan_x = tan_y * aspect;
  const double distance = distance_to_target(camera, extent, aspect);
  const auto [right, up, toward] = camera_axes(camera);
  View view = {};
  std::size_t row = 0;
  for (const Vec3d axis : {right, up, toward}) {
    const Vec3d scaled = 1 / extent.radius * axis;
    view.world_to_view[row] = scaled.x;
    view.world_to_view[4 + row] = scaled.y;
    view.world_to_view[8 + row] = scaled.z;
    view.world_to_view[12 + row] = -dot(scaled, extent.center);
    ++row;
  }
  view.world_to_view[12] -= dot(right, camera.target);
  view.world_to_view[13] -= dot(up, camera.target);
  view.world_to_view[14] -= dot(toward, camera.target) + distance;
  view.world_to_view[15] = 1;

  // OpenGL's perspective: what lies at the depth near comes to −1, far to 1.
  const double depth = distance + dot(toward, camera.target);  // of the ball's centre
  const double near = std::max(depth - 1.01, kMinNear), far = std::max(depth + 1.01, 2 * kMinNear);
  view.view_to_clip[0] = 1 / tan_x;
  view.view_to_clip[5] = 1 / tan_y;
  view.view_to_clip[10] = -(far + near) / (far - near);
  view.view_to_clip[11] = -1;
  view.view_to_clip[14] = -2 * far * near / (far - near);
  return view;
}

std::optional<PicturePlace> place_in_picture(const View& view, Vec3d point) {
  const auto seen = [&](std::size_t row) {
    const Mat4d& m = view.world_to_view;
    return m[row] * point.x + m[4 + row] * point.y + m[8 + row] * point.z + m[12 + row];
  };
  const double depth = -seen(2);
  if (!(depth > 0)) return {};
  return PicturePlace{view.view_to_clip[0] * seen(0) / depth, view.view_to_clip[5] * seen(1) / depth};
}

void pan_camera(Camera& camera, const Extent& extent, double aspect, double right, double up) {
  const double height = 2 * half_tangent(camera) * distance_to_target(camera, extent, aspect);
  const CameraAxes axes = camera_axes(camera);
  camera.target = camera.target - height * (right * axes.right + up * axes.up);
}

}  // namespace shlight
