#pragma once

#include <optional>
#include <span>
#include <vector>

#include "shlight/core/progress.h"
#include "shlight/light/sun.h"
#include "shlight/render/render_light.h"
#include "shlight/render/residual_light.h"
#include "shlight/render/surface_reflectance.h"

namespace shlight {

// A light as surfaces with highlights reflect it, in three parts that add up to it: the sun (split_sun), or a share of
// it, as a directional light; the first bands of the rest, which slim lobes take as taken_by_highlights has them; and
// what these leave out, averaged over the slim lobes, as cube maps.
struct HighlightLight {
  struct OfSurface {
    CubeFaces cube;        // without pictures where the surface has no highlight
    double sun_share = 0;  // 0 to 1
  };
  std::vector<OfSurface> surfaces;
  std::optional<Sun> sun;
  RgbCoefficients sun_coefficients{1};  // those of `sun` in the light's coefficients; zeros where there is none
};

// Of each surface and the first `bands` bands. Slim lobes have all of the sun as a directional light; near mirrors,
// which show its picture, have it in the cube map, and lobes that the bands hold, in the bands; between, some of both,
// so that nothing jumps where roughness changes. A light without a picture is what its coefficients reconstruct and has
// no sun. For near mirrors a second's work. Throws Cancelled.
HighlightLight make_highlight_light(std::span<const SurfaceReflectance> surfaces, const RenderLight& light, int bands,
                                    int threads = 0, const Progress& progress = {});

}  // namespace shlight
