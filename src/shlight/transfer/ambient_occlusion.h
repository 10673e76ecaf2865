#pragma once

#include <span>

#include "shlight/sh/vec.h"

// What the first two bands of shadowed transfer say by themselves: how open a vertex is, and to where.
//
// Both are of A(s) = V(s) max(0, n·s)/π, the kind "shadowed" of transfer.h, coefficients in the world's frame. Of
// interreflected transfer they are something else, since its A also holds the light that surfaces send on: there the
// first is the brightness of a white surface under uniform light of radiance 1.

namespace shlight {

// Ambient occlusion as Zhukov, Iones & Kronin defined it [1], without a fall-off: ∫ V max(0, n·s)/π ds = √4π A_0, the
// share of uniform light that reaches the vertex straight. In [0, 1]: 1 is open. Everything occludes, however far away
// it is, and directions count as their cosine does: a value that counts all directions alike, or those within a radius
// only, differs. Takes at least one coefficient.
//
// [1] Zhukov, Iones, Kronin 1998, An Ambient Light Illumination Model, EGSR.
float eval_ambient_occlusion(std::span<const float> shadowed);

// The unit vector along ∫ V max(0, n·s)/π s ds = √(4π/3) (A_1,1, A_1,−1, A_1,0), the mean open direction, weighted with
// the cosine: the bent normal for looking up irradiance [2], exact for light that varies linearly with direction up to
// its length (2/3 where all is open), which is lost. Where all is open it is the normal; it is neither the mean of open
// directions without the cosine, nor always an open direction itself. `normal` where nothing is open. Takes at least
// four coefficients.
//
// [2] Landis 2002, Production-Ready Global Illumination, SIGGRAPH course 16.
Vec3f eval_bent_normal(std::span<const float> shadowed, Vec3f normal);

}  // namespace shlight
