#include "shlight/scene/scene.h"

#include <algorithm>

#include "shlight/scene/transform.h"

namespace shlight {

std::size_t num_triangles(const Scene& scene) {
  std::size_t count = 0;
  for (const Instance& instance : scene.instances) count += scene.meshes[instance.mesh].indices.size() / 3;
  return count;
}

std::size_t num_vertices(const Scene& scene) {
  std::size_t count = 0;
  for (const Instance& instance : scene.instances) count += scene.meshes[instance.mesh].positions.size();
  return count;
}

std::optional<Bounds> world_bounds(const Scene& scene) {
  std::optional<Bounds> bounds;
  for (const Instance& instance : scene.instances)
    for (const Vec3f& position : scene.meshes[instance.mesh].positions) {
      const Vec3f p = transform_point(instance.to_world, position);
      if (!bounds) bounds = Bounds{p, p};
      bounds->min = {std::min(bounds->min.x, p.x), std::min(bounds->min.y, p.y), std::min(bounds->min.z, p.z)};
      bounds->max = {std::max(bounds->max.x, p.x), std::max(bounds->max.y, p.y), std::max(bounds->max.z, p.z)};
    }
  return bounds;
}

}  // namespace shlight
