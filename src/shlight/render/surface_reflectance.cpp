#include "shlight/render/surface_reflectance.h"

#include <cstddef>

#include "shlight/brdf/metallic_roughness.h"
#include "shlight/core/assert.h"
#include "shlight/sh/window.h"

namespace shlight {
namespace {

// Of near mirrors, whose cube maps are large, a second's work on two cores.
constexpr int kLobeSamples = 64;

// Makes the highlight of a model and windows its slim lobes in the table, which has all lobes.
std::optional<SurfaceHighlight> make_highlight(const Brdf& brdf, ReflectanceTableParams params,
                                               ReflectanceTable& table) {
  const auto slim = make_slim_lobes(brdf);
  if (!slim) return std::nullopt;
  const ReflectanceTable lobes = make_reflectance_table(*slim, params);
  SHLIGHT_ASSERT_EQ(lobes.values.size(), table.values.size());
  std::vector<float> taken;  // of each number of an entry
  for (int l = 0; l < table.bands; ++l)
    taken.insert(taken.end(), static_cast<std::size_t>((table.isotropic() ? l + 1 : 2 * l + 1) * table.channels),
                 static_cast<float>(1 - window_factor(Window::kHann, 1.0 / table.bands, l)));
  for (std::size_t i = 0; i < table.values.size(); ++i) table.values[i] -= taken[i % taken.size()] * lobes.values[i];

  params.bands = 1;
  return SurfaceHighlight{make_reflectance_table(*slim, params), {}, sample_lobe_from_above(*slim, kLobeSamples)};
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
  std::optional<SurfaceHighlight> highlight;
  if (highlights) {
    highlight = make_highlight(*white_brdf, params, white);
    if (highlight) {
      const auto black_highlight = make_highlight(*black_brdf, params, black);
      highlight->tinted = std::move(highlight->plain);
      highlight->plain = black_highlight->plain;
      subtract(highlight->plain, *highlight->tinted);
    }
  }
  subtract(black, white);
  return {std::move(black), std::move(white), {}, std::move(highlight)};
}

// Two grey tables are two thirds of the numbers to look up and to turn, one is a third.
void use_grey_tables(SurfaceReflectance& surface) {
  std::vector<ColoredTable> parts = split_colors(*surface.plain);
  if (parts.empty()) return;
  surface.colors = {parts[0].color, parts.size() > 1 ? parts[1].color : Vec3f{}};
  surface.plain = std::move(parts[0].grey);
  if (parts.size() > 1) surface.tinted = std::move(parts[1].grey);
}

}  // namespace

RgbCoefficients taken_by_highlights(const RgbCoefficients& light) {
  return apply_window(Window::kHann, 1.0 / light.bands(), light);
}

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
  SurfaceReflectance surface = {make_reflectance_table(brdf, params), {}, {}, {}};
  if (highlights) surface.highlight = make_highlight(brdf, params, *surface.plain);
  if (surface.plain->channels == 3) use_grey_tables(surface);
  return {scene.materials.size(), surface};
}

}  // namespace shlight
