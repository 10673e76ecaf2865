#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "shlight/transfer/world_mesh.h"

namespace shlight {

// Where transfer is traced: once for all vertices of equal position and normal, in a sequence in which neighbours stand
// beside each other, so that their rays meet the same parts of the scene.
struct Sites {
  std::vector<std::uint32_t> of_vertex;
  std::vector<Vec3f> positions, normals;
  std::vector<Vec3f> origins;  // where rays begin, a little before the surface (contacts.h)

  std::size_t size() const { return positions.size(); }
};

Sites make_sites(const WorldMesh& world, int threads);

}  // namespace shlight
