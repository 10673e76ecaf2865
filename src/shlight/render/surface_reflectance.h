#pragma once

#include <optional>
#include <vector>

#include "shlight/brdf/brdf.h"
#include "shlight/brdf/reflectance_table.h"
#include "shlight/core/progress.h"
#include "shlight/render/slim_lobe.h"
#include "shlight/scene/scene.h"
#include "shlight/sh/coefficients.h"

namespace shlight {

// A surface's slim lobes (slim_lobe.h), for the light beyond the first bands: how much of what comes from the
// mirrored direction's surroundings they reflect to each view, as tables of one band and of the size of those below,
// and over which surroundings.
struct SurfaceHighlight {
  ReflectanceTable plain;
  std::optional<ReflectanceTable> tinted;
  LobeFromAbove lobe;
};

// The colours by which the grey tables of a model are multiplied, instead of white and the base colour.
struct ReflectanceColors {
  Vec3f plain, tinted;
};

// How a surface reflects, as reflectance coefficients of all views: radiance = Σ L_i (plain_i + base colour ·
// tinted_i), where the base colour is that of the material, the vertices and the texture together. Without any table, a
// Lambertian surface of its base colour.
struct SurfaceReflectance {
  std::optional<ReflectanceTable> plain;
  std::optional<ReflectanceTable> tinted;  // grey and of the size of `plain`, which is then there and grey too
  std::optional<ReflectanceColors> colors;
  std::optional<SurfaceHighlight> highlight;
};

// Of each material of the scene: glTF's metallic-roughness where it has gloss, which is linear in the base colour and
// so takes any texture; else Lambertian. Materials of equal gloss are computed once each. Throws Cancelled.
// `highlights`: whether those are made too. Slim lobes in the tables are then windowed as taken_by_highlights has the
// light.
std::vector<SurfaceReflectance> make_surface_reflectances(const Scene& scene, const ReflectanceTableParams& params,
                                                          bool highlights = false, const Progress& progress = {});

// What of a light slim lobes reflect by their coefficients, where the rest goes to highlights: its bands through Hann's
// window, after which hardly any light is negative. What is left to the residual is then mostly the lamps themselves,
// and does not have to make good in one direction what rings in another.
RgbCoefficients taken_by_highlights(const RgbCoefficients& light);

// `brdf` for all materials of the scene, whatever their colours and textures.
std::vector<SurfaceReflectance> make_surface_reflectances(const Scene& scene, const Brdf& brdf,
                                                          const ReflectanceTableParams& params,
                                                          bool highlights = false);

}  // namespace shlight
