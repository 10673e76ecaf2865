#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "model_asset.h"
#include "settings.h"
#include "shlight/render/frame_renderer.h"
#include "shlight/render/highlight_light.h"
#include "shlight/truth/path_tracer.h"
#include "task.h"

namespace shlight::viewer {

// A model on the graphics card, in the ways that renderers ask for it, shared by both sides.
class GpuModel {
 public:
  explicit GpuModel(Model model) : model_(std::move(model)) {}
  const GpuScene& get(bool tangents, bool colors);
  const ModelAsset& asset() const { return *model_; }

 private:
  Model model_;
  std::map<std::pair<bool, bool>, GpuScene> scenes_;
};

// What both sides show.
struct Subject {
  Model model;
  Lighting light;
  std::shared_ptr<GpuModel> gpu;
};

// One side of the window: computes what its look needs beside the window, and draws it.
class Side {
 public:
  // Starts and takes in work; true where there is something new to draw.
  bool update(const Subject& subject, const Settings& settings, const Look& look, int width, int height);
  // Draws what there is, into a picture of that size, or of that size divided by `coarseness`, which takes less time.
  // Returns how long it took, in ms; 0 where that is not known.
  double draw(const Subject& subject, const Settings& settings, const Look& look, int coarseness);

  // Of the picture drawn last: RGBA8, rows from the bottom; 0 where there is none.
  unsigned texture() const;
  bool has_picture() const;  // needed by these
  Image8 read_picture() const;
  Image read_radiance() const;

  // Whether what is drawn is what the look asks for, as good as it gets.
  bool settled(const Look& look) const;
  // "baking, 43 %"; empty where nothing goes on.
  std::string activity() const;
  double fraction() const;
  bool can_cancel() const { return bake_.busy() || table_.busy(); }
  void cancel();
  // What went wrong since the last call.
  std::optional<std::string> take_error();

  int traced_samples() const { return traced_.samples; }
  double traced_noise() const { return noise_; }  // relative
  std::size_t bytes() const { return bytes_; }    // of what the method needs beside the scene
  const Transfer* transfer() const { return transfer_ ? transfer_->transfer.get() : nullptr; }
  const RgbCoefficients& light() const { return light_; }  // as it was last drawn, in its own unit

 private:
  struct Tables {
    std::string key;
    std::vector<SurfaceReflectance> surfaces;
    std::optional<HighlightLight> highlights;
  };
  struct BakedTransfer {
    std::string key;
    std::shared_ptr<const Transfer> transfer;
    bool final = false;
  };

  void request_tables(const Subject& subject, const Look& look);
  void request_bake(const Subject& subject, const Look& look);
  void request_trace(const Subject& subject, const Settings& settings, const Look& look);
  bool take_news();
  bool build_renderer(const Subject& subject, const Look& look);
  RgbCoefficients shaped_light(const Subject& subject, const Look& look, int bands) const;
  void refresh_light(const Subject& subject, const Look& look);

  Task<std::shared_ptr<const Tables>> table_;
  Task<std::shared_ptr<const BakedTransfer>> bake_;
  Task<PathTraceResult> trace_;
  std::string cancelled_;  // the key of a bake that is not to go on
  std::optional<std::string> error_;

  std::shared_ptr<const Tables> tables_;
  std::shared_ptr<const BakedTransfer> transfer_;
  std::string built_key_, built_model_, light_key_, background_key_;
  int built_bands_ = 0;
  Show built_show_ = Show::kLit;
  std::optional<SurfaceRenderer> renderer_;
  std::optional<Background> background_;
  std::map<int, FrameRenderer> frames_;  // by coarseness
  FrameRenderer* frame_ = nullptr;       // that was drawn last
  RgbCoefficients light_;
  LightScale scale_;
  std::size_t bytes_ = 0;

  PathTraceResult traced_;
  std::string traced_key_;
  double noise_ = 0;
  std::optional<RadiancePicture> traced_picture_;
  bool showing_trace_ = false;
  int width_ = 0, height_ = 0;
};

}  // namespace shlight::viewer
