// Which model is shown.

#include <fmt/format.h>
#include <imgui.h>

#include <filesystem>

#include "panels.h"
#include "theme.h"

namespace shlight::viewer {
namespace {

std::string short_name(const std::string& path) {
  return path.starts_with("builtin:") ? path : std::filesystem::path(path).filename().string();
}

bool entry(const std::string& path, const std::string& current) {
  const bool chosen = ImGui::Selectable(fmt::format("{}##{}", short_name(path), path).c_str(), path == current);
  if (!path.starts_with("builtin:")) hint(path.c_str());
  return chosen;
}

}  // namespace

void scene_panel(Studio& studio) {
  if (!section("Model")) return;
  Settings& s = studio.settings;
  named("model");
  if (ImGui::BeginCombo("##model", short_name(s.model).c_str(), ImGuiComboFlags_HeightLarge)) {
    for (const char* name : {"builtin:scene", "builtin:knot", "builtin:sphere"})
      if (entry(name, s.model)) s.model = name;
    const auto list = [&](const char* title, const std::vector<std::string>& paths) {
      if (paths.empty()) return;
      ImGui::Separator();
      ImGui::TextDisabled("%s", title);
      for (const std::string& path : paths)
        if (entry(path, s.model)) s.model = path;
    };
    list("opened lately", studio.recent().models());
    list("beside this one", models_beside(s.model));
    ImGui::EndCombo();
  }
  hint("Or drop a file on the window: .x .obj .ply .stl .off .gltf .glb …, or a file of shlight bake");
  if (studio.loading_model()) {
    ImGui::TextColored(kAccent, "loading …");
  } else if (studio.ready()) {
    const ModelAsset& model = *studio.subject().model;
    ImGui::TextDisabled("%zu triangles, %zu vertices%s", model.triangles, model.vertices,
                        model.is_baked ? ", baked" : "");
  }
}

}  // namespace shlight::viewer
