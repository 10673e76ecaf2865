#include "gpu_model.h"

#include "shlight/render/surface_renderer.h"
#include "shlight/scene/coarsen.h"

namespace shlight::viewer {

GpuScene& GpuModel::get(bool tangents, bool colors, bool coarse) {
  constexpr std::size_t kCoarse = 24'000;  // triangles
  if (model_->triangles < 2 * kCoarse) coarse = false;
  const std::tuple key = {tangents, colors, coarse};
  const auto found = scenes_.find(key);
  if (found != scenes_.end()) return found->second;
  const Scene& whole = model_->content.scene;
  if (!coarse) return scenes_.emplace(key, GpuScene(colors ? whole : without_colors(whole), tangents)).first->second;
  Scene scene = coarsen(whole, kCoarse);
  return scenes_.emplace(key, GpuScene(colors ? scene : without_colors(scene), tangents)).first->second;
}

}  // namespace shlight::viewer
