#pragma once

#include "shlight/image/image.h"
#include "shlight/render/gl.h"
#include "shlight/scene/camera.h"
#include "shlight/sh/coefficients.h"
#include "shlight/sh/rotation.h"

namespace shlight {

// The environment that a light is, drawn at infinity behind what has been drawn. Needs a current context.
class Background {
 public:
  // From a lat-long picture of radiance, multiplied by `scale`: the centre is -Z, the right +X, the top +Y. Kept as
  // half floats: values are clamped to [0, 65504], NaN becomes 0. Reduced where it is bigger than the card takes.
  Background(const Image& lat_long, double scale);

  // Reconstructed from 1 to 10 bands of coefficients, 0 where the sum is negative.
  explicit Background(const RgbCoefficients& radiance);

  // Draws where depth is still that of the far plane.
  void draw(const View& view, const Rotation& light_to_world = {}) const;

 private:
  gl::Program program_;
  gl::Texture image_;  // 0 without a picture
};

// Averages blocks of k x k pixels, with the smallest k that makes both sides at most `max_size`. At the right and lower
// edge blocks may be partial. The picture itself where it is small enough.
Image reduce_to_size(const Image& image, int max_size);

}  // namespace shlight
