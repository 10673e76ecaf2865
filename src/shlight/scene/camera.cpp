#include "shlight/render/camera.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <optional>

#include "shlight/render/matrices.h"

namespace shlight {
namespace {

// How much of the half picture the framed shape takes along its tighter axis.
constexpr double kFill = 0.94;

// Nearer than this, in radii, nothing is drawn; matters only where zoom takes the camera into the ball.
constexpr double kMinNear = 1e-3;

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
    const glm::dmat4 to_world = to_glm(instance.to_world);
    for (const Vec3f& p : scene.meshes[instance.mesh].positions) {
      const glm::dvec4 world = to_world * glm::dvec4(p.x, p.y, p.z, 1);
      const double aside = std::hypot(world.x - extent.center.x, world.z - extent.center.z);
      extent.cylinder_radius = std::max(extent.cylinder_radius, aside);
      extent.radius = std::max(extent.radius, std::hypot(aside, world.y - extent.center.y));
    }
  }
  if (extent.radius == 0) extent.radius = extent.cylinder_radius = extent.half_height = 1;
  return extent;
}

View make_view(const Camera& camera, const Extent& extent, double aspect) {
  const double azimuth = glm::radians(camera.azimuth);
  const double elevation = glm::radians(std::clamp(camera.elevation, -90.0, 90.0));
  const double tan_y = std::tan(0.5 * glm::radians(camera.vertical_fov)), tan_x = tan_y * aspect;

  // Everything from here on is in radii of the ball.
  const double framed =
      std::min(distance_to_ball(1, kFill * tan_x, kFill * tan_y),
               distance_to_cylinder(extent.cylinder_radius / extent.radius, extent.half_height / extent.radius,
                                    elevation, kFill * tan_x, kFill * tan_y));
  const double distance = framed / camera.zoom;

  // From the world, read from the right: the centre to the origin, scaled to radii, the azimuth undone, then the
  // elevation, then the camera moved back.
  glm::dmat4 view = glm::translate(glm::dmat4(1), glm::dvec3(0, 0, -distance));
  view = glm::rotate(view, elevation, glm::dvec3(1, 0, 0));
  view = glm::rotate(view, -azimuth, glm::dvec3(0, 1, 0));
  view = glm::scale(view, glm::dvec3(1 / extent.radius));
  view = glm::translate(view, -glm::dvec3(extent.center.x, extent.center.y, extent.center.z));

  const double near = std::max(distance - 1.01, kMinNear), far = distance + 1.01;
  return {to_mat4d(view), to_mat4d(glm::perspectiveRH_NO(2 * std::atan(tan_y), aspect, near, far))};
}

}  // namespace shlight
