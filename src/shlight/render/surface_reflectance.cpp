#include "shlight/render/surface_reflectance.h"

#include <cstddef>

#include "shlight/brdf/metallic_roughness.h"
#include "shlight/core/assert.h"
#include "shlight/render/residual_light.h"

namespace shlight {
namespace {

std::optional<SurfaceHighlight> make_highlight(const Brdf& brdf, ReflectanceTableParams params) {
  const auto slim = make_slim_lobes(brdf);
  if (!slim) return std::nullopt;
  params.bands = 1;
  const LobeFromAbove few = sample_lobe_from_above(*slim, 16);
  return SurfaceHighlight{
      make_reflectance_table(*slim, params), {}, sample_lobe_from_above(*slim, num_prefilter_samples(few.width))};
}

// What is linear in the base colour, by black and white: plain, and what is to be tinted.
void subtract(const ReflectanceTable& black, ReflectanceTable& white) {
  SHLIGHT_ASSERT_EQ(white.values.size(), black.values.size());
  for (std::size_t i = 0; i < white.values.size(); ++i) white.values[i] -= black.values[i];
}

SurfaceReflectance make_glossy(const MetallicRoughness& gloss, const ReflectanceTableParams& params, bool highlights) {
  const auto brdf_of = [&](double base) {
    return make_metallic_roughness({base, base, base}, gloss.metallic, gloss.roughness);
  };
  const auto black_brdf = brdf_of(0), white_brdf = brdf_of(1);
  ReflectanceTable black = make_reflectance_table(*black_brdf, params);
  ReflectanceTable white = make_reflectance_table(*white_brdf, params);
  subtract(black, white);
  SurfaceReflectance surface = {std::move(black), std::move(white), {}};
  if (!highlights) return surface;
  surface.highlight = make_highlight(*white_brdf, params);
  if (!surface.highlight) return surface;
  ReflectanceTable tinted = std::move(surface.highlight->plain);
  const auto black_highlight = make_highlight(*black_brdf, params);
  surface.highlight->plain = black_highlight->plain;
  subtract(surface.highlight->plain, tinted);
  surface.highlight->tinted = std::move(tinted);
  return surface;
}

}  // namespace

std::vector<SurfaceReflectance> make_surface_reflectances(const Scene& scene, const ReflectanceTableParams& params,
                                                          bool highlights, const Progress& progress) {
  std::vector<SurfaceReflectance> surfaces(scene.materials.size());
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    report_progress(progress, static_cast<double>(i) / static_cast<double>(surfaces.size()));
    const std::optional<MetallicRoughness>& gloss = scene.materials[i].gloss;
    if (!gloss) continue;
    std::size_t same = 0;
    while (scene.materials[same].gloss != gloss) ++same;
    surfaces[i] = same < i ? surfaces[same] : make_glossy(*gloss, params, highlights);
  }
  report_progress(progress, 1);
  return surfaces;
}

std::vector<SurfaceReflectance> make_surface_reflectances(const Scene& scene, const Brdf& brdf,
                                                          const ReflectanceTableParams& params, bool highlights) {
  SurfaceReflectance surface = {make_reflectance_table(brdf, params), {}, {}};
  if (highlights) surface.highlight = make_highlight(brdf, params);
  return {scene.materials.size(), surface};
}

}  // namespace shlight
