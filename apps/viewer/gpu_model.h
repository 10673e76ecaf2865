#pragma once

#include <map>
#include <tuple>

#include "model_asset.h"
#include "shlight/render/gpu_scene.h"

namespace shlight::viewer {

// A model on the graphics card, in the ways that renderers ask for it, shared by both sides.
class GpuModel {
 public:
  explicit GpuModel(Model model) : model_(std::move(model)) {}
  // `coarse`: with no more triangles than a picture of few pixels shows.
  GpuScene& get(bool tangents, bool colors, bool coarse);
  const ModelAsset& asset() const { return *model_; }

 private:
  Model model_;
  std::map<std::tuple<bool, bool, bool>, GpuScene> scenes_;
};

}  // namespace shlight::viewer
