#include "studio.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "shlight/core/error.h"
#include "shlight/scene/load_scene.h"

namespace shlight::viewer {
namespace {

// What a picture depends on beside what is loaded and computed.
std::string drawing_key(const Settings& s, const Look& look) {
  std::string key = fmt::format("{} {} {} {} {} {} {} {} {} {} {}", s.camera.azimuth, s.camera.elevation, s.camera.zoom,
                                s.camera.target.x, s.camera.target.y, s.camera.target.z, s.exposure,
                                static_cast<int>(s.curve), s.background, look.window, look.mark_negative);
  key += fmt::format(" {} {} {} {}", static_cast<int>(look.method), static_cast<int>(look.transfer), look.degree,
                     static_cast<int>(look.show));
  for (const Vec3d& row : s.rotate_light.rows) key += fmt::format(" {} {} {}", row.x, row.y, row.z);
  return key;
}

}  // namespace

Studio::Studio(const Settings& start, bool remember) : settings(start), initial_(start), recent_(remember) {}

void Studio::draw_on(GlThread& thread) {
  thread_ = &thread;
  for (Side& side : sides_) side.draw_on(thread);
}

void Studio::load() {
  if (settings.model != model_wanted_) {
    model_wanted_ = settings.model;
    model_task_.request(
        fmt::format("{} {}", ++serial_, settings.model),
        [name = settings.model, serial = serial_](const auto& publish, const Progress&) {
          publish(load_model(name, serial));
        },
        true);
  }
  if (settings.light != light_wanted_) {
    light_wanted_ = settings.light;
    light_task_.request(
        fmt::format("{} {}", ++serial_, settings.light),
        [name = settings.light, serial = serial_](const auto& publish, const Progress& progress) {
          load_lighting(name, serial, publish, progress);
        },
        true);
  }
}

void Studio::open(const std::string& path) {
  if (is_model_file(path) || is_baked_file(path))
    settings.model = path, model_wanted_.clear();
  else
    settings.light = path, light_wanted_.clear();
}

void Studio::reset() {
  const std::string model = settings.model, light = settings.light;
  settings = initial_;
  settings.model = model, settings.light = light;
}

void Studio::take_model() {
  auto news = model_task_.poll();
  if (!news) return;
  if (!news->error.empty()) {
    say(news->error, true);
    if (subject_.model) settings.model = model_wanted_ = subject_.model->name;  // the old one stays
  } else if (news->result) {
    subject_.model = *news->result;
    subject_.gpu = thread_->own(std::make_unique<GpuModel>(subject_.model));
    stale_ = {true, true};
    recent_.add_model(subject_.model->name);
    for (const std::string& warning : subject_.model->content.scene.warnings) say(warning);
    if (subject_.model->is_baked) {
      const Transfer& transfer = subject_.model->content.transfer;
      settings.look().method = Method::kTransfer;
      settings.look().bands = std::min(transfer.bands, kMaxRenderBands);
      settings.look().transfer = transfer.kind;
    }
  }
}

void Studio::take_light() {
  auto news = light_task_.poll();
  if (!news) return;
  if (!news->error.empty()) {
    say(news->error, true);
    if (subject_.light) settings.light = light_wanted_ = subject_.light->name;
  } else if (news->result) {
    const bool is_new = !subject_.light || subject_.light->name != (*news->result)->name;
    subject_.light = *news->result;
    stale_ = {true, true};
    if (!is_new) return;
    recent_.add_light(subject_.light->name);
    for (const std::string& remark : remarks(subject_.light->loaded->info)) say(remark);
  }
}

// Once both sides stand still: comparing takes a while.
void Studio::request_difference() {
  if (coarseness_ > 1 || drawing()) return;
  for (const int which : {0, 1})
    if (!sides_[static_cast<std::size_t>(which)].settled(settings.looks[static_cast<std::size_t>(which)])) return;
  // A reference that converges is compared at each doubling of its paths.
  const auto doubling = [](int samples) {
    int k = 0;
    while (samples >>= 1) ++k;
    return k;
  };
  const std::string key =
      fmt::format("{} {} {}", drawn_key_, doubling(sides_[0].traced_samples()), doubling(sides_[1].traced_samples()));
  if (key == difference_.wanted()) return;
  Image a = sides_[0].read_radiance(), b = sides_[1].read_radiance();
  if (a.width == b.width && a.height == b.height) difference_.request(key, std::move(a), std::move(b));
}

void Studio::begin_picture(int which) {
  const auto i = static_cast<std::size_t>(which);
  stale_[i] = false;
  drawn_coarseness_[i] = coarseness_;
  sides_[i].begin_picture(subject_, settings, settings.looks[i], coarseness_);
}

bool Studio::take_picture(int which) {
  Side& side = sides_[static_cast<std::size_t>(which)];
  if (!side.take_picture()) return false;
  const Picture& picture = side.picture();
  cost_ms_[picture.coarseness] = picture.ms;
  if (!picture_time_) picture_time_.emplace();
  picture_time_->ms += picture.ms;
  if (picture.gpu_ms) picture_time_->gpu_ms = picture_time_->gpu_ms.value_or(0) + *picture.gpu_ms;
  return true;
}

bool Studio::drawing() const {
  if (!ready()) return false;
  for (const int which : {0, 1})
    if (settings.shows(which) && (side(which).drawing() || stale_[static_cast<std::size_t>(which)])) return true;
  return false;
}

// What a picture is expected to take: what it took, or at most as much more or less as it has more or fewer pixels.
double Studio::expected_ms(int coarseness) const {
  if (const auto known = cost_ms_.find(coarseness); known != cost_ms_.end()) return known->second;
  if (cost_ms_.empty()) return 1e9;  // the first one may take long
  const auto& [nearest, ms] = *std::ranges::min_element(cost_ms_, {}, [&](const auto& cost) {
    return std::max(cost.first, coarseness) / std::min(cost.first, coarseness);
  });
  const double ratio = static_cast<double>(nearest) / coarseness;
  return ratio * ratio * ms;
}

int Studio::choose_coarseness(bool moving) const {
  constexpr double kQuick = 40;  // ms
  constexpr int kCoarsest = 4;
  int coarseness = 1;
  while (moving && coarseness < kCoarsest && expected_ms(coarseness) > kQuick) coarseness *= 2;
  return coarseness;
}

// For who needs the picture now.
void Studio::draw_finely() {
  if (coarseness_ == 1 && !drawing()) return;
  constexpr double kHour = 3.6e6;  // ms
  coarseness_ = 1;
  for (const int which : {0, 1})
    if (settings.shows(which)) begin_picture(which);
  for (const int which : {0, 1}) {
    side(which).wait_for_picture(kHour);
    take_picture(which);
  }
}

bool Studio::update(int width, int height) {
  load();
  take_model();
  take_light();
  picture_time_.reset();
  const auto now = std::chrono::steady_clock::now();
  bool changed = std::erase_if(messages_, [now](const Message& message) { return message.until < now; }) > 0;
  if (!ready() || width < 1 || height < 1) return changed;
  const bool resized = width != width_ || height != height_;
  width_ = width, height_ = height;

  std::string key = fmt::format("{} {} {} {}", subject_.model->key, subject_.light->key, width, height);
  if (resized) cost_ms_.clear();
  std::array<bool, 2> moved = {};
  for (const int which : {0, 1}) {
    const auto i = static_cast<std::size_t>(which);
    if (!settings.shows(which)) {  // what it has begun goes on, for when it is seen again
      if (sides_[i].take_news()) stale_[i] = true;
      continue;
    }
    if (sides_[i].update(subject_, settings, settings.looks[i], width, height)) stale_[i] = true;
    if (const auto error = sides_[i].take_error()) say(*error, true);
    const std::string side_key = drawing_key(settings, settings.looks[i]) + " " + subject_.light->key;
    moved[i] = side_key != side_keys_[i];
    side_keys_[i] = side_key;
    key += "[" + side_key + "]";
  }
  constexpr double kStill = 0.2;  // seconds
  if (moved[0] || moved[1]) moved_at_ = now;
  const bool moving = std::chrono::duration<double>(now - moved_at_).count() < kStill;
  coarseness_ = choose_coarseness(moving);
  // A picture that was begun is completed even if it is not of the newest moment, or there would be none while
  // something moves; but not a fine one where a coarse one does.
  for (const int which : {0, 1}) {
    const auto i = static_cast<std::size_t>(which);
    if (!settings.shows(which)) continue;
    changed = take_picture(which) || changed;
    if (moved[i] || resized || drawn_coarseness_[i] != coarseness_) stale_[i] = true;
    if (stale_[i] && (!sides_[i].drawing() || sides_[i].drawing_coarseness() < coarseness_)) begin_picture(which);
  }
  // What is drawn soon is of this frame. While something moves, a moment for the picture comes first: frames without a
  // new one take processors from it.
  constexpr double kSoon = 8;  // ms
  if (moving || expected_ms(coarseness_) < kSoon) {
    for (const int which : {0, 1}) {
      if (!settings.shows(which)) continue;
      side(which).wait_for_picture(kSoon);
      changed = take_picture(which) || changed;
    }
  }
  drawn_key_ = key;
  if (settings.compare == Compare::kDifference)
    request_difference();
  else
    difference_.cancel();
  return difference_.update() || changed;
}

bool Studio::has_picture() const {
  for (const int which : {0, 1})
    if (settings.shows(which) && !side(which).has_picture()) return false;
  return true;
}

bool Studio::settled(int samples) const {
  if (!ready() || model_task_.busy() || light_task_.busy() || difference_.busy() || coarseness_ > 1 || drawing())
    return false;
  for (const int which : {0, 1}) {
    if (!settings.shows(which)) continue;
    const Look& look = settings.looks[static_cast<std::size_t>(which)];
    if (!side(which).settled(look)) return false;
    if (look.method == Method::kReference && side(which).traced_samples() < samples) return false;
  }
  return settings.compare != Compare::kDifference || difference_fits();
}

bool Studio::busy() const {
  return coarseness_ > 1 || drawing() || model_task_.busy() || light_task_.busy() || difference_.busy() ||
         !side(0).activity().empty() || !side(1).activity().empty();
}

Image8 Studio::picture() {
  draw_finely();
  if (!has_picture()) throw Error("picture", "is not there yet", "a moment later");
  if (settings.compare == Compare::kDifference && difference_fits()) return difference_.result()->map;
  Image8 picture = side(settings.side).read_picture();
  if (settings.compare != Compare::kSplit) return picture;
  picture = side(0).read_picture();
  const Image8 right = side(1).read_picture();
  const auto first = static_cast<std::size_t>(std::clamp(settings.divider, 0.0, 1.0) * picture.width);
  const auto row = 4 * static_cast<std::size_t>(picture.width);
  for (std::size_t y = 0; y < static_cast<std::size_t>(picture.height); ++y)
    std::copy(right.values.begin() + static_cast<std::ptrdiff_t>(y * row + 4 * first),
              right.values.begin() + static_cast<std::ptrdiff_t>((y + 1) * row),
              picture.values.begin() + static_cast<std::ptrdiff_t>(y * row + 4 * first));
  return picture;
}

Image Studio::radiance() {
  draw_finely();
  if (!side(settings.side).has_picture()) throw Error("picture", "is not there yet", "a moment later");
  return side(settings.side).read_radiance();
}

void Studio::say(const std::string& text, bool is_error) {
  using namespace std::chrono_literals;
  if (is_error) last_error_ = text;
  messages_.push_front({text, is_error, std::chrono::steady_clock::now() + (is_error ? 12s : 6s)});
  constexpr std::size_t kMost = 4;
  if (messages_.size() > kMost) messages_.resize(kMost);
}

}  // namespace shlight::viewer
