#pragma once

#include "shlight/image/tone_map.h"
#include "shlight/render/gl.h"

namespace shlight {

// Linear radiance to a picture for a screen: exposure, a curve, by default a filmic one that keeps middle grey (0.18),
// takes 0 to 0 and all there is above to less than 1, then the sRGB transfer function. See tone_map.frag; tone_map() of
// image/ is the same on the processor. Needs a current context.
class ToneMapper {
 public:
  ToneMapper();

  // Draws `radiance`, a float texture, times the factor `exposure` into the framebuffer now bound, pixel by pixel.
  void draw(unsigned radiance, double exposure, ToneCurve curve = ToneCurve::kFilmic) const;

 private:
  gl::Program program_;
};

}  // namespace shlight
