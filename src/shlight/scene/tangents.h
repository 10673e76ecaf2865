#pragma once

#include <vector>

#include "shlight/scene/scene.h"

namespace shlight {

// A tangent for each vertex, along which anisotropic surfaces are brushed: of unit length and orthogonal to the normal.
// Where the mesh has texture coordinates, it is the direction in which u grows, averaged over the triangles around the
// vertex by their areas; where it has none, or they do not vary there, the horizontal direction +Y x normal, as a lathe
// that turns about the vertical leaves its grooves. That is without a seam but where the normal is vertical: there, +X.
std::vector<Vec3f> make_tangents(const Mesh& mesh);

}  // namespace shlight
