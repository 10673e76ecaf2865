#pragma once

#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "balloon_painter.h"
#include "settings.h"
#include "shlight/render/targets.h"
#include "shlight/scene/pick.h"
#include "shlight/truth/band_error.h"
#include "side.h"
#include "task.h"

namespace shlight::viewer {

// What helps to understand a light: how much is in each band, how far off few bands are, and how what they hold looks.
class Insight {
 public:
  // The balloon is drawn there. Called once, before all else; the thread has to outlive this.
  void draw_on(GlThread& thread);
  // Takes in what has been computed; true where there is something new. Once a frame, seen or not: what is hidden while
  // it works must end, too.
  bool take_news();
  // Once a frame where it is seen.
  void request(const Subject& subject, const Settings& settings, int balloon_width, int balloon_height);

  // Error and energy by bands; nothing until they are known, or where there is no light.
  const std::optional<BandErrors>& errors() const { return errors_; }
  // The share of the light's energy in each degree.
  const std::vector<double>& energy() const { return energy_; }
  // Pictures of the light and of what the bands hold of it, rows from the top.
  const PictureTexture* original() const { return original_ ? &*original_ : nullptr; }
  const PictureTexture* reconstructed() const { return reconstructed_ ? &*reconstructed_ : nullptr; }
  // The balloon, rows from the bottom; 0 until it is there.
  unsigned balloon() const { return balloon_picture_ ? balloon_picture_->texture() : 0; }
  // Chooses the vertex at this place of the picture, or none where there is none or no transfer.
  void point(const Subject& subject, const Side& side, const Settings& settings, double x, double y, double aspect);
  bool has_vertex() const { return picked_.has_value(); }
  // What is baked at the vertex that was chosen, of green where it has colours, and what it makes of the light as it
  // falls now. Nothing where there is none, or it is another model's.
  struct AtPointer {
    PickedVertex picked;
    std::vector<double> transfer;
    Rgb radiance;  // of white, in the light's unit
  };
  std::optional<AtPointer> at_pointer(const Subject& subject, const Side& side, const Settings& settings) const;
  bool busy() const;

 private:
  struct Maps {
    Image8 original, reconstructed;
    std::shared_ptr<const Scene> balloon;
  };
  void request_errors(const Subject& subject, const Look& look);
  void request_maps(const Subject& subject, const Look& look);
  void request_balloon(const Settings& settings, int width, int height);
  bool take_balloon();

  Task<std::shared_ptr<const std::optional<BandErrors>>> error_task_;
  Task<std::shared_ptr<const Maps>> map_task_;
  std::optional<BandErrors> errors_;
  std::vector<double> energy_;
  std::optional<PictureTexture> original_, reconstructed_;
  GlThread* thread_ = nullptr;
  std::shared_ptr<BalloonPainter> balloon_painter_;
  std::shared_ptr<const Scene> balloon_;
  std::string balloon_key_;  // of the picture that was asked for last
  std::future<std::shared_ptr<const PictureTarget>> awaited_balloon_;
  // Before a picture is drawn into again, the window has drawn a frame without it.
  std::shared_ptr<const PictureTarget> balloon_picture_, previous_balloon_;
  std::optional<PickedVertex> picked_;
  std::string picked_model_;
};

}  // namespace shlight::viewer
