#include "viewer.h"

#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "command_line.h"
#include "frame_times.h"
#include "gl_thread.h"
#include "insight.h"
#include "navigation.h"
#include "panels.h"
#include "script.h"
#include "shlight/core/error.h"
#include "shlight/core/file.h"
#include "shlight/core/process.h"
#include "shlight/image/image_io.h"
#include "shlight/light/coefficient_file.h"
#include "shlight/render/context.h"
#include "studio.h"
#include "window.h"

namespace shlight::viewer {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kReportedFrames = 20'000;  // since the last report

double ms_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

class Viewer {
 public:
  Viewer(const ViewerParams& params, Script script, Window& window, GlThread& thread, std::unique_ptr<Studio> studio)
      : params_(params),
        script_(std::move(script)),
        window_(window),
        thread_(thread),
        owned_studio_(std::move(studio)) {
    studio_.draw_on(thread);
    insight_.draw_on(thread);
  }

  void run() {
    while (!window_.closed() && !(params_.asked_to_stop && params_.asked_to_stop())) {
      // The first model and light must be there: without them there is no window to show a message in.
      if (!studio_.ready() && !studio_.last_error().empty()) throw Error(studio_.last_error());
      const bool scripted = !script_.ended() || !params_.screenshot.empty();
      if (!scripted && !params_.script.empty()) return;  // the script has ended
      if (scripted && !run_script()) return;
      // A frame or two more than events ask for, so that what they open is drawn.
      constexpr int kAfterEvent = 3;
      // While a script only waits, processors are left to what it waits for.
      const bool waits = scripted && (script_.ended() || script_.line().words[0] == "wait");
      const bool busy = scripted || studio_.busy() || insight_.busy();
      const bool seen = window_.width() > 0 && window_.height() > 0;  // else it is minimised
      // A picture that comes ends the wait for it.
      const double wait = !seen                                ? 0.1
                          : !studio_.ready()                   ? 0.004
                          : awake_ > 0 || (scripted && !waits) ? 0
                          : busy                               ? 0.06
                                                               : 0.25;
      window_.poll(wait);
      for (const std::string& path : window_.take_dropped()) studio_.open(path);
      if (window_.take_events()) awake_ = kAfterEvent;
      if (seen) frame();
    }
  }

 private:
  void frame() {
    const int width = window_.width(), height = window_.height();
    const auto start = Clock::now();
    const Layout layout = make_layout(studio_.settings, width, height, window_.scale());
    const auto picture_width = static_cast<int>(std::max(layout.picture_width(), 1.0f));
    const auto before_update = Clock::now();
    bool changed = studio_.update(picture_width, height);
    changed = insight_.take_news() || changed;
    if (layout.right > 0 && studio_.ready()) {
      const auto balloon = static_cast<int>(layout.right - 28 * layout.scale);
      insight_.request(studio_.subject(), studio_.settings, balloon,
                       static_cast<int>(kBalloonAspect * static_cast<float>(balloon)));
    }
    set_title();
    const auto before_panels = Clock::now();
    window_.begin_frame();
    point_out(layout);
    keys();
    Wishes wishes;
    draw_panels(studio_, insight_, times_, layout, wishes);
    wishes_ = merged(wishes_, wishes);
    ImGui::EndFrame();
    const double own =
        std::chrono::duration<double, std::milli>(before_update - start).count() + ms_since(before_panels);
    thread_.begin_window_frame();
    window_.end_frame();
    screenshot_now();
    window_.show();
    thread_.end_window_frame();
    grant_wishes();
    if (studio_.has_picture() && !first_picture_ms_) first_picture_ms_ = process_age_ms();
    FrameTimes::Frame times = {ms_since(start), own, {}, {}};
    if (const auto& picture = studio_.picture_time()) times.picture_ms = picture->ms, times.gpu_ms = picture->gpu_ms;
    times_.add(times), reported_.add(times);
    awake_ = changed ? 2 : std::max(awake_ - 1, 0);
  }

  void set_title() {
    const Settings& s = studio_.settings;
    const auto name = [](const std::string& path) { return std::filesystem::path(path).filename().string(); };
    std::string title = name(s.model) + " under " + name(s.light) + " - shlight";
    if (title == title_) return;
    window_.set_title(title);
    title_ = std::move(title);
  }

  // Tells what the pointer is over. While it turns something, that stays what it was.
  void point_out(const Layout& layout) {
    if (layout.right <= 0 || !studio_.ready()) return;
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const double width = std::max(layout.picture_width(), 1.0f), height = layout.height;
    const double x = 2 * (mouse.x - layout.left) / width - 1, y = 1 - 2 * mouse.y / height;
    const ImVec2 moved = ImGui::GetIO().MouseDelta;
    if (moved.x == 0 && moved.y == 0 && insight_.has_vertex()) return;
    if (ImGui::IsMouseDown(0) || ImGui::IsMouseDown(1) || std::abs(x) > 1 || std::abs(y) > 1) return;
    insight_.point(studio_.subject(), studio_.side(studio_.settings.side), studio_.settings, x, y, width / height);
  }

  static Wishes merged(const Wishes& a, const Wishes& b) {
    return {a.copy_command || b.copy_command, a.save_png || b.save_png, a.save_exr || b.save_exr,
            a.export_coefficients || b.export_coefficients, a.reset || b.reset};
  }

  // --- keys

  void keys() {
    const ImGuiIO& io = ImGui::GetIO();
    if (io.WantTextInput || io.KeyCtrl || io.KeyAlt || io.KeySuper) return;
    for (const auto& [key, action] : key_actions())
      if (ImGui::IsKeyPressed(key, false) || pressed_ == key) action();
    pressed_ = 0;
  }

  const std::map<int, std::function<void()>>& key_actions() {
    if (!key_actions_.empty()) return key_actions_;
    Settings& s = studio_.settings;
    const auto toggle = [](bool& value) { return [&value] { value = !value; }; };
    key_actions_ = {
        {GLFW_KEY_M,
         [&s] { s.look().method = static_cast<Method>((static_cast<int>(s.look().method) + 1) % kNumMethods); }},
        {GLFW_KEY_A, [&s] { s.side = 0; }},
        {GLFW_KEY_B, [&s] { s.side = 1; }},
        {GLFW_KEY_S, [&s] { s.compare = s.compare == Compare::kSplit ? Compare::kOne : Compare::kSplit; }},
        {GLFW_KEY_D, [&s] { s.compare = s.compare == Compare::kDifference ? Compare::kOne : Compare::kDifference; }},
        {GLFW_KEY_N, [&s] { s.look().mark_negative = !s.look().mark_negative; }},
        {GLFW_KEY_I, toggle(s.insight)},
        {GLFW_KEY_T, toggle(s.timing)},
        {GLFW_KEY_TAB, toggle(s.controls)},
        {GLFW_KEY_H, toggle(s.keys)},
        {GLFW_KEY_P, [this] { wishes_.save_png = true; }},
        {GLFW_KEY_E, [this] { wishes_.save_exr = true; }},
        {GLFW_KEY_C, [this] { wishes_.copy_command = true; }},
        {GLFW_KEY_R, [this] { wishes_.reset = true; }},
    };
    for (int digit = 0; digit <= 9; ++digit)
      key_actions_[GLFW_KEY_0 + digit] = [&s, digit] { s.look().bands = digit == 0 ? kMaxRenderBands : digit; };
    return key_actions_;
  }

  // --- what a person asks for

  std::string command() const {
    const Settings& s = studio_.settings;
    return render_command(s, s.look(), studio_.width(), studio_.height(), studio_.side(s.side).traced_samples());
  }

  // The first of shlight-1.png, shlight-2.png, … that is not there.
  static std::filesystem::path free_name(const char* ending) {
    for (int i = 1;; ++i) {
      const std::filesystem::path path = fmt::format("shlight-{}{}", i, ending);
      std::error_code error;
      if (!std::filesystem::exists(path, error)) return path;
    }
  }

  void save_picture(const std::filesystem::path& path) {
    if (path.extension() == ".exr")
      save_image(path, studio_.radiance());
    else
      save_image8(path, studio_.picture());
    studio_.say(path.string() + " saved");
  }

  void grant_wishes() {
    const Wishes wishes = std::exchange(wishes_, {});
    if (!wishes.any()) return;
    awake_ = 2;
    if (wishes.reset) studio_.reset();
    if (!studio_.ready()) return;
    try {
      if (wishes.copy_command) {
        window_.copy_to_clipboard(command());
        studio_.say("copied: " + command());
      }
      if (wishes.save_png) save_picture(free_name(".png"));
      if (wishes.save_exr) save_picture(free_name(".exr"));
      if (wishes.export_coefficients) {
        const auto path = free_name(".json");
        save_coefficients(path, studio_.side(studio_.settings.side).picture().light);
        studio_.say(path.string() + " saved");
      }
    } catch (const Error& error) {
      studio_.say(error.what(), true);
    }
  }

  // --- scripts

  // The next line, or what is left of it; false where the window is to close.
  bool run_script() {
    if (!script_.ended()) {
      try {
        if (do_line(script_.line())) {
          script_.advance();
          progress_ = 0;
        }
      } catch (const Error& error) {
        throw Error(script_.where() + ": " + error.what());
      }
      return true;
    }
    // The script has ended: the last screenshot, once all is drawn.
    constexpr int kPaths = 16;
    if (taken_) return false;
    if (studio_.settled(kPaths) && !insight_.busy() && ++progress_ > 2) wanted_screenshot_ = params_.screenshot;
    return true;
  }

  // True where the line is done.
  bool do_line(const ScriptLine& line) {
    const std::string& what = line.words[0];
    if (!wanted_screenshot_.empty()) return false;
    if (what == "wait") {
      const int paths = line.words.size() > 1 ? static_cast<int>(to_number(line.words[1])) : 1;
      const bool quiet = studio_.settled(paths) && !insight_.busy();
      return quiet ? ++progress_ > 3 : (progress_ = 0, false);
    }
    if (what == "frames") return ++progress_ > static_cast<int>(to_number(line.words[1]));
    if (what == "spin") {
      orbit(studio_.settings, 0.01, 0);
      return ++progress_ >= static_cast<int>(to_number(line.words[1]));
    }
    if (what == "drag") return drag(line);
    if (what == "click") return click(line);
    if (what == "screenshot") {
      if (taken_) return !(taken_ = false);
      wanted_screenshot_ = line.rest;
      return false;
    }
    do_at_once(line);
    return true;
  }

  void do_at_once(const ScriptLine& line) {
    const std::string& what = line.words[0];
    Settings& s = studio_.settings;
    if (what == "set") {
      set_by_name(s, line.words[1], line.rest.substr(line.rest.find(line.words[2], line.words[1].size())));
    } else if (what == "open") {
      studio_.open(line.rest);
    } else if (what == "press") {
      pressed_ = to_key(line.words[1]);
    } else if (what == "wheel") {
      zoom(s, to_number(line.words[1]));
    } else if (what == "resize") {
      window_.resize(to_pixels(line.words[1]), to_pixels(line.words[2]));
    } else if (what == "cancel") {
      studio_.side(s.side).cancel();
    } else if (what == "reset") {
      studio_.reset();
    } else if (what == "picture") {
      save_picture(line.rest);
    } else if (what == "command") {
      write_file(line.rest, command() + "\n");
    } else if (what == "export") {
      save_coefficients(line.rest, studio_.side(s.side).picture().light);
    } else if (what == "report") {
      write_file(line.rest, report());
    }
  }

  // Presses, moves in steps, lets go.
  bool drag(const ScriptLine& line) {
    constexpr int kSteps = 6;
    static const std::map<std::string, int> kButtons = {{"left", 0}, {"right", 1}, {"middle", 2}};
    const auto button = kButtons.find(line.words[1]);
    if (button == kButtons.end()) throw Error("'" + line.words[1] + "'", "is no button", "left, middle, right");
    const double t = std::clamp((progress_ - 2.0) / kSteps, 0.0, 1.0);
    if (line.words.size() > 6 && progress_ == 2) window_.lose_focus();
    const auto at = [&](std::size_t i) {
      return static_cast<float>((1 - t) * to_number(line.words[i]) + t * to_number(line.words[i + 2]));
    };
    window_.point(at(2), at(3), progress_ == 0 || progress_ > kSteps + 2 ? -1 : button->second);
    return ++progress_ > kSteps + 3;
  }

  bool click(const ScriptLine& line) {
    window_.point(static_cast<float>(to_number(line.words[1])), static_cast<float>(to_number(line.words[2])),
                  progress_ == 1 ? 0 : -1);
    return ++progress_ > 3;
  }

  void screenshot_now() {
    if (wanted_screenshot_.empty()) return;
    save_image8(wanted_screenshot_, WindowTarget::read(window_.width(), window_.height()));
    wanted_screenshot_.clear();
    taken_ = true;
  }

  // What a test or a person may want to know, as JSON.
  std::string report() {
    const FrameTimes::Summary times = reported_.summary();
    const auto three = [&](auto part) -> nlohmann::ordered_json {
      return {{"median", part(times.median)}, {"p99", part(times.p99)}, {"max", part(times.max)}};
    };
    const Side& side = studio_.side(studio_.settings.side);
    nlohmann::ordered_json json = {
        {"first_picture_ms", first_picture_ms_.value_or(0)},
        {"frames", times_.count()},
        {"frames_since_report", reported_.kept().size()},
        {"frame_ms", three([](const FrameTimes::Frame& f) { return f.total_ms; })},
        {"own_ms", three([](const FrameTimes::Frame& f) { return f.own_ms; })},
        {"picture_ms",
         times.max.picture_ms ? three([](const FrameTimes::Frame& f) { return *f.picture_ms; }) : nullptr},
        {"gpu_ms", times.max.gpu_ms ? three([](const FrameTimes::Frame& f) { return *f.gpu_ms; }) : nullptr},
        {"resident_bytes", resident_memory()},
        {"width", studio_.width()},
        {"height", studio_.height()},
        {"scale", window_.scale()},
        {"model", studio_.settings.model},
        {"light", studio_.settings.light},
        {"method", to_text(studio_.settings.look().method)},
        {"activity", side.activity()},
        {"triangles", studio_.ready() ? studio_.subject().model->triangles : 0},
        {"method_bytes", side.picture().bytes},
        {"paths", side.traced_samples()},
        {"last_error", studio_.last_error()},
        {"gl_renderer", gl_renderer()}};
    reported_.clear();
    return json.dump(2) + "\n";
  }

  ViewerParams params_;
  Script script_;
  Window& window_;
  GlThread& thread_;
  std::unique_ptr<Studio> owned_studio_;
  Studio& studio_ = *owned_studio_;
  Insight insight_;
  FrameTimes times_ = FrameTimes(kShownFrames), reported_ = FrameTimes(kReportedFrames);
  Wishes wishes_;
  std::map<int, std::function<void()>> key_actions_;
  int pressed_ = 0;   // by a script
  int progress_ = 0;  // within its line, in frames
  std::string title_;
  std::filesystem::path wanted_screenshot_;
  bool taken_ = false;
  int awake_ = 3;  // frames to draw at once
  std::optional<double> first_picture_ms_;
};

}  // namespace

void run_viewer(const ViewerParams& params) {
  Script script = params.script.empty() ? Script() : Script(params.script);
  Window::require_display();
  // What is shown is loaded while the window opens.
  auto studio = std::make_unique<Studio>(params.settings, params.script.empty() && params.screenshot.empty());
  studio->load();
  Window window(params.width, params.height, params.scale);
  GlThread thread({[&window] { window.make_second_context_current(); }, Window::release_context, Window::wake});
  Viewer(params, std::move(script), window, thread, std::move(studio)).run();
}

}  // namespace shlight::viewer
