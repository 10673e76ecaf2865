#include "shlight/transfer/world_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "shlight/core/error.h"
#include "shlight/scene/transform.h"

namespace shlight {
namespace {

bool is_finite(Vec3f v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void check_index(std::string_view subject, std::string_view what, std::size_t index, std::size_t count) {
  if (index >= count) throw Error(subject, fmt::format("{} {} of {}", what, index, count), "one that there is");
}

void check_length(std::string_view subject, std::string_view what, std::size_t length, std::size_t vertices,
                  bool may_be_empty) {
  if (length == vertices || (may_be_empty && length == 0)) return;
  throw Error(subject, fmt::format("{} {} for {} vertices", length, what, vertices),
              may_be_empty ? "none or as many" : "as many");
}

void check_mesh(const Mesh& mesh, std::size_t number, const Scene& scene) {
  const std::string subject = fmt::format("mesh {} \"{}\"", number, mesh.name);
  const std::size_t vertices = mesh.positions.size();
  check_length(subject, "normals", mesh.normals.size(), vertices, false);
  check_length(subject, "texture coordinates", mesh.texcoords.size(), vertices, true);
  check_length(subject, "colours", mesh.colors.size(), vertices, true);
  if (mesh.indices.size() % 3 != 0)
    throw Error(subject, fmt::format("{} indices", mesh.indices.size()), "three for each triangle");
  for (const std::uint32_t index : mesh.indices) check_index(subject, "vertex", index, vertices);
  if (!mesh.indices.empty()) check_index(subject, "material", mesh.material, scene.materials.size());
  for (std::size_t v = 0; v < vertices; ++v) {
    if (!is_finite(mesh.positions[v]))
      throw Error(subject, fmt::format("the position of vertex {} is not finite", v), "finite positions");
    if (!is_finite(mesh.normals[v]) || mesh.normals[v] == Vec3f{})
      throw Error(subject, fmt::format("the normal of vertex {} has no direction", v), "normals of unit length");
  }
}

void check_scene(const Scene& scene) {
  for (std::size_t m = 0; m < scene.meshes.size(); ++m) check_mesh(scene.meshes[m], m, scene);
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const std::string subject = fmt::format("instance {}", i);
    const Mat4f& m = scene.instances[i].to_world;
    check_index(subject, "mesh", scene.instances[i].mesh, scene.meshes.size());
    // NaN fails this too.
    if (!(determinant(m) > 0) || !std::ranges::all_of(m, [](float e) { return std::isfinite(e); }))
      throw Error(subject, fmt::format("a matrix with the determinant {}", determinant(m)),
                  "finite ones of positive determinant, which neither flatten nor mirror");
  }
  for (const Material& material : scene.materials)
    if (material.texture)
      check_index(fmt::format("material \"{}\"", material.name), "texture", *material.texture, scene.textures.size());
  constexpr std::size_t kMost = std::numeric_limits<std::uint32_t>::max() / 3;
  if (num_vertices(scene) > kMost || num_triangles(scene) > kMost)
    throw Error("the scene", fmt::format("{} vertices and {} triangles", num_vertices(scene), num_triangles(scene)),
                fmt::format("at most {} of each", kMost));
}

}  // namespace

std::size_t WorldMesh::instance_of(std::size_t triangle) const {
  return static_cast<std::size_t>(std::ranges::upper_bound(first_triangle, triangle) - first_triangle.begin()) - 1;
}

WorldMesh make_world_mesh(const Scene& scene) {
  check_scene(scene);
  WorldMesh world;
  world.positions.reserve(num_vertices(scene));
  world.normals.reserve(num_vertices(scene));
  world.indices.reserve(3 * num_triangles(scene));
  const Bounds bounds = world_bounds(scene).value_or(Bounds{});
  const Vec3d middle = 0.5 * (vec_cast<double>(bounds.min) + vec_cast<double>(bounds.max));

  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    const std::size_t first = world.positions.size();
    world.first_vertex.push_back(first);
    world.first_triangle.push_back(world.indices.size() / 3);
    const Mat4f& m = instance.to_world;
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      // In double, since the way from the middle may be short where coordinates are large.
      const Vec3d p = vec_cast<double>(mesh.positions[v]);
      const Vec3d in_world = {m[0] * p.x + m[4] * p.y + m[8] * p.z + m[12],
                              m[1] * p.x + m[5] * p.y + m[9] * p.z + m[13],
                              m[2] * p.x + m[6] * p.y + m[10] * p.z + m[14]};
      world.positions.push_back(vec_cast<float>(in_world - middle));
      world.normals.push_back(transform_normal(m, mesh.normals[v]));
      const Vec3f q = world.positions.back(), n = world.normals.back();
      if (!is_finite(q) || !is_finite(n) || n == Vec3f{})
        throw Error(fmt::format("instance {}", world.first_vertex.size() - 1),
                    fmt::format("its matrix takes vertex {} out of range", v), "positions that floats can hold");
      world.radius = std::max({world.radius, std::abs(q.x), std::abs(q.y), std::abs(q.z)});
    }
    for (const std::uint32_t index : mesh.indices) world.indices.push_back(static_cast<std::uint32_t>(first + index));
  }
  world.first_vertex.push_back(world.positions.size());
  world.first_triangle.push_back(world.indices.size() / 3);
  return world;
}

}  // namespace shlight
