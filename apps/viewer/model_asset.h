#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "shlight/core/progress.h"
#include "shlight/light/light.h"
#include "shlight/render/background.h"
#include "shlight/render/render_light.h"
#include "shlight/scene/camera.h"
#include "shlight/transfer/baked_file.h"
#include "shlight/transfer/shadow_ratio.h"
#include "task.h"

// Models and lights as they are loaded beside the window.

namespace shlight::viewer {

class ModelAsset {
 public:
  std::string name;
  std::string key;  // of this loading of it
  Baked content;    // its scene, and transfer where the file was baked
  bool is_baked = false;
  Extent extent;
  std::size_t triangles = 0, vertices = 0;

  // What the file's transfer makes of the light of methods that have none, where it was baked; made when it is first
  // asked for, on any thread.
  const ShadowRatio& shadow_ratio() const;

 private:
  mutable std::once_flag has_ratio_;
  mutable std::optional<ShadowRatio> ratio_;
};
using Model = std::shared_ptr<const ModelAsset>;
Model load_model(const std::string& name, int serial);

struct LightAsset {
  std::string name;
  std::shared_ptr<const LoadedLight> loaded;
  RenderLight drawn;   // with kMaxRenderBands
  HalfPicture behind;  // drawn.background in the unit of light_scale(drawn.coefficients); without pixels like that
  std::string key;     // of this light at this fineness
  bool final = false;  // as fine as `render` draws it
};
using Lighting = std::shared_ptr<const LightAsset>;

// Its first bands through the window of that name, which some windows take a while for.
RgbCoefficients shaped_light(const LightAsset& light, const std::string& window, int bands);

// Publishes it with a small background first, then as `render` draws it.
void load_lighting(const std::string& name, int serial, const Task<Lighting>::Publish& publish,
                   const Progress& progress);

// What there is to say about a light, a line each.
std::vector<std::string> remarks(const LightInfo& info);

}  // namespace shlight::viewer
