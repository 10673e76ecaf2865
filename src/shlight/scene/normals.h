#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "shlight/sh/vec.h"

namespace shlight {

// Makes a unit normal for each corner of each triangle (as many as `indices`): the mean of the normals of the triangles
// around the corner's position, weighted by their angles there [1], which hardly depends on how the surface was cut
// into triangles. Triangles contribute to each other's where a way from one to the other around the position crosses no
// crease: no edge whose two triangles' normals differ by more than `crease_degrees`, no open edge. 0 gives flat
// triangles, 180 smooths everything. Equal positions are one position whatever their index, so that a soup of triangles
// becomes smooth too. A triangle without area contributes nothing and gets +Y where nothing else gives it a normal.
//
// Indices must be below positions.size(), positions finite. Takes n log n time.
//
// [1] Thürmer, Wüthrich: Computing vertex normals from polygonal facets. Journal of Graphics Tools 3 (1), 1998.
std::vector<Vec3f> make_corner_normals(std::span<const Vec3f> positions, std::span<const std::uint32_t> indices,
                                       float crease_degrees);

}  // namespace shlight
