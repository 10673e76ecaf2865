#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "shlight/render/gl.h"
#include "shlight/render/gpu_scene.h"
#include "shlight/render/residual_light.h"
#include "shlight/render/surface_reflectance.h"
#include "shlight/scene/camera.h"
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
// The hybrid method, after [2], adds what the coefficients leave out of highlights: the residual of the light, averaged
// over the lobe that the surface shows an eye right above and mirrored into place, times the lobe's albedo for the
// view. Coefficients and residual add up to the light, so that a slim lobe shows the light itself, and a wide one, over
// which the residual averages to nothing, what the reflectance method shows.
//
// [1] Kautz, Sloan, Snyder 2002, Fast, Arbitrary BRDF Shading for Low-Frequency Lighting Using Spherical Harmonics,
//     Eurographics Workshop on Rendering.
// [2] Chen, Liu 2008, Lighting and Material of Halo 3, SIGGRAPH courses.
class ReflectanceRenderer {
 public:
  // `surfaces` are those of the scene's materials, with tables of radiance.bands(), 1 to 10. Materials whose tables are
  // alike in kind share a shader, which is compiled here. With `cubes`, those of make_highlight_cubes, times
  // `unit`, the hybrid method: `surfaces` have highlights, which reflect them too; without it, they have none. Throws
  // Error where memory runs out.
  ReflectanceRenderer(std::span<const SurfaceReflectance> surfaces, const RgbCoefficients& radiance, Shade shade,
                      std::span<const CubeFaces> cubes = {}, double unit = 1);

  // From now on, the light of the coefficients; of as many bands.
  void set_radiance(const RgbCoefficients& radiance);

  // From now on, paints stripes of this radiance where a channel of the radiance is negative; black: no more.
  void mark_negative(Vec3f radiance);

  // Draws into the framebuffer and viewport now bound: linear radiance, alpha 1. `scene` has tangents where
  // needs_tangents().
  void draw(const GpuScene& scene, const View& view, const Rotation& light_to_world = {}) const;

  bool needs_tangents() const { return needs_tangents_; }

 private:
  struct Kind {
    int channels = 0;  // of ReflectanceGlslParams; 0: Lambertian, without a table
    bool isotropic = true;
    bool colored = false;  // ReflectanceColors
    bool hybrid = false;
    auto operator<=>(const Kind&) const = default;
  };
  struct Surface {
    const gl::Program* program;
    gl::Texture table, residual;
    std::vector<float> slopes;  // of LobeFromAbove
    bool wide_along_x;
    std::optional<ReflectanceColors> colors;
  };

  gl::Program make_program(const Kind& kind, const RgbCoefficients& radiance, Shade shade) const;

  std::map<Kind, gl::Program> programs_;
  std::vector<Surface> surfaces_;  // of each material
  bool needs_tangents_ = false;
};

}  // namespace shlight
