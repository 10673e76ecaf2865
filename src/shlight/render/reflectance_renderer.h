#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <tuple>
#include <vector>

#include "shlight/scene/camera.h"
#include "shlight/render/gl.h"
#include "shlight/render/gpu_scene.h"
#include "shlight/render/surface_reflectance.h"
#include "shlight/sh/coefficients.h"
#include "shlight/sh/rotation.h"

namespace shlight {

// Where radiance is found: at each pixel, or at each vertex and interpolated, for which a mesh must be fine.
enum class Shade { kPixel, kVertex };

// Draws scenes by the reflectance method: radiance = Σ L_i F*_i(v), the light's coefficients times those that the
// surface has for the direction to the eye [1], which come from tables made before. The frames of light and surface
// meet in the shader, for every pixel or vertex anew, so that light, view and things may all turn. No shadows. Needs a
// current context.
//
// [1] Kautz, Sloan, Snyder 2002, Fast, Arbitrary BRDF Shading for Low-Frequency Lighting Using Spherical Harmonics,
//     Eurographics Workshop on Rendering.
class ReflectanceRenderer {
 public:
  // `surfaces` are those of the scene's materials, with tables of radiance.bands(), 1 to 10. Materials whose tables are
  // alike in kind share a shader, which is compiled here. Throws Error where memory runs out.
  ReflectanceRenderer(std::span<const SurfaceReflectance> surfaces, const RgbCoefficients& radiance, Shade shade);

  // From now on, paints stripes of this radiance where a channel of the radiance is negative; black: no more.
  void mark_negative(Vec3f radiance);

  // Draws into the framebuffer and viewport now bound: linear radiance, alpha 1. `scene` has tangents where
  // needs_tangents().
  void draw(const GpuScene& scene, const View& view, const Rotation& light_to_world = {}) const;

  bool needs_tangents() const { return needs_tangents_; }

 private:
  // Channels of ReflectanceGlslParams (0: Lambertian, without a table), isotropic.
  using Kind = std::pair<int, bool>;
  struct Surface {
    const gl::Program* program;
    gl::Texture table;
  };

  std::map<Kind, gl::Program> programs_;
  std::vector<Surface> surfaces_;  // of each material
  bool needs_tangents_ = false;
};

}  // namespace shlight
