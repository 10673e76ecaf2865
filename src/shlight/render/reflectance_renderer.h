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
#include "shlight/render/highlight_light.h"
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
// The hybrid method, after [2], has two parts more, HighlightLight: the sun as a directional light, and the residual of
// both, averaged over the lobe that the surface shows an eye right above and mirrored into place. Both are reflected by
// the albedo for the view: the sun by a lobe whose facets have the slopes of the one from above and hide each other as
// grooves do [3], and by diffuse lobes as Lambert's; the residual by highlights alone. Coefficients, sun and residual
// add up to the light, so that a slim lobe shows the light itself, and a wide one, over which the residual averages to
// nothing, what the reflectance method shows.
//
// [1] Kautz, Sloan, Snyder 2002, Fast, Arbitrary BRDF Shading for Low-Frequency Lighting Using Spherical Harmonics,
//     Eurographics Workshop on Rendering.
// [2] Chen, Liu 2008, Lighting and Material of Halo 3, SIGGRAPH courses.
// [3] Cook, Torrance 1982, A Reflectance Model for Computer Graphics, ACM TOG 1(1).
class ReflectanceRenderer {
 public:
  // `surfaces` are those of the scene's materials, with tables of radiance.bands(), 1 to 10. Materials whose tables are
  // alike in kind share a shader, which is compiled here. With `highlights`, those of make_highlight_light, times
  // `unit`, the hybrid method; surfaces have highlights only then. Throws Error where memory runs out.
  ReflectanceRenderer(std::span<const SurfaceReflectance> surfaces, const RgbCoefficients& radiance, Shade shade,
                      const HighlightLight* highlights = nullptr, double unit = 1);

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
    bool sun = false;  // of the hybrid method
    auto operator<=>(const Kind&) const = default;
  };
  struct Surface {
    const gl::Program* program = nullptr;
    gl::Texture table, residual, slope_density;
    std::vector<float> slopes;  // of LobeFromAbove
    bool wide_along_x = false;
    std::optional<ReflectanceColors> colors;
    double sun_share = 0;
    Vec3f slope_scale;  // of slopes along the tangent and across it, as in slope_density; the lobe's width
  };

  gl::Program make_program(const Kind& kind, const RgbCoefficients& radiance, Shade shade) const;

  RgbCoefficients radiance_;
  RgbCoefficients sun_coefficients_;  // those of HighlightLight, times the unit
  Vec3f to_sun_, sun_irradiance_;
  std::map<Kind, gl::Program> programs_;
  std::vector<Surface> surfaces_;  // of each material
  bool needs_tangents_ = false;
};

}  // namespace shlight
