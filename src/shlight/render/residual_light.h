#pragma once

#include <array>
#include <span>
#include <vector>

#include "shlight/image/environment.h"
#include "shlight/image/image.h"
#include "shlight/render/slim_lobe.h"
#include "shlight/sh/coefficients.h"

namespace shlight {

// What a light has beyond its first bands: picture minus reconstruction, so that both together are the light. Negative
// in some directions. A pyramid of ever smaller cube maps, for means over lobes of any width.
class ResidualLight {
 public:
  // `picture` is a lat-long map of radiance, `coefficients` those of the same light.
  ResidualLight(const Image& picture, const RgbCoefficients& coefficients, int threads = 0);

  // The mean over about 2^level x 2^level pixels of the finest cube map around `direction`.
  Rgb eval(Vec3d direction, double level) const;
  // A cube map of about this size, its faces below each other.
  const Environment& level_of_size(int size) const;
  // Of the finest cube map, on average.
  double pixel_solid_angle() const;

 private:
  std::vector<Environment> levels_;
};

// Six square faces of size x size pixels in OpenGL's sequence and orientation (+X −X +Y −Y +Z −Z), rows as glTexImage2D
// takes them: the mean of the light over `lobe` turned around each pixel's direction. Small faces, those of wide lobes,
// are summed over all pixels of a level, so that small bright lamps leave no pattern; large ones over the lobe's
// samples.
using CubeFaces = std::array<Image, 6>;
CubeFaces prefilter_cube(const ResidualLight& light, const LobeFromAbove& lobe, int size, int threads = 0);

// A size whose pixels are slim enough for a lobe of this width (BrdfLobe::width_x), a power of two.
int prefiltered_size(double width);

}  // namespace shlight
