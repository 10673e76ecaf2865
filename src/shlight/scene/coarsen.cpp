#include "shlight/scene/coarsen.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "shlight/scene/weld.h"

namespace shlight {
namespace {

// The positions, each moved by `distance` to where the surface looks: what lies close together but looks elsewhere, as
// the other side of a thin wall, is parted by that, and what is at the same place, as at edges and seams, is not.
std::vector<Vec3f> moved_out(const Mesh& mesh, float distance) {
  const Weld weld = weld_positions(mesh.positions);
  std::vector<Vec3f> normals(weld.first.size());
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    Vec3f& normal = normals[weld.group[v]];
    normal = normal + mesh.normals[v];
  }
  std::vector<Vec3f> moved = mesh.positions;
  for (std::size_t v = 0; v < moved.size(); ++v) {
    const Vec3f normal = normals[weld.group[v]];
    if (const float n = std::sqrt(dot(normal, normal)); n > 0) moved[v] = moved[v] + (distance / n) * normal;
  }
  return moved;
}

float extent_of(const std::vector<Vec3f>& positions) {
  Vec3f least = positions[0], most = positions[0];
  for (const Vec3f& p : positions) {
    least = {std::min(least.x, p.x), std::min(least.y, p.y), std::min(least.z, p.z)};
    most = {std::max(most.x, p.x), std::max(most.y, p.y), std::max(most.z, p.z)};
  }
  return std::max({most.x - least.x, most.y - least.y, most.z - least.z});
}

void coarsen(Mesh& mesh, std::size_t triangles) {
  // Fewer would hardly be the same thing, and are drawn at once.
  constexpr std::size_t kLeast = 128;
  triangles = std::max(triangles, kLeast);
  if (mesh.indices.size() / 3 <= triangles) return;
  // About the size of a triangle on a cube of the mesh's extent.
  const float distance = 0.4f * extent_of(mesh.positions) * std::sqrt(6 / static_cast<float>(triangles));
  const std::vector<Vec3f> positions = moved_out(mesh, distance);
  constexpr float kAnyError = 1;  // of the extent
  std::vector<std::uint32_t> indices(mesh.indices.size());
  indices.resize(meshopt_simplifySloppy(indices.data(), mesh.indices.data(), mesh.indices.size(), &positions[0].x,
                                        positions.size(), sizeof(Vec3f), 3 * triangles, kAnyError));
  if (!indices.empty()) mesh.indices = std::move(indices);  // else it would be gone
}

}  // namespace

Scene coarsen(Scene scene, std::size_t triangles) {
  const std::size_t all = num_triangles(scene);
  if (all <= triangles) return scene;
  const double share = static_cast<double>(triangles) / static_cast<double>(all);
  for (Mesh& mesh : scene.meshes)
    coarsen(mesh, static_cast<std::size_t>(share * static_cast<double>(mesh.indices.size() / 3)));
  return scene;
}

}  // namespace shlight
