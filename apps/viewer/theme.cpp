#include "theme.h"

#include <array>
#include <cmath>
#include <filesystem>

namespace shlight::viewer {
namespace {

constexpr float kTextSize = 15, kHeadingSize = 16;  // pixels at scale 1

// Where Debian's packages fonts-lato and fonts-dejavu-core have them.
constexpr std::array kTextFonts = {"/usr/share/fonts/truetype/lato/Lato-Medium.ttf",
                                   "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"};
constexpr std::array kHeadingFonts = {"/usr/share/fonts/truetype/lato/Lato-Bold.ttf",
                                      "/usr/share/fonts/truetype/dejavu/DejaVuSans-Bold.ttf"};
// Latin with accents, Greek, dashes and dots, arrows, mathematics.
constexpr ImWchar kRanges[] = {0x20,   0x17f,  0x370,  0x3ff,  0x2010, 0x2027, 0x2070,
                               0x209f, 0x2190, 0x21ff, 0x2200, 0x22ff, 0};

template <std::size_t kCount>
ImFont* load_font(const std::array<const char*, kCount>& files, float size) {
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  for (const char* file : files) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error)) continue;
    ImFontConfig config;
    config.OversampleH = 2, config.OversampleV = 2;
    if (ImFont* font = atlas.AddFontFromFileTTF(file, size, &config, kRanges)) return font;
  }
  ImFontConfig config;
  config.SizePixels = std::floor(size);
  return atlas.AddFontDefault(&config);
}

ImVec4 with_alpha(ImVec4 color, float alpha) {
  color.w = alpha;
  return color;
}

void set_colors(ImGuiStyle& style) {
  ImGui::StyleColorsDark(&style);
  auto& c = style.Colors;
  const ImVec4 panel = {0.115f, 0.122f, 0.138f, 1}, field = {0.175f, 0.185f, 0.208f, 1};
  const ImVec4 field_hovered = {0.215f, 0.226f, 0.252f, 1}, field_active = {0.25f, 0.262f, 0.29f, 1};
  c[ImGuiCol_Text] = kInk;
  c[ImGuiCol_TextDisabled] = kFaint;
  c[ImGuiCol_WindowBg] = panel;
  c[ImGuiCol_ChildBg] = {0, 0, 0, 0};
  c[ImGuiCol_PopupBg] = {0.135f, 0.142f, 0.16f, 0.98f};
  c[ImGuiCol_Border] = {1, 1, 1, 0.06f};
  c[ImGuiCol_FrameBg] = field;
  c[ImGuiCol_FrameBgHovered] = field_hovered;
  c[ImGuiCol_FrameBgActive] = field_active;
  c[ImGuiCol_Header] = {1, 1, 1, 0.035f};
  c[ImGuiCol_HeaderHovered] = {1, 1, 1, 0.08f};
  c[ImGuiCol_HeaderActive] = {1, 1, 1, 0.11f};
  c[ImGuiCol_Button] = field;
  c[ImGuiCol_ButtonHovered] = field_hovered;
  c[ImGuiCol_ButtonActive] = field_active;
  c[ImGuiCol_CheckMark] = kAccent;
  c[ImGuiCol_SliderGrab] = with_alpha(kAccent, 0.6f);
  c[ImGuiCol_SliderGrabActive] = with_alpha(kAccent, 0.9f);
  c[ImGuiCol_Separator] = {1, 1, 1, 0.07f};
  c[ImGuiCol_ScrollbarBg] = {0, 0, 0, 0};
  c[ImGuiCol_ScrollbarGrab] = {1, 1, 1, 0.12f};
  c[ImGuiCol_PlotHistogram] = kAccent;
  c[ImGuiCol_PlotLines] = kCool;
  c[ImGuiCol_TextSelectedBg] = with_alpha(kAccent, 0.3f);
  c[ImGuiCol_NavHighlight] = with_alpha(kAccent, 0.6f);
}

}  // namespace

void apply_theme(double scale) {
  ImGuiStyle& style = ImGui::GetStyle();
  style = ImGuiStyle();
  set_colors(style);
  style.WindowRounding = 0, style.ChildRounding = 6, style.FrameRounding = 5, style.GrabRounding = 4;
  style.PopupRounding = 7, style.ScrollbarRounding = 6;
  style.WindowBorderSize = 0, style.FrameBorderSize = 0, style.PopupBorderSize = 1;
  style.WindowPadding = {14, 10}, style.FramePadding = {9, 3.5f}, style.ItemSpacing = {8, 5};
  style.ItemInnerSpacing = {7, 5}, style.ScrollbarSize = 10, style.GrabMinSize = 7;
  style.ScaleAllSizes(static_cast<float>(scale));
  const auto size = [scale](float pixels) { return std::round(pixels * static_cast<float>(scale)); };
  ImGui::GetIO().Fonts->Clear();
  load_font(kTextFonts, size(kTextSize));
  load_font(kHeadingFonts, size(kHeadingSize));
}

ImFont* heading_font() {
  return ImGui::GetIO().Fonts->Fonts[1];
}

}  // namespace shlight::viewer
