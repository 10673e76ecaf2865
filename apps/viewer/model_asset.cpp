#include "model_asset.h"

#include <fmt/format.h>

#include <chrono>
#include <thread>

#include "shlight/light/project_image.h"
#include "shlight/light/window_name.h"
#include "shlight/scene/load_scene.h"

namespace shlight::viewer {

const ShadowRatio& ModelAsset::shadow_ratio() const {
  std::call_once(has_ratio_, [this] { ratio_.emplace(content.scene, content.transfer); });
  return *ratio_;
}

Model load_model(const std::string& name, int serial) {
  auto model = std::make_shared<ModelAsset>();
  model->name = name;
  model->key = fmt::format("{} {}", serial, name);
  model->is_baked = !is_builtin_scene(name) && is_baked_file(name);
  if (model->is_baked)
    model->content = load_baked(name);
  else
    model->content.scene = make_scene(name);
  const Scene& scene = model->content.scene;
  model->extent = scene_extent(scene);
  model->triangles = num_triangles(scene);
  model->vertices = num_vertices(scene);
  return model;
}

RgbCoefficients shaped_light(const LightAsset& light, const std::string& window, int bands) {
  const RgbCoefficients first = resize_bands(light.drawn.coefficients, bands);
  return window == "none" ? first : apply_named_window(window, first).coefficients;
}

void load_lighting(const std::string& name, int serial, const Task<Lighting>::Publish& publish,
                   const Progress& progress) {
  constexpr int kQuickWidth = 256, kFullWidth = 2048;
  const auto loaded = std::make_shared<const LoadedLight>(load_light(name));
  report_progress(progress, 0.1);
  const auto publish_light = [&](RenderLight drawn, bool final) {
    auto light = std::make_shared<LightAsset>();
    light->name = name;
    light->key = fmt::format("{} {} {}", serial, name, final);
    light->loaded = loaded;
    light->behind = make_half_picture(drawn.background, light_scale(drawn.coefficients).unit);
    light->drawn = std::move(drawn);
    light->final = final;
    publish(light);
    report_progress(progress, 0.3);
  };
  // Functions take a while to evaluate and to integrate: first what a small picture of them has.
  if (loaded->info.kind == LightInfo::Kind::kBuiltin || loaded->info.kind == LightInfo::Kind::kFormula) {
    const Image quick = loaded->light->lat_long(kQuickWidth, worker_threads());
    publish_light({project_image({quick, Layout::kLatLong}, kMaxRenderBands, worker_threads()), quick}, false);
    // That is drawn now: for a moment, all processors are for it.
    be_patient(Patience::kComputes);
    constexpr int kMoments = 30;
    for (int i = 0; i < kMoments; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      report_progress(progress, 0.3);
    }
  }
  publish_light(make_render_light(*loaded->light, kMaxRenderBands, kFullWidth, worker_threads()), true);
}

std::vector<std::string> remarks(const LightInfo& info) {
  std::vector<std::string> lines = info.warnings;
  if (!info.pixels.clean()) lines.push_back(describe(info.pixels, false));
  return lines;
}

}  // namespace shlight::viewer
