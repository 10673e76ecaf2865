#pragma once

#include "shlight/scene/scene.h"
#include "shlight/sh/coefficients.h"

namespace shlight {

// The function that coefficients stand for as a surface around the origin: as far away in each direction as the
// absolute luminance there, of the largest distance 1, in its own hue; magenta where the luminance is negative. A small
// ball for a function that is zero.
Scene make_balloon(const RgbCoefficients& radiance, int rings = 48);

}  // namespace shlight
