#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "shlight/scene/scene.h"

namespace shlight {

// All instances of a scene as one mesh in the world, instance after instance.
struct WorldMesh {
  // Relative to the middle of the scene, where floats are finest.
  std::vector<Vec3f> positions;
  std::vector<Vec3f> normals;  // of unit length
  std::vector<std::uint32_t> indices;
  std::vector<std::size_t> first_vertex, first_triangle;  // of each instance, and at the end how many there are
  float radius = 0;                                       // no |component| of a position is larger

  // The instance that a triangle is of.
  std::size_t instance_of(std::size_t triangle) const;
};

// Throws Error where meshes and instances do not keep what scene.h promises, except that triangles may be without area.
WorldMesh make_world_mesh(const Scene& scene);

}  // namespace shlight
