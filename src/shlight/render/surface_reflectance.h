#pragma once

#include <optional>
#include <vector>

#include "shlight/brdf/brdf.h"
#include "shlight/brdf/reflectance_table.h"
#include "shlight/core/progress.h"
#include "shlight/scene/scene.h"

namespace shlight {

// How a surface reflects, as reflectance coefficients of all views: radiance = Σ L_i (plain_i + base colour ·
// tinted_i), where the base colour is that of the material, the vertices and the texture together. Without any table, a
// Lambertian surface of its base colour.
struct SurfaceReflectance {
  std::optional<ReflectanceTable> plain;
  std::optional<ReflectanceTable> tinted;  // grey and of the size of `plain`, which is then there and grey too
};

// Of each material of the scene: glTF's metallic-roughness where it has gloss, which is linear in the base colour and
// so takes any texture; else Lambertian. Materials of equal gloss are computed once each. Throws Cancelled.
std::vector<SurfaceReflectance> make_surface_reflectances(const Scene& scene, const ReflectanceTableParams& params,
                                                          const Progress& progress = {});

// `brdf` for all materials of the scene, whatever their colours and textures.
std::vector<SurfaceReflectance> make_surface_reflectances(const Scene& scene, const Brdf& brdf,
                                                          const ReflectanceTableParams& params);

}  // namespace shlight
