#pragma once

#include "shlight/image/environment.h"
#include "shlight/sh/coefficients.h"

namespace shlight {

// The coefficients of a picture whose pixels are areas of constant radiance, exact but for rounding: each pixel's
// integral of the basis, not its value at the centre. Finite pixels only; lat-long maps of at least 1 x 1. The same
// bits whatever the number of threads (0: all there are).
//
// A lat-long map is separable and takes about as long as reading its memory twice; of other layouts the basis is
// evaluated at four nodes a pixel or more. See project_image.cpp.
RgbCoefficients project_image(const Environment& environment, int bands, int threads = 0);

// The slow reference: pixel by pixel, node by node, in double.
RgbCoefficients project_image_by_pixels(const Environment& environment, int bands, int threads = 0);

}  // namespace shlight
