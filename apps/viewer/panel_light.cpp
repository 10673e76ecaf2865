// Which light falls on it.

#include <imgui.h>

#include <cmath>
#include <numbers>

#include "panels.h"
#include "parameters.h"
#include "shlight/light/builtin_light.h"
#include "theme.h"

namespace shlight::viewer {
namespace {

constexpr const char* kSky = "builtin:sky";
constexpr const char* kPanelLight = "builtin:panel";

// The parameters of a built-in light, after "builtin:".
bool builtin_knobs(std::string& light, const char* name, const std::vector<Knob>& all) {
  std::string text = light.substr(8);
  if (Parameters(text).name != std::string(name).substr(8)) return false;
  if (!knobs(text, all)) return false;
  light = "builtin:" + text;
  return true;
}

void sky_knobs(std::string& light) {
  const SkyParams sky;
  builtin_knobs(light, kSky,
                {{"elevation", 0, 90, sky.elevation, false, {}},
                 {"azimuth", -180, 180, sky.azimuth, false, {}},
                 {"turbidity", 1.7, 10, sky.turbidity, false, {}},
                 {"ground", 0, 1, sky.ground, false, {}}});
  const PanelParams panel;
  builtin_knobs(light, kPanelLight,
                {{"azimuth", -180, 180, panel.azimuth, false, {}},
                 {"elevation", -90, 90, panel.elevation, false, {}},
                 {"width", 1, 175, panel.width, false, {}},
                 {"height", 1, 175, panel.height, false, {}}});
}

}  // namespace

void light_panel(Studio& studio) {
  if (!section("Light")) return;
  Settings& s = studio.settings;
  choice_of_file("light", s.light, {kSky, "builtin:studio", kPanelLight, "builtin:axes", "builtin:thesis"},
                 studio.recent().lights(), lights_beside);
  hint("Or drop a file on the window: .hdr .exr .dds …, or coefficients (.json)");
  if (studio.loading_light() && (!studio.ready() || studio.subject().light->name != s.light) &&
      !s.light.starts_with("builtin:"))
    ImGui::TextColored(kAccent, "loading …");
  if (s.light.starts_with("builtin:")) sky_knobs(s.light);
  // The heading of what the light's front has been turned to.
  const Vec3d front = s.rotate_light({0, 0, -1});
  double degrees = std::round(std::atan2(-front.x, -front.z) * 180 / std::numbers::pi * 100) / 100 + 0.0;
  if (slider("turned", degrees, -180, 180, "%.0f°"))
    s.rotate_light = rotation_about_y(degrees * std::numbers::pi / 180);
  hint("About the vertical. Drag in the picture with the right button to turn the light freely.");
}

}  // namespace shlight::viewer
