#include "shlight/render/tone_map.h"

#include <epoxy/gl.h>

#include <cmath>
#include <numbers>

#include "shaders.h"

namespace shlight {

ToneMapper::ToneMapper() : program_(shaders::fullscreen_vert, shaders::tone_map_frag) {}

void ToneMapper::draw(unsigned radiance, double exposure) const {
  program_.use();
  program_.set("u_radiance", 0);
  program_.set("u_exposure", static_cast<float>(exposure));
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, radiance);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  gl::draw_fullscreen_triangle();
}

double auto_exposure(const RgbCoefficients& radiance) {
  constexpr double kExposedMean = 2 * 0.18;
  if (radiance.size() == 0) return 1;
  const double mean = luminance(radiance[0]) / std::sqrt(4 * std::numbers::pi);
  const double exposure = kExposedMean / mean;
  return mean > 0 && std::isfinite(exposure) ? exposure : 1;
}

}  // namespace shlight
