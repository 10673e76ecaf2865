#pragma once

#include "shlight/image/image.h"
#include "shlight/image/layout.h"
#include "shlight/sh/vec.h"

namespace shlight {

// A picture that covers all directions. The picture's shape fits the layout.
struct Environment {
  Image image;
  Layout layout = Layout::kLatLong;

  PictureSize size() const { return {image.width, image.height}; }
};

// The radiance of the pixel that covers a direction: pixels are areas of constant radiance.
Rgb eval_nearest(const Environment& environment, Vec3d direction);

// Bilinear between the four pixel centres around. Goes on across the seam and over the poles of a lat-long map, from
// face to face of a cube, across the folds of an octahedral map; pixels of a disc whose centre lies outside count not.
Rgb eval_bilinear(const Environment& environment, Vec3d direction);

// Makes pixels black that stand for no direction: outside of a disc's circle, beside a cross's faces.
void clear_unused(Environment& environment);

}  // namespace shlight
