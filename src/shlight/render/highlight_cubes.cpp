#include "shlight/render/highlight_cubes.h"

#include <cstddef>

namespace shlight {
namespace {

bool same_lobe(const SurfaceReflectance& a, const SurfaceReflectance& b) {
  return b.highlight && a.highlight->lobe.width == b.highlight->lobe.width &&
         a.highlight->lobe.profile == b.highlight->lobe.profile &&
         a.highlight->lobe.wide_along_x == b.highlight->lobe.wide_along_x &&
         a.highlight->lobe.slopes == b.highlight->lobe.slopes;
}

}  // namespace

std::vector<CubeFaces> make_highlight_cubes(std::span<const SurfaceReflectance> surfaces, const RenderLight& light,
                                            int bands, const Progress& progress) {
  constexpr int kWidth = 256;  // of a light that is coefficients
  const Image picture =
      light.background.num_pixels() > 0 ? light.background : CoefficientLight(light.coefficients).lat_long(kWidth, 0);
  const ResidualLight residual(picture, taken_by_highlights(resize_bands(light.coefficients, bands)));
  std::vector<CubeFaces> cubes(surfaces.size());
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    report_progress(progress, static_cast<double>(i) / static_cast<double>(surfaces.size()));
    if (!surfaces[i].highlight) continue;
    const LobeFromAbove& lobe = surfaces[i].highlight->lobe;
    std::size_t same = 0;
    while (same < i && !same_lobe(surfaces[i], surfaces[same])) ++same;
    cubes[i] = same < i ? cubes[same] : prefilter_cube(residual, lobe, prefiltered_size(lobe.width));
  }
  report_progress(progress, 1);
  return cubes;
}

}  // namespace shlight
