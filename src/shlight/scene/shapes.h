#pragma once

#include <span>
#include <vector>

#include "shlight/scene/scene.h"

namespace shlight {

// Closed shapes, finely cut, with exact normals, a vertex where others would have a seam. No side is open and every
// edge is rounded, so that each position has one normal.

// Around the origin, poles at +Y and -Y, `rings` >= 2 from pole to pole and twice as many around.
Mesh make_sphere(float radius, int rings);

// Around the origin. Edges have the radius `rounding`, at most half the least of `size`, each a quarter circle of 2 ·
// `steps` pieces; no quad is longer than `max_step`.
Mesh make_rounded_box(Vec3f size, float rounding, int steps, float max_step);

// A tube of radius `tube` around a trefoil, the (2, 3) torus knot, that winds on a torus around the Z axis with the
// radii `major` and `minor`: `along` quads along it and `around` around it.
struct TorusKnotParams {
  float major = 2, minor = 1, tube = 0.5f;
  int along = 512, around = 48;
};
Mesh make_torus_knot(const TorusKnotParams& params);

// A corner of the outline of a turned piece, rounded with the radius `rounding`.
struct OutlineCorner {
  float radius = 0, height = 0;  // from the Y axis, along it
  float rounding = 0;
};
// What a lathe makes: the outline from the axis at the bottom, around the outside, back to the axis at the top, turned
// around the Y axis in `segments` steps. It must leave and reach the axis at a right angle, which is what keeps the
// poles smooth, and roundings must fit between their neighbours. No quad is longer than `max_step` along the outline.
Mesh make_turned(std::span<const OutlineCorner> outline, int segments, float max_step);

}  // namespace shlight
