#include "gpu_model.h"

#include "shlight/render/surface_renderer.h"

namespace shlight::viewer {

GpuScene& GpuModel::get(bool tangents, bool colors) {
  const std::pair key = {tangents, colors};
  const auto found = scenes_.find(key);
  if (found != scenes_.end()) return found->second;
  const Scene& scene = model_->content.scene;
  return scenes_.emplace(key, GpuScene(colors ? scene : without_colors(scene), tangents)).first->second;
}

}  // namespace shlight::viewer
