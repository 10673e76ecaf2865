#pragma once

#include <cstdint>
#include <vector>

#include "shlight/image/image.h"
#include "shlight/render/gl.h"
#include "shlight/scene/camera.h"
#include "shlight/sh/coefficients.h"
#include "shlight/sh/rotation.h"

namespace shlight {

// A picture of radiance as the card takes it at once: half floats, four a pixel, in [0, 65504].
struct HalfPicture {
  int width = 0, height = 0;
  std::vector<std::uint16_t> rgba;
};

// `image` times `scale`, clamped, with 0 for NaN. Needs no context: what takes a while can be done on any thread.
HalfPicture make_half_picture(const Image& image, double scale);

// The environment that a light is, drawn at infinity behind what has been drawn. Needs a current context.
class Background {
 public:
  // From a lat-long picture of radiance, multiplied by `scale`: the centre is -Z, the right +X, the top +Y. Kept as
  // half floats: values are clamped to [0, 65504], NaN becomes 0. Reduced where it is bigger than the card takes.
  Background(const Image& lat_long, double scale);
  // The same of one that the card takes as it is: 2048 pixels wide, or as wide as GL_MAX_TEXTURE_SIZE.
  explicit Background(const HalfPicture& lat_long);

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
