#pragma once

#include <span>
#include <vector>

#include "shlight/core/progress.h"
#include "shlight/render/render_light.h"
#include "shlight/render/residual_light.h"
#include "shlight/render/surface_reflectance.h"

namespace shlight {

// What each surface's highlight averages of the light beyond what taken_by_highlights leaves of its first `bands`
// bands, as cube maps; without pictures for surfaces that have no highlight. A light without a picture is what its
// coefficients reconstruct. All threads; for near mirrors a second's work. Throws Cancelled.
std::vector<CubeFaces> make_highlight_cubes(std::span<const SurfaceReflectance> surfaces, const RenderLight& light,
                                            int bands, const Progress& progress = {});

}  // namespace shlight
