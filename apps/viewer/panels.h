#pragma once

#include <imgui.h>

#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "frame_times.h"
#include "insight.h"
#include "studio.h"
#include "window.h"

namespace shlight::viewer {

// What the panels ask to be done after the frame.
struct Wishes {
  bool copy_command = false, save_png = false, save_exr = false, export_coefficients = false, reset = false;

  bool any() const { return copy_command || save_png || save_exr || export_coefficients || reset; }
};

// Where things are, in pixels.
struct Layout {
  float left = 0, right = 0;    // widths of the panels; 0 where they are not shown
  float width = 0, height = 0;  // of all
  float scale = 1;
  float picture_width() const { return width - left - right; }
};
Layout make_layout(const Settings& settings, int width, int height, double scale);

// The pieces of the window, each in its own file.
void scene_panel(Studio& studio);
void light_panel(Studio& studio);
void look_panel(Studio& studio);
void picture_panel(Studio& studio);
void wish_buttons(Studio& studio, Wishes& wishes);  // what can be taken along
float wish_buttons_height();
inline constexpr float kBalloonAspect = 0.52f;  // height over width of its picture
void insight_panel(const Studio& studio, const Insight& insight, const std::optional<Insight::AtPointer>& at_pointer,
                   const Layout& layout);
void timing_panel(const Studio& studio, const FrameTimes& times, const Layout& layout);
void viewport(Studio& studio, const std::optional<Insight::AtPointer>& at_pointer, const Layout& layout);

// All of them, with the window's own: keys, messages, frame times.
void draw_panels(Studio& studio, const Insight& insight, const FrameTimes& times, const Layout& layout, Wishes& wishes);

// --- what panels are made of

ImTextureID id_of(unsigned texture);
// A small window on top of the picture, with its corner or middle, as `pivot` says, at a place; ImGui::End() ends it.
void begin_overlay(const char* name, ImVec2 at, ImVec2 pivot, ImGuiWindowFlags more = 0);
// A heading that folds what is below it; false where that is folded away.
bool section(const char* title, bool open = true);
// A name at the left, and room for a control at the right.
void named(const char* name);
void hint(const char* text);  // shown where the pointer rests on the last control
bool slider(const char* name, double& value, double low, double high, const char* format, bool logarithmic = false);
bool slider(const char* name, int& value, int low, int high, const char* format = "%d");
// A choice among words; true where another was chosen.
bool choice(const char* name, std::string& value, const std::vector<std::string>& words);
// A choice among what is built in, what was opened lately and what lies beside the present file.
void choice_of_file(const char* name, std::string& path, std::initializer_list<const char*> builtin,
                    const std::vector<std::string>& recent,
                    std::vector<std::string> (*files_beside)(const std::string& path));
// Sliders for the parameters of "name:key=value,…"; true where one was moved.
struct Knob {
  std::string key;
  double low = 0, high = 1, value = 0;
  bool is_color = false;
  std::vector<std::string> words;
};
bool knobs(std::string& text, const std::vector<Knob>& knobs);

}  // namespace shlight::viewer
