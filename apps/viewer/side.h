#pragma once

#include <atomic>
#include <future>
#include <memory>
#include <optional>
#include <string>

#include "gpu_model.h"
#include "model_asset.h"
#include "painter.h"
#include "settings.h"
#include "task.h"

namespace shlight::viewer {

// What both sides show.
struct Subject {
  Model model;
  Lighting light;
  std::shared_ptr<GpuModel> gpu;
};

// One side of the window: computes what its look needs beside the window, and has it drawn beside the window.
class Side {
 public:
  Side() = default;
  Side(const Side&) = delete;
  Side& operator=(const Side&) = delete;
  ~Side();

  // Pictures are drawn there. Called once, before all else; the thread has to outlive this.
  void draw_on(GlThread& thread);

  // Takes in what has been computed; true where there is something new to draw. Once a frame, seen or not: what is
  // hidden while it works must end, too.
  bool take_news();
  // The same where it is seen: starts work as well.
  bool update(const Subject& subject, const Settings& settings, const Look& look, int width, int height);
  // Asks for a picture of what there is, of the size of update(), or of that divided by `coarseness`, which takes less
  // time. One that was asked for before and is not there yet is given up.
  void begin_picture(const Subject& subject, const Settings& settings, const Look& look, int coarseness);
  // Waits at most so long for it.
  void wait_for_picture(double ms) const;
  // True where it has come since it was asked for.
  bool take_picture();
  // Whether a picture has been asked for and not been taken yet; how coarse that is.
  bool drawing() const { return awaited_.has_value(); }
  int drawing_coarseness() const { return awaited_ ? awaited_->coarseness : 0; }

  // The last one that was taken.
  bool has_picture() const { return picture_.target != nullptr; }  // needed by what follows
  const Picture& picture() const { return picture_; }
  Image8 read_picture() const;
  Image read_radiance() const;  // not while another picture is drawn

  // Whether what is drawn is what the look asks for, as good as it gets.
  bool settled(const Look& look) const;
  // "baking, 43 %"; empty where nothing goes on.
  std::string activity() const;
  double fraction() const;
  bool can_cancel() const { return bake_.busy() || table_.busy(); }
  void cancel();
  // What went wrong since the last call.
  std::optional<std::string> take_error();

  int traced_samples() const { return traced_ ? traced_->result.samples : 0; }
  const Transfer* transfer() const { return transfer_ ? transfer_->transfer.get() : nullptr; }

 private:
  void request_tables(const Subject& subject, const Look& look);
  void request_bake(const Subject& subject, const Look& look);
  void request_shadows(const Subject& subject, const Settings& settings, const Look& look);
  void request_trace(const Subject& subject, const Settings& settings, const Look& look);
  bool choose_renderer(const Subject& subject, const Look& look);

  Task<std::shared_ptr<const Tables>> table_;
  Task<std::shared_ptr<const BakedTransfer>> bake_;
  Task<std::shared_ptr<const Shadows>> shadow_;
  Task<std::shared_ptr<const Traced>> trace_;
  std::string cancelled_;  // the key of a bake that is not to go on
  std::optional<std::string> error_;

  std::shared_ptr<const Tables> tables_;
  std::shared_ptr<const BakedTransfer> transfer_;
  std::shared_ptr<const Shadows> shadows_;
  std::shared_ptr<const Traced> traced_;
  std::string traced_key_;
  RendererSpec renderer_;  // of the newest of these that the look asks for
  int width_ = 0, height_ = 0;

  GlThread* thread_ = nullptr;
  std::shared_ptr<Painter> painter_;
  struct Awaited {
    std::future<Picture> picture;
    std::shared_ptr<std::atomic<bool>> stop;
    int coarseness = 1;
  };
  std::optional<Awaited> awaited_;
  // Before a picture is drawn into again, the window has drawn a frame without it.
  Picture picture_, previous_;
};

}  // namespace shlight::viewer
