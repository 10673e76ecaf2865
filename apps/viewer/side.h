#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gpu_model.h"
#include "model_asset.h"
#include "settings.h"
#include "shlight/render/frame_in_parts.h"
#include "shlight/render/highlight_light.h"
#include "shlight/truth/path_tracer.h"
#include "task.h"

namespace shlight::viewer {

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
  // Begins a picture of what there is, of that size, or of that size divided by `coarseness`, which takes less time.
  void begin_picture(const Subject& subject, const Settings& settings, const Look& look, int coarseness);
  // Draws on for about so long; true where a new picture has been completed.
  bool draw(double ms);
  // Whether a picture has been begun and is not there yet; how coarse it is.
  bool drawing() const { return begun_.has_value(); }
  // What was baked is on its way to the card, a part in each frame.
  bool uploading() const { return upcoming_.has_value(); }
  int drawing_coarseness() const { return begun_ ? begun_->coarseness : 0; }
  // How long the last picture took, in ms, and how coarse it is.
  struct Cost {
    int coarseness = 1;
    double ms = 0;
  };
  const Cost& cost() const { return cost_; }

  // Of the picture drawn last: RGBA8, rows from the bottom; 0 where there is none.
  unsigned texture() const;
  bool has_picture() const;  // needed by these
  Image8 read_picture() const;
  const Image& read_radiance() const;

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
  double traced_noise() const { return noise_; }      // relative
  std::size_t bytes() const { return built_.bytes; }  // of what the method needs beside the scene
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

  struct Shadows {
    std::string model;
    std::vector<Vec3f> of_vertices;
  };
  // What a renderer was made for.
  struct Built {
    std::string key, model;
    int bands = 0;
    Show show = Show::kLit;
    std::size_t bytes = 0;
  };

  void request_tables(const Subject& subject, const Look& look);
  void request_bake(const Subject& subject, const Look& look);
  void request_shadows(const Subject& subject, const Settings& settings, const Look& look);
  void request_trace(const Subject& subject, const Settings& settings, const Look& look);
  bool take_news();
  bool build_renderer(const Subject& subject, const Look& look);
  bool upload(double ms);
  void install(SurfaceRenderer renderer, const Built& built);
  const RgbCoefficients& shaped_light(const Subject& subject, const Look& look, int bands);
  void refresh_light(const Subject& subject, const Look& look);
  void show_trace(const Subject& subject, const Settings& settings);

  Task<std::shared_ptr<const Tables>> table_;
  Task<std::shared_ptr<const BakedTransfer>> bake_;
  Task<std::shared_ptr<const Shadows>> shadow_;
  Task<PathTraceResult> trace_;
  std::string cancelled_;  // the key of a bake that is not to go on
  std::optional<std::string> error_;

  std::shared_ptr<const Tables> tables_;
  std::shared_ptr<const BakedTransfer> transfer_;
  Built built_;
  // What the newest Shadows are on the card.
  std::shared_ptr<const GpuShadows> shadows_;
  std::string shadows_model_;
  std::string light_key_, background_key_;
  std::optional<SurfaceRenderer> renderer_;
  // A renderer whose transfer is still on its way to the card; renderer_ draws until it is there.
  struct Upcoming {
    TransferRenderer renderer;
    std::shared_ptr<const Transfer> transfer;
    Built built;
  };
  std::optional<Upcoming> upcoming_;
  std::string shaped_key_;
  RgbCoefficients shaped_;  // light as it is windowed
  std::optional<Background> background_;
  // What is drawn into.
  struct Canvas {
    FrameRenderer frame;
    FrameInParts parts;
    Canvas(int width, int height) : frame(width, height), parts(frame) {}
  };
  std::map<int, Canvas> canvases_;         // by coarseness
  std::map<int, Canvas> shown_canvases_;   // of another size, that frame_ may be among
  FrameRenderer* frame_ = nullptr;         // that was completed last
  mutable std::optional<Image> radiance_;  // of that, where it was asked for
  // A picture on its way: all that it was begun with.
  struct Begun {
    std::shared_ptr<GpuModel> gpu;
    GpuScene* scene;
    const Background* background;
    std::shared_ptr<const GpuShadows> shadows;
    FrameParams params;
    Canvas* canvas;
    int coarseness;
  };
  std::optional<Begun> begun_;
  Cost cost_;
  RgbCoefficients light_;
  LightScale scale_;

  PathTraceResult traced_;
  std::string traced_key_;
  double noise_ = 0;
  std::optional<RadiancePicture> traced_picture_;
  bool showing_trace_ = false;
  int width_ = 0, height_ = 0;
};

}  // namespace shlight::viewer
