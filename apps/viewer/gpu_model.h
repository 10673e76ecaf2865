#pragma once

#include <map>
#include <utility>

#include "model_asset.h"
#include "shlight/render/gpu_scene.h"

namespace shlight::viewer {

// A model on the graphics card, in the ways that renderers ask for it, shared by both sides.
class GpuModel {
 public:
  explicit GpuModel(Model model) : model_(std::move(model)) {}
  GpuScene& get(bool tangents, bool colors);
  const ModelAsset& asset() const { return *model_; }

 private:
  Model model_;
  std::map<std::pair<bool, bool>, GpuScene> scenes_;
};

}  // namespace shlight::viewer
