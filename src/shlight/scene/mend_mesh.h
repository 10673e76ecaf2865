#pragma once

#include <cstddef>

#include "shlight/scene/scene.h"

namespace shlight {

// How much was wrong with meshes.
struct MeshFaults {
  std::size_t non_finite_triangles = 0;  // a corner's position is NaN or infinite
  std::size_t degenerate_triangles = 0;  // exactly no area: two corners in one place, or all in a line
  std::size_t bad_normals = 0;           // of corners: zero, NaN or infinite
  std::size_t bad_attributes = 0;        // of corners: texture coordinates or colours that are NaN or infinite
};

// Makes any mesh whose indices and lengths hold into one that satisfies all that Mesh promises. Triangles that cannot
// be drawn are left out; normals that are missing or bad are made (see make_corner_normals); bad texture coordinates
// become (0, 0), bad colours white, and colours are clamped to [0, 1]. Vertices that are equal in all respects become
// one, unused ones go, the others stay in order of first use. Adds to `faults` what it met.
Mesh mend_mesh(const Mesh& mesh, float crease_degrees, MeshFaults& faults);

// The mesh as a mirror in the plane x = 0 shows it, itself counter-clockwise again.
Mesh mirror_mesh(Mesh mesh);

}  // namespace shlight
