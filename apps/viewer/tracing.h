#pragma once

#include "model_asset.h"
#include "shlight/core/progress.h"
#include "shlight/truth/path_tracer.h"
#include "task.h"

namespace shlight::viewer {

// Traces the model with more and more paths, and publishes what there is again and again: at first with few pixels, to
// have something soon, whose `samples` are 0. Throws Cancelled.
void trace_ever_finer(const ModelAsset& model, const LightAsset& light, PathTraceParams params,
                      const Task<PathTraceResult>::Publish& publish, const Progress& progress);

// Root mean square of the pixels' deviations, relative to the picture's.
double relative_noise(const PathTraceResult& result);

}  // namespace shlight::viewer
