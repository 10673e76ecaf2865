#pragma once

#include <optional>

#include "shlight/core/progress.h"
#include "shlight/scene/scene.h"
#include "shlight/truth/band_error.h"

namespace shlight {

struct ModelBandErrorParams {
  BandErrorParams errors = {};  // max_bands at most kMaxTransferBands; normals are the model's own
  bool shadowed = true;         // whether the model stands in its own light
  int samples = 1024;           // rays a vertex, of its transfer
};

// How far n bands of a light are from all of it on a model, white and Lambertian: at its vertices, in proportion to the
// area of the triangles about them, each with its own normal and, on request, what stands in the light's way.
//
// Shadowed truth is transfer (transfer.h) of kMaxTransferBands bands for what is left of the light without its points,
// and a ray to each of those. The transfer's own noise is in the truth as in the approximations and drops out.
//
// Throws Error where the scene does not keep what bake_transfer needs, Cancelled. Nothing for a light that gives no
// radiance anywhere, and for a scene without area.
std::optional<BandErrors> measure_model_band_errors(const Light& light, const Scene& scene,
                                                    const ModelBandErrorParams& params, const Progress& progress = {});

}  // namespace shlight
