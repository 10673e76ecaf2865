#include "shlight/render/surface_reflectance.h"

#include <cstddef>

#include "shlight/brdf/metallic_roughness.h"
#include "shlight/core/assert.h"

namespace shlight {
namespace {

SurfaceReflectance make_glossy(const MetallicRoughness& gloss, const ReflectanceTableParams& params) {
  // What is linear in the base colour is known from black and white.
  const auto table_of = [&](double base) {
    return make_reflectance_table(*make_metallic_roughness({base, base, base}, gloss.metallic, gloss.roughness),
                                  params);
  };
  ReflectanceTable black = table_of(0), white = table_of(1);
  SHLIGHT_ASSERT_EQ(white.values.size(), black.values.size());
  for (std::size_t i = 0; i < white.values.size(); ++i) white.values[i] -= black.values[i];
  return {std::move(black), std::move(white)};
}

}  // namespace

std::vector<SurfaceReflectance> make_surface_reflectances(const Scene& scene, const ReflectanceTableParams& params,
                                                          const Progress& progress) {
  std::vector<SurfaceReflectance> surfaces(scene.materials.size());
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    report_progress(progress, static_cast<double>(i) / static_cast<double>(surfaces.size()));
    const std::optional<MetallicRoughness>& gloss = scene.materials[i].gloss;
    if (!gloss) continue;
    std::size_t same = 0;
    while (scene.materials[same].gloss != gloss) ++same;
    surfaces[i] = same < i ? surfaces[same] : make_glossy(*gloss, params);
  }
  report_progress(progress, 1);
  return surfaces;
}

std::vector<SurfaceReflectance> make_surface_reflectances(const Scene& scene, const Brdf& brdf,
                                                          const ReflectanceTableParams& params) {
  return {scene.materials.size(), SurfaceReflectance{make_reflectance_table(brdf, params), {}}};
}

}  // namespace shlight
