#pragma once

#include <span>
#include <string>

#include "shlight/core/progress.h"
#include "shlight/image/image.h"
#include "shlight/image/tone_map.h"
#include "shlight/render/reflectance_renderer.h"
#include "shlight/render/render_light.h"
#include "shlight/render/surface_reflectance.h"
#include "shlight/scene/camera.h"
#include "shlight/scene/scene.h"
#include "shlight/sh/coefficients.h"
#include "shlight/sh/rotation.h"
#include "shlight/transfer/baked_file.h"
#include "shlight/transfer/shadow_ratio.h"
#include "shlight/transfer/transfer.h"

namespace shlight {

// What is drawn: the scene in the light, in one degree of it alone, or something else that is worth seeing. Normals and
// visibility take neither exposure nor curve nor a background.
enum class Show {
  kLit,
  kDegree,
  kNormals,    // NormalRenderer
  kVisibility  // by the transfer method: how open each vertex is, visibility_light
};

struct RenderParams {
  int width = 1280;
  int height = 720;
  int bands = 3;  // used of the light, which may have more, and of transfer; 1 to kMaxRenderBands
  Camera camera;
  Rotation rotate_light;    // of the light, before it falls on the scene
  double exposure = 0;      // stops, on top of auto_exposure() of the light
  int frames = 1;           // at least 1: how many are timed; the view turns once around in them
  bool turn_light = false;  // once around as well, the other way
  ToneCurve curve = ToneCurve::kFilmic;
  Show show = Show::kLit;
  int degree = 0;  // of kDegree, below `bands`
  bool show_background = true;
  bool mark_negative = false;   // magenta stripes where a channel of what a surface leaves is below zero
  Shade shade = Shade::kPixel;  // by the reflectance method
  // Of the scene's transfer, for methods that have none: irradiance, reflectance, hybrid.
  const ShadowRatio* shadows = nullptr;
};

struct RenderResult {
  Image radiance;       // linear, as lit, without exposure; 16-bit floats' precision
  Image8 picture;       // exposed, tone mapped, sRGB
  double frame_ms = 0;  // median over the frames, each from its first call until the device has finished it
  std::string gl_renderer;
};

// Draws `scene` under `light` by the irradiance method, on OpenGL ES 3.0 without a window: the first view untimed, as
// drivers compile late, then `frames` frames for the time. Throws Error where there is no such OpenGL or where it is
// too small for the picture; Cancelled.
RenderResult render_irradiance(const Scene& scene, const RenderLight& light, const RenderParams& params,
                               const Progress& progress = {});

// The same by the reflectance method: `surfaces` are those of the scene's materials, with tables of as many bands as
// are used of the light and without highlights.
RenderResult render_reflectance(const Scene& scene, std::span<const SurfaceReflectance> surfaces,
                                const RenderLight& light, const RenderParams& params, const Progress& progress = {});

// The same by the hybrid method: `surfaces` were made with highlights, which reflect all of light.background, or of the
// coefficients where there is none.
RenderResult render_hybrid(const Scene& scene, std::span<const SurfaceReflectance> surfaces, const RenderLight& light,
                           const RenderParams& params, const Progress& progress = {});

// The same by the transfer method: `transfer` is the scene's, as bake_transfer makes it.
RenderResult render_transfer(const Scene& scene, const Transfer& transfer, const RenderLight& light,
                             const RenderParams& params, const Progress& progress = {});

// The same of a baked file, with its transfer as it is stored: what was compressed is drawn compressed.
RenderResult render_baked(const Baked& baked, const RenderLight& light, const RenderParams& params,
                          const Progress& progress = {});

}  // namespace shlight
