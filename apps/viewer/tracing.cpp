#include "tracing.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "shlight/truth/accumulate_paths.h"

namespace shlight::viewer {

void trace_ever_finer(const ModelAsset& model, const LightAsset& light, PathTraceParams params,
                      const Task<PathTraceResult>::Publish& publish, const Progress& progress) {
  const int width = params.width, height = params.height;
  params.samples = kReplicates;
  for (const int smaller : {8, 4}) {
    params.width = std::max(width / smaller, 1), params.height = std::max(height / smaller, 1);
    PathTraceResult quick =
        trace_paths(model.content.scene, *light.loaded->light, params, [&](double) { return progress(0); });
    quick.samples = 0;  // pixels are larger than those that are asked for
    publish(std::move(quick));
  }
  params.width = width, params.height = height;
  constexpr int kEnough = 4096, kLargestPass = 256;
  PathTraceResult sum;
  while (sum.samples < kEnough) {
    params.samples = std::clamp(sum.samples, kReplicates, kLargestPass);
    accumulate_paths(trace_paths(model.content.scene, *light.loaded->light, params,
                                 [&](double) { return progress(static_cast<double>(sum.samples) / kEnough); }),
                     sum);
    ++params.seed;
    publish(sum);
  }
}

double relative_noise(const PathTraceResult& result) {
  double variance = 0, square = 0;
  for (const float v : result.variance.values) variance += double{v};
  for (const float v : result.radiance.values) square += double{v} * double{v};
  return square > 0 ? std::sqrt(variance / square) : 0;
}

}  // namespace shlight::viewer
