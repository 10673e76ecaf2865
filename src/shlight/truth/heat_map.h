#pragma once

#include "shlight/image/image.h"
#include "shlight/truth/plane.h"

namespace shlight {

// The colour of t in [0, 1], linear Rec. 709: from nearly black over violet, red and orange to a pale yellow, each step
// of t as much lighter as any other (OKLab's lightness [1]), so that it can be read in grey too.
//
// [1] Ottosson 2020, A perceptual color space for image processing, https://bottosson.github.io/posts/oklab.
Rgb heat_color(double t);

// A plane as a picture, a value of `largest` and more the lightest colour; `largest` above 0. Right of it stands a
// scale with numbers, which makes the picture kScaleWidth wider and at least kScaleHeight high.
Image8 make_heat_map(const Plane& plane, double largest);

inline constexpr int kScaleWidth = 72, kScaleHeight = 64;

}  // namespace shlight
