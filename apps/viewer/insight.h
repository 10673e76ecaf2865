#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "settings.h"
#include "shlight/render/frame_renderer.h"
#include "shlight/truth/band_error.h"
#include "side.h"
#include "task.h"

namespace shlight::viewer {

// What helps to understand a light: how much is in each band, how far off few bands are, and how what they hold looks.
class Insight {
 public:
  // Once a frame where it is seen.
  bool update(const Subject& subject, const Look& look, const Camera& camera, int width, int height);

  // Error and energy by bands; nothing until they are known, or where there is no light.
  const std::optional<BandErrors>& errors() const { return errors_; }
  // The share of the light's energy in each degree.
  const std::vector<double>& energy() const { return energy_; }
  // Pictures of the light and of what the bands hold of it, rows from the top.
  const PictureTexture* original() const { return original_ ? &*original_ : nullptr; }
  const PictureTexture* reconstructed() const { return reconstructed_ ? &*reconstructed_ : nullptr; }
  // The balloon, rows from the bottom; 0 until it is there.
  unsigned balloon() const { return balloon_frame_ ? balloon_frame_->texture() : 0; }
  // The transfer of the vertex under the pointer, of green where it has colours; empty where there is none.
  struct AtPointer {
    std::size_t vertex = 0;
    std::vector<double> transfer;
    Rgb radiance;  // of white, in the light's unit
  };
  void point(const Subject& subject, const Side& side, const Settings& settings, double x, double y, double aspect);
  const std::optional<AtPointer>& at_pointer() const { return at_pointer_; }
  bool busy() const { return error_task_.busy() || map_task_.busy(); }

 private:
  struct Maps {
    Image8 original, reconstructed;
    Scene balloon;
  };
  void request(const Subject& subject, const Look& look);
  void draw_balloon(const Camera& camera, int width, int height);

  Task<std::shared_ptr<const std::optional<BandErrors>>> error_task_;
  Task<std::shared_ptr<const Maps>> map_task_;
  std::optional<BandErrors> errors_;
  std::vector<double> energy_;
  std::optional<PictureTexture> original_, reconstructed_;
  std::optional<GpuScene> balloon_;
  std::optional<SurfaceRenderer> balloon_renderer_;
  std::optional<Background> balloon_background_;
  std::optional<FrameRenderer> balloon_frame_;
  std::string balloon_key_;
  std::optional<AtPointer> at_pointer_;
};

}  // namespace shlight::viewer
