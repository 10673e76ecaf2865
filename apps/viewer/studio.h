#pragma once

#include <array>
#include <chrono>
#include <deque>
#include <map>
#include <optional>
#include <string>

#include "difference.h"
#include "model_asset.h"
#include "recent.h"
#include "settings.h"
#include "side.h"

namespace shlight::viewer {

// All of the viewer but its window and controls: what is set, what is loaded, what is drawn.
class Studio {
 public:
  Studio(const Settings& settings, bool remember);

  Settings settings;

  // Begins to load what update() is going to ask for.
  void load();
  // Pictures are drawn there. Called once, before update(); the thread has to outlive this.
  void draw_on(GlThread& thread);
  // Opens a file as what it seems to be: a model, a baked file or a light.
  void open(const std::string& path);
  // Everything but model and light as it was in the beginning.
  void reset();

  // Once a frame: takes in what has been computed and drawn, and asks for what the settings need, also for pictures, of
  // this size. True where there is something new to see.
  bool update(int width, int height);

  bool ready() const { return subject_.model && subject_.light; }
  // There is something to see of all that is shown.
  bool has_picture() const;
  // Nothing is being loaded or computed that the settings ask for; a reference counts as done with this many paths.
  bool settled(int samples) const;
  bool busy() const;
  // A picture is on its way.
  bool drawing() const;

  const Subject& subject() const { return subject_; }
  Side& side(int which) { return sides_[static_cast<std::size_t>(which)]; }
  const Side& side(int which) const { return sides_[static_cast<std::size_t>(which)]; }
  const Difference& difference() const { return difference_; }
  // Whether that is of what is drawn now.
  bool difference_fits() const { return difference_.result() && difference_.result_key().starts_with(drawn_key_); }
  Recent& recent() { return recent_; }
  int width() const { return width_; }
  int height() const { return height_; }
  bool loading_model() const { return model_task_.busy(); }
  bool loading_light() const { return light_task_.busy(); }

  // How long the pictures took that came with the last update(), together; nothing where there were none.
  struct PictureTime {
    double ms = 0;
    std::optional<double> gpu_ms;  // of which the graphics card worked, where the driver tells
  };
  const std::optional<PictureTime>& picture_time() const { return picture_time_; }

  // The picture as shown, of one side or both; and as linear radiance. Throw Error before anything is drawn.
  Image8 picture();
  Image radiance();

  // What to tell, the newest first, each for a few seconds.
  struct Message {
    std::string text;
    bool is_error = false;
    std::chrono::steady_clock::time_point until;
  };
  void say(const std::string& text, bool is_error = false);
  const std::deque<Message>& messages() const { return messages_; }
  // The last error, for scripts; empty where there was none.
  const std::string& last_error() const { return last_error_; }

 private:
  void take_model();
  void take_light();
  void request_difference();
  void begin_picture(int which);
  bool take_picture(int which);
  double expected_ms(int coarseness) const;
  int choose_coarseness(bool moving) const;
  void draw_finely();

  Settings initial_;
  Recent recent_;
  Task<Model> model_task_ = Task<Model>(false);
  Task<Lighting> light_task_ = Task<Lighting>(false);
  GlThread* thread_ = nullptr;
  int serial_ = 0;
  std::string model_wanted_, light_wanted_;
  Subject subject_;
  std::array<Side, 2> sides_;
  Difference difference_;
  std::string drawn_key_;
  std::array<std::string, 2> side_keys_;  // what each side was last drawn for
  std::array<bool, 2> stale_ = {true, true};
  // While something moves, pictures that take long are drawn coarsely.
  int coarseness_ = 1;
  std::array<int, 2> drawn_coarseness_ = {1, 1};
  std::map<int, double> cost_ms_;  // of a picture, by coarseness
  std::optional<PictureTime> picture_time_;
  std::chrono::steady_clock::time_point moved_at_;
  int width_ = 0, height_ = 0;
  std::deque<Message> messages_;
  std::string last_error_;
};

}  // namespace shlight::viewer
