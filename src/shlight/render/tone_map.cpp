#include "shlight/render/tone_map.h"

#include <epoxy/gl.h>

#include "shaders.h"

namespace shlight {

ToneMapper::ToneMapper() : program_(shaders::fullscreen_vert, shaders::tone_map_frag) {}

void ToneMapper::draw(unsigned radiance, double exposure, ToneCurve curve) const {
  program_.use();
  program_.set("u_radiance", 0);
  program_.set("u_exposure", static_cast<float>(exposure));
  program_.set("u_filmic", curve == ToneCurve::kFilmic ? 1 : 0);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, radiance);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  gl::draw_fullscreen_triangle();
}

}  // namespace shlight
