#pragma once

#include "shlight/render/gl.h"
#include "shlight/render/gpu_scene.h"
#include "shlight/scene/camera.h"
#include "shlight/sh/coefficients.h"
#include "shlight/sh/rotation.h"

namespace shlight {

// Draws scenes by the irradiance method: radiance = base colour / π · E(n), where E comes from the light's coefficients
// and the pixel's normal alone. No shadows, nothing precomputed, any mesh. Needs a current context.
//
// [1] Ramamoorthi, Hanrahan: An Efficient Representation for Irradiance Environment Maps. SIGGRAPH 2001.
class IrradianceRenderer {
 public:
  // `radiance` has 1 to 10 bands. Compiles a shader for their number.
  explicit IrradianceRenderer(const RgbCoefficients& radiance);

  // From now on, the light of the coefficients; of as many bands.
  void set_radiance(const RgbCoefficients& radiance);

  // From now on, paints stripes of this radiance where a channel of the irradiance is negative; black: no more.
  void mark_negative(Vec3f radiance);

  // Draws into the framebuffer and viewport now bound: linear radiance, alpha 1.
  void draw(const GpuScene& scene, const View& view, const Rotation& light_to_world = {}) const;

 private:
  gl::Program program_;
};

}  // namespace shlight
