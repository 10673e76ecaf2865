// Which model is shown.

#include <imgui.h>

#include "panels.h"
#include "theme.h"

namespace shlight::viewer {

void scene_panel(Studio& studio) {
  if (!section("Model")) return;
  choice_of_file("model", studio.settings.model, {"builtin:scene", "builtin:knot", "builtin:sphere"},
                 studio.recent().models(), models_beside);
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
