#include "panels.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui/imgui_internal.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <vector>

#include "parameters.h"
#include "theme.h"

namespace shlight::viewer {
namespace {

constexpr float kControlsWidth = 300, kInsightWidth = 336;  // at scale 1
constexpr ImGuiWindowFlags kPanel = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                    ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus;
void keys_overlay(const Layout& layout) {
  static constexpr std::array<std::array<const char*, 2>, 16> kKeys = {{
      {"left drag", "turn the camera"},
      {"middle or Shift+left drag", "move the camera"},
      {"right drag", "turn the light"},
      {"wheel", "nearer, farther"},
      {"1 … 9, 0", "bands, 0 is ten"},
      {"M", "next method"},
      {"A, B", "controls of side A or B"},
      {"S", "split the picture"},
      {"D", "difference of A and B"},
      {"N", "stripes where light is negative"},
      {"I, T", "insight, times of frames"},
      {"Tab", "controls"},
      {"P, E", "save the picture, its radiance"},
      {"C", "copy as command"},
      {"R", "reset"},
      {"H", "this list"},
  }};
  begin_overlay("keys", {layout.left + 0.5f * layout.picture_width(), 0.5f * layout.height}, {0.5f, 0.5f});
  ImGui::PushFont(heading_font());
  ImGui::TextUnformatted("Keys and pointer");
  ImGui::PopFont();
  ImGui::Dummy({0, 2});
  if (ImGui::BeginTable("keys", 2, ImGuiTableFlags_SizingFixedFit)) {
    for (const auto& [key, what] : kKeys) {
      ImGui::TableNextColumn();
      ImGui::TextColored(kAccent, "%s", key);
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(what);
    }
    ImGui::EndTable();
  }
  ImGui::TextDisabled("Drop a model or a light on the window to open it.");
  ImGui::End();
}

void messages_overlay(const Studio& studio, const Layout& layout) {
  if (studio.messages().empty()) return;
  const float width = std::max(std::min(layout.picture_width() - 40 * layout.scale, 620 * layout.scale), 80.0f);
  const ImVec2 at = {layout.left + 0.5f * layout.picture_width(), layout.height - 18 * layout.scale};
  ImGui::SetNextWindowSizeConstraints({width, 0}, {width, layout.height});
  begin_overlay("messages", at, {0.5f, 1}, ImGuiWindowFlags_NoInputs);
  ImGui::PushTextWrapPos(0);
  for (const Studio::Message& message : studio.messages())
    ImGui::TextColored(message.is_error ? kWarning : kInk, "%s", message.text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::End();
}

void controls(Studio& studio, const Layout& layout, Wishes& wishes) {
  ImGui::SetNextWindowPos({0, 0});
  ImGui::SetNextWindowSize({layout.left, layout.height});
  ImGui::Begin("controls", nullptr, kPanel);
  ImGui::BeginChild("settings", {0, -wish_buttons_height()});
  scene_panel(studio);
  light_panel(studio);
  look_panel(studio);
  picture_panel(studio);
  ImGui::EndChild();
  ImGui::Separator();
  wish_buttons(studio, wishes);
  ImGui::End();
}

// A slider with its value beside it, where the grab does not cover it. With Ctrl, a click lets one type.
bool track(const char* name, ImGuiDataType type, void* value, const void* low, const void* high, const char* format,
           ImGuiSliderFlags flags) {
  const std::string id = fmt::format("##{}", name);
  const float right = ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x;
  ImGui::BeginGroup();  // hints are for both
  ImGui::SetNextItemWidth(std::max(ImGui::GetContentRegionAvail().x - 3.6f * ImGui::GetFontSize(), 1.0f));
  // The slider writes its value into its middle, where only what is typed is wanted.
  const bool typing = ImGui::TempInputIsActive(ImGui::GetID(id.c_str()));
  ImGui::PushStyleColor(ImGuiCol_Text, typing ? kInk : ImVec4{0, 0, 0, 0});
  const bool changed =
      ImGui::SliderScalar(id.c_str(), type, value, low, high, format, ImGuiSliderFlags_AlwaysClamp | flags);
  ImGui::PopStyleColor();
  std::array<char, 32> text = {};
  ImGui::DataTypeFormatString(text.data(), static_cast<int>(text.size()), type, value, format);
  ImGui::SameLine();
  ImGui::SetCursorPosX(right - ImGui::CalcTextSize(text.data()).x);
  ImGui::TextUnformatted(text.data());
  ImGui::EndGroup();
  return changed;
}

}  // namespace

ImTextureID id_of(unsigned texture) {
  return reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(texture));
}

void begin_overlay(const char* name, ImVec2 at, ImVec2 pivot, ImGuiWindowFlags more) {
  constexpr ImGuiWindowFlags kOverlay = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                        ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysAutoResize |
                                        ImGuiWindowFlags_NoFocusOnAppearing;
  ImGui::SetNextWindowPos(at, ImGuiCond_Always, pivot);
  ImGui::SetNextWindowBgAlpha(0.94f);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 8);
  ImGui::Begin(name, nullptr, kOverlay | more);
  ImGui::PopStyleVar();
}

Layout make_layout(const Settings& settings, int width, int height, double scale) {
  Layout layout;
  layout.scale = static_cast<float>(scale);
  layout.width = static_cast<float>(width), layout.height = static_cast<float>(height);
  // A picture has at least as much room as a panel: in small windows panels give way.
  const float controls_width = std::floor(kControlsWidth * layout.scale),
              insight = std::floor(kInsightWidth * layout.scale);
  if (settings.controls && layout.width >= 2 * controls_width) layout.left = controls_width;
  if (settings.insight && layout.width - layout.left >= 2 * insight) layout.right = insight;
  return layout;
}

void draw_panels(Studio& studio, const Insight& insight, const FrameTimes& times, const Layout& layout,
                 Wishes& wishes) {
  std::optional<Insight::AtPointer> at_pointer;
  if (layout.right > 0 && studio.ready())
    at_pointer = insight.at_pointer(studio.subject(), studio.side(studio.settings.side), studio.settings);
  viewport(studio, at_pointer, layout);
  if (layout.left > 0) controls(studio, layout, wishes);
  if (layout.right > 0) {
    ImGui::SetNextWindowPos({layout.width - layout.right, 0});
    ImGui::SetNextWindowSize({layout.right, layout.height});
    ImGui::Begin("insight", nullptr, kPanel & ~ImGuiWindowFlags_NoScrollbar);
    insight_panel(studio, insight, at_pointer, layout);
    ImGui::End();
  }
  if (studio.settings.timing) timing_panel(studio, times, layout);
  if (studio.settings.keys) keys_overlay(layout);
  messages_overlay(studio, layout);
}

bool section(const char* title, bool open) {
  ImGui::Dummy({0, 1});
  ImGui::PushFont(heading_font());
  const bool shown = ImGui::CollapsingHeader(title, open ? ImGuiTreeNodeFlags_DefaultOpen : 0);
  ImGui::PopFont();
  return shown;
}

void named(const char* name) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextDisabled("%s", name);
  ImGui::SameLine(5.4f * ImGui::GetFontSize());
  ImGui::SetNextItemWidth(-1);
}

void hint(const char* text) {
  if (!ImGui::IsItemHovered()) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(20 * ImGui::GetFontSize());
  ImGui::TextUnformatted(text);
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

bool slider(const char* name, double& value, double low, double high, const char* format, bool logarithmic) {
  named(name);
  return track(name, ImGuiDataType_Double, &value, &low, &high, format, logarithmic ? ImGuiSliderFlags_Logarithmic : 0);
}

bool slider(const char* name, int& value, int low, int high, const char* format) {
  named(name);
  return track(name, ImGuiDataType_S32, &value, &low, &high, format, 0);
}

bool choice(const char* name, std::string& value, const std::vector<std::string>& words) {
  named(name);
  bool changed = false;
  if (!ImGui::BeginCombo(fmt::format("##{}", name).c_str(), value.c_str())) return false;
  for (const std::string& word : words)
    if (ImGui::Selectable(word.c_str(), word == value)) value = word, changed = true;
  ImGui::EndCombo();
  return changed;
}

namespace {

std::string short_name(const std::string& path) {
  if (path.starts_with("fn:")) return path;
  if (path.starts_with("builtin:")) return path.substr(0, path.find(':', 8));
  return std::filesystem::path(path).filename().string();
}

}  // namespace

void choice_of_file(const char* name, std::string& path, std::initializer_list<const char*> builtin,
                    const std::vector<std::string>& recent,
                    std::vector<std::string> (*files_beside)(const std::string& path)) {
  named(name);
  if (!ImGui::BeginCombo(fmt::format("##{}", name).c_str(), short_name(path).c_str(), ImGuiComboFlags_HeightLarge))
    return;
  const std::string present = path;
  const auto entry = [&](const std::string& other) {
    const std::string text = short_name(other);
    // A built-in light is itself whatever its parameters are.
    const bool is_present = other == present || (other == text && text == short_name(present));
    if (ImGui::Selectable(fmt::format("{}##{}", text, other).c_str(), is_present)) path = other;
    if (text != other) hint(other.c_str());
  };
  const auto list = [&](const char* title, const std::vector<std::string>& paths) {
    if (paths.empty()) return;
    ImGui::Separator();
    ImGui::TextDisabled("%s", title);
    ImGui::PushID(title);  // a file may be in both lists
    for (const std::string& other : paths) entry(other);
    ImGui::PopID();
  };
  for (const char* other : builtin) entry(other);
  list("opened lately", recent);
  list("beside this one", files_beside(present));
  ImGui::EndCombo();
}

namespace {

double to_double(const std::string& text, double otherwise) {
  double value = otherwise;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() ? value : otherwise;
}

bool color_knob(Parameters& parameters, const Knob& knob) {
  const std::string text = parameters.get(knob.key, fmt::format("{:g}", knob.value));
  const std::size_t first = text.find('/'), second = text.rfind('/');
  std::array<float, 3> rgb;
  rgb[0] = static_cast<float>(to_double(text, knob.value));
  rgb[1] = first == std::string::npos ? rgb[0] : static_cast<float>(to_double(text.substr(first + 1), knob.value));
  rgb[2] = first == std::string::npos ? rgb[0] : static_cast<float>(to_double(text.substr(second + 1), knob.value));
  named(knob.key.c_str());
  if (!ImGui::ColorEdit3(fmt::format("##{}", knob.key).c_str(), rgb.data(), ImGuiColorEditFlags_Float)) return false;
  for (float& v : rgb) v = std::clamp(v, static_cast<float>(knob.low), static_cast<float>(knob.high));
  parameters.set(knob.key, fmt::format("{:.3g}/{:.3g}/{:.3g}", rgb[0], rgb[1], rgb[2]));
  return true;
}

bool number_knob(Parameters& parameters, const Knob& knob) {
  double value = to_double(parameters.get(knob.key, ""), knob.value);
  if (!slider(knob.key.c_str(), value, knob.low, knob.high, "%.3g")) return false;
  parameters.set(knob.key, fmt::format("{:.4g}", std::clamp(value, knob.low, knob.high)));
  return true;
}

bool word_knob(Parameters& parameters, const Knob& knob) {
  std::string word = parameters.get(knob.key, knob.words[static_cast<std::size_t>(knob.value)]);
  if (!choice(knob.key.c_str(), word, knob.words)) return false;
  parameters.set(knob.key, word);
  return true;
}

}  // namespace

bool knobs(std::string& text, const std::vector<Knob>& knobs) {
  Parameters parameters(text);
  bool changed = false;
  for (const Knob& knob : knobs)
    changed = (!knob.words.empty() ? word_knob(parameters, knob)
               : knob.is_color     ? color_knob(parameters, knob)
                                   : number_knob(parameters, knob)) ||
              changed;
  if (changed) text = parameters.text();
  return changed;
}

}  // namespace shlight::viewer
