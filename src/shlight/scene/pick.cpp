#include "shlight/scene/pick.h"

#include <algorithm>
#include <vector>

namespace shlight {
namespace {

Mat4d product(const Mat4d& a, const Mat4d& b) {
  Mat4d result = {};
  for (std::size_t column = 0; column < 4; ++column)
    for (std::size_t row = 0; row < 4; ++row)
      for (std::size_t k = 0; k < 4; ++k) result[4 * column + row] += a[4 * k + row] * b[4 * column + k];
  return result;
}

// A vertex near the point: how far away in the picture, squared, and in depth.
struct Candidate {
  PickedVertex picked;
  double squared_distance, depth;
};

}  // namespace

std::optional<PickedVertex> pick_vertex(const Scene& scene, const View& view, double x, double y, double reach) {
  const double aspect = view.view_to_clip[5] / view.view_to_clip[0];
  const Mat4d world_to_clip = product(view.view_to_clip, view.world_to_view);
  std::vector<Candidate> candidates;
  std::size_t vertex = 0;
  for (const Instance& instance : scene.instances) {
    Mat4d to_world;
    std::ranges::copy(instance.to_world, to_world.begin());
    const Mat4d m = product(world_to_clip, to_world);
    for (const Vec3f& p : scene.meshes[instance.mesh].positions) {
      const auto row = [&](const Mat4d& a, std::size_t r) {
        return a[r] * p.x + a[4 + r] * p.y + a[8 + r] * p.z + a[12 + r];
      };
      const double w = row(m, 3);  // the depth before the eye
      const double right = aspect * (row(m, 0) / w - x), up = row(m, 1) / w - y;
      if (w > 0 && right * right + up * up <= reach * reach)
        candidates.push_back(
            {{vertex, {row(to_world, 0), row(to_world, 1), row(to_world, 2)}}, right * right + up * up, w});
      ++vertex;
    }
  }
  if (candidates.empty()) return {};
  // What lies well behind the nearest is hidden by it; depth is in radii of the scene.
  constexpr double kThickness = 0.05;
  const double nearest = std::ranges::min(candidates, {}, &Candidate::depth).depth;
  std::erase_if(candidates, [&](const Candidate& c) { return c.depth > nearest + kThickness; });
  return std::ranges::min(candidates, {}, &Candidate::squared_distance).picked;
}

}  // namespace shlight
