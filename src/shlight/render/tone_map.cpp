#include "shlight/render/tone_map.h"

#include <epoxy/gl.h>

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

}  // namespace shlight
