#pragma once

#include "shlight/scene/scene.h"

namespace shlight {

// A unit sphere around the origin, of `rings` x 2·`rings` quads; normals are exact.
Scene make_sphere_scene(int rings = 64);

// A (2, 3) torus knot that fits a unit sphere around the origin.
Scene make_knot_scene();

// A small still life on a round floor, lower than one unit and about two wide: things that touch, things that overhang,
// a red and a white thing side by side. For soft shadows and colour bleeding.
Scene make_still_life_scene();

}  // namespace shlight
