#pragma once

#include "shlight/render/gl.h"
#include "shlight/render/gpu_scene.h"
#include "shlight/scene/camera.h"

namespace shlight {

// Draws the normals of scenes, of the world, as colours: 0.5 grey is 0, red +X, green +Y, blue +Z, where exposure is 1
// and no curve bends them. Needs a current context.
class NormalRenderer {
 public:
  NormalRenderer();

  // Draws into the framebuffer and viewport now bound.
  void draw(const GpuScene& scene, const View& view) const;

 private:
  gl::Program program_;
};

}  // namespace shlight
