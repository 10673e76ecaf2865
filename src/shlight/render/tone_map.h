#pragma once

#include "shlight/render/gl.h"
#include "shlight/sh/coefficients.h"

namespace shlight {

// Linear radiance to a picture for a screen: exposure, a filmic curve that keeps middle grey (0.18), takes 0 to 0 and
// all there is above to less than 1, then the sRGB transfer function. See tone_map.frag. Needs a current context.
class ToneMapper {
 public:
  ToneMapper();

  // Draws `radiance`, a float texture, times the factor `exposure` into the framebuffer now bound, pixel by pixel.
  void draw(unsigned radiance, double exposure) const;

 private:
  gl::Program program_;
};

// The factor that takes the mean luminance of a light over all directions, Y00 L00, to 0.36. That is one stop above
// middle grey: most of a captured light comes from a few bright directions overhead, and with the mean at 0.18 the
// model and what is to be seen behind it come out dark. 1 for a light whose mean is not above 0.
double auto_exposure(const RgbCoefficients& radiance);

}  // namespace shlight
