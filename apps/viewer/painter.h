#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gl_thread.h"
#include "gpu_model.h"
#include "model_asset.h"
#include "picture_targets.h"
#include "settings.h"
#include "shlight/core/progress.h"
#include "shlight/render/frame_in_parts.h"
#include "shlight/render/gpu_timer.h"
#include "shlight/render/highlight_light.h"
#include "shlight/truth/path_tracer.h"

// What a side of the window is drawn with, and drawing it.

namespace shlight::viewer {

// What the methods need beside model and light, computed beside the window.
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
struct Traced {
  PathTraceResult result;
  double noise = 0;  // relative
};

// The renderer that a picture is to be drawn with: of tables or transfer, where there are any, else of irradiance.
struct RendererSpec {
  std::string key;  // of all of it
  Model model;
  int bands = 0;
  Show show = Show::kLit;
  Shade shade = Shade::kPixel;
  std::shared_ptr<const Tables> tables;
  std::shared_ptr<const BakedTransfer> transfer;

  bool lit() const { return show == Show::kLit || show == Show::kDegree; }
};

// All that a picture is of. Does not change any more, whatever is set meanwhile.
struct PictureRequest {
  std::shared_ptr<GpuModel> gpu;
  Lighting light;
  RendererSpec renderer;
  std::shared_ptr<const Shadows> shadows;  // may be null
  std::shared_ptr<const Traced> traced;    // where that is shown, and nothing drawn
  std::string window;
  int degree = 0;
  bool mark_negative = false;
  bool background = true;
  FrameParams frame;
  int width = 0, height = 0;  // in the window; of the picture divided by `coarseness`
  int coarseness = 1;
};

struct Picture {
  std::shared_ptr<const PictureTarget> target;
  int coarseness = 1;
  double ms = 0;                         // that drawing it took
  std::optional<double> gpu_ms;          // of which the graphics card worked, where the driver tells
  std::shared_ptr<const Traced> traced;  // where it shows that
  RgbCoefficients light;                 // as it was drawn, in its own unit
  std::size_t bytes = 0;                 // of what the method needs beside the scene
};

// Draws one side. Made anywhere; all else on the GlThread.
class Painter {
 public:
  explicit Painter(GlThread& thread) : thread_(thread), targets_(thread) {}

  // Asks `progress` whether to go on every few milliseconds: throws Cancelled; and Error where the card cannot hold it.
  Picture paint(const PictureRequest& request, const Progress& progress);
  // Linear radiance of the last picture that was drawn, in the light's own unit. Throws Error where drawing that
  // failed.
  Image read_radiance() const;

 private:
  // What is drawn into.
  struct Canvas {
    FrameRenderer frame;
    FrameInParts parts;
    Canvas(int width, int height) : frame(width, height), parts(frame) {}
  };

  void build_renderer(const PictureRequest& request);
  void refresh_light(const PictureRequest& request);
  std::optional<double> draw(Canvas& canvas, GpuScene& scene, const Drawing& drawing, const FrameParams& frame,
                             const Progress& progress);
  Canvas& canvas_of(const PictureRequest& request);
  Picture paint_traced(const PictureRequest& request);

  GlThread& thread_;
  std::optional<GpuTimer> timer_;
  std::size_t paintings_ = 0;
  std::optional<SurfaceRenderer> renderer_;
  RendererSpec built_;  // what that is of
  std::string light_key_, background_key_;
  std::size_t bytes_ = 0;
  std::optional<Background> background_;
  RgbCoefficients light_;
  LightScale scale_;
  std::shared_ptr<const Shadows> shadows_;
  std::optional<GpuShadows> gpu_shadows_;  // of these
  int width_ = 0, height_ = 0;
  std::map<int, Canvas> canvases_;  // by coarseness
  const FrameRenderer* drawn_ = nullptr;
  std::shared_ptr<const Traced> traced_;
  std::optional<RadiancePicture> traced_picture_;
  PictureTargets targets_;
};

}  // namespace shlight::viewer
