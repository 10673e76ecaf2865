// How a side is drawn, and what is made of the picture.

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>

#include "panels.h"
#include "parameters.h"
#include "shlight/brdf/make_brdf.h"
#include "theme.h"

namespace shlight::viewer {
namespace {

// Buttons of one row, of which one is on.
bool switches(const char* id, int& value, std::initializer_list<const char*> names) {
  bool changed = false;
  const float gap = 3;
  const float width = (ImGui::GetContentRegionAvail().x - gap * static_cast<float>(names.size() - 1)) /
                      static_cast<float>(names.size());
  int i = 0;
  for (const char* name : names) {
    if (i > 0) ImGui::SameLine(0, gap);
    const bool on = i == value;
    if (on) ImGui::PushStyleColor(ImGuiCol_Button, ImVec4{0.44f, 0.35f, 0.22f, 1});
    if (ImGui::Button(fmt::format("{}##{}", name, id).c_str(), {width, 0}) && !on) value = i, changed = true;
    if (on) ImGui::PopStyleColor();
    ++i;
  }
  return changed;
}

// Starting points for who does not know the models' names.
constexpr std::array<const char*, 5> kExamples = {
    "ggx:alpha=0.3,f0=0.9/0.65/0.3", "cook-torrance:m=0.3,f0=0.9", "ward-aniso:rd=0.02/0.05/0.1,rs=0.4,sx=0.1,sy=0.5",
    "blinn-phong:rd=0.05/0.1/0.05,rs=0.4,n=50", "oren-nayar:rho=0.8/0.6/0.5,sigma=0.4"};

void material(Look& look) {
  const std::string name = look.material.empty() ? "the model's own" : Parameters(look.material).name;
  named("material");
  if (ImGui::BeginCombo("##material", name.c_str(), ImGuiComboFlags_HeightLarge)) {
    if (ImGui::Selectable("the model's own", look.material.empty())) look.material.clear();
    for (const BrdfModel& model : brdf_models()) {
      if (model.parameters.empty()) continue;  // of files
      if (!ImGui::Selectable(model.name.c_str(), model.name == name)) continue;
      look.material = model.name;
      for (const char* example : kExamples)
        if (Parameters(example).name == model.name) look.material = example;
    }
    ImGui::EndCombo();
  }
  if (look.material.empty()) return;
  for (const BrdfModel& model : brdf_models()) {
    if (model.name != name) continue;
    std::vector<Knob> all;
    for (const BrdfParameter& p : model.parameters) all.push_back({p.key, p.min, p.max, p.value, p.is_colour, p.words});
    knobs(look.material, all);
  }
}

void transfer(Look& look, const Side& side, bool is_baked) {
  if (is_baked) {
    ImGui::TextDisabled("as it was baked");
    return;
  }
  int kind = static_cast<int>(look.transfer);
  named("shadows");
  if (switches("transfer", kind, {"none", "cast", "bounce"})) look.transfer = static_cast<TransferKind>(kind);
  hint("What is baked for each vertex: no shadows, shadows, or those and light between surfaces");
  if (look.transfer == TransferKind::kInterreflected) slider("bounces", look.bounces, 0, 8);
  if (look.method == Method::kReference || look.transfer == TransferKind::kCosine) return;
  int power = 0;
  while ((1 << power) < look.samples) ++power;
  if (slider("rays", power, 0, 13, power == 0 ? "auto" : fmt::format("{}", 1 << power).c_str()))
    look.samples = power == 0 ? 0 : 1 << power;
  hint("A vertex; auto takes as many as each needs");
  if (side.transfer() && side.transfer()->estimated_error > 0)
    ImGui::TextDisabled("error of the bake %.2g %%", 100 * side.transfer()->estimated_error);
}

// Of what is drawn by tables: those of the file's transfer, or none.
void baked_shadows(Look& look, TransferKind baked) {
  int cast = look.transfer == TransferKind::kCosine ? 0 : 1;
  named("shadows");
  if (switches("baked shadows", cast, {"none", "as baked"})) look.transfer = cast == 0 ? TransferKind::kCosine : baked;
}

void shown(Look& look, bool knows_visibility) {
  std::vector<std::string> words = {"lit", "normals", "one band"};
  if (knows_visibility) words.push_back("visibility");
  std::string word = look.show == Show::kLit       ? "lit"
                     : look.show == Show::kNormals ? "normals"
                     : look.show == Show::kDegree  ? "one band"
                                                   : "visibility";
  if (choice("show", word, words))
    look.show = word == "lit"        ? Show::kLit
                : word == "normals"  ? Show::kNormals
                : word == "one band" ? Show::kDegree
                                     : Show::kVisibility;
  if (look.show == Show::kDegree) slider("degree", look.degree, 0, look.bands - 1);
}

void window(Look& look) {
  const Parameters parts(look.window);
  std::string name = parts.name;
  if (choice("window", name, {"none", "auto", "auto-radiance", "hann", "lanczos", "laplacian"}))
    look.window = name == "hann" || name == "lanczos" ? fmt::format("{}:{}", name, look.bands + 1)
                  : name == "laplacian"               ? "laplacian:0.01"
                                                      : name;
  hint("Smooths the light against ringing; auto does just enough for irradiance to be nowhere negative");
  const std::size_t colon = look.window.find(':');
  if (colon == std::string::npos) return;
  double strength = std::atof(look.window.c_str() + colon + 1);
  const bool laplacian = look.window.starts_with("laplacian");
  if (slider("strength", strength, laplacian ? 1e-4 : 1, laplacian ? 1 : 20, "%.3g", laplacian))
    look.window = fmt::format("{}:{:.4g}", look.window.substr(0, colon), strength);
}

}  // namespace

void look_panel(Studio& studio) {
  if (!section("Method")) return;
  Settings& s = studio.settings;
  int compare = static_cast<int>(s.compare);
  if (switches("compare", compare, {"one", "A | B", "A - B"})) s.compare = static_cast<Compare>(compare);
  hint("One picture, two beside each other, or where they differ");
  if (s.compare != Compare::kOne) {
    switches("side", s.side, {"set A", "set B"});
    hint("Whose settings are below");
  }
  Look& look = s.look();
  std::string method = to_text(look.method);
  if (choice("method", method, {"irradiance", "transfer", "reflectance", "hybrid", "reference"}))
    set_by_name(s, "method", method);
  const bool reference = look.method == Method::kReference;
  const bool reflects = look.method == Method::kReflectance || look.method == Method::kHybrid;
  if (!reference) {
    slider("bands", look.bands, 1, kMaxRenderBands);
    look.degree = std::min(look.degree, look.bands - 1);
  }
  const bool is_baked = studio.ready() && studio.subject().model->is_baked;
  if (look.method == Method::kTransfer || reference || look.show == Show::kVisibility)
    transfer(look, studio.side(s.side), is_baked && !reference);
  if (reflects && is_baked) baked_shadows(look, studio.subject().model->content.transfer.kind);
  if (reflects || reference) material(look);
  if (reflects) {
    int shade = static_cast<int>(look.shade);
    named("shade");
    if (switches("shade", shade, {"pixels", "vertices"})) look.shade = static_cast<Shade>(shade);
  }
  if (reference) return;
  window(look);
  shown(look, look.method == Method::kTransfer);
  if (look.show == Show::kVisibility && look.method != Method::kTransfer) look.show = Show::kLit;
  ImGui::Checkbox("stripe negative light", &look.mark_negative);
}

void picture_panel(Studio& studio) {
  if (!section("Picture")) return;
  Settings& s = studio.settings;
  slider("exposure", s.exposure, -6, 6, "%+.1f EV");
  int curve = static_cast<int>(s.curve);
  named("tones");
  if (switches("curve", curve, {"filmic", "cut off"})) s.curve = static_cast<ToneCurve>(curve);
  ImGui::Checkbox("background", &s.background);
  ImGui::SameLine();
  ImGui::Checkbox("insight", &s.insight);
  ImGui::SameLine();
  ImGui::Checkbox("times", &s.timing);
}

float wish_buttons_height() {
  return 3 * ImGui::GetFrameHeightWithSpacing() + ImGui::GetStyle().ItemSpacing.y;
}

void wish_buttons(Studio& studio, Wishes& wishes) {
  const float half = 0.5f * (ImGui::GetContentRegionAvail().x - 4);
  if (ImGui::Button("save picture", {half, 0})) wishes.save_png = true;
  ImGui::SameLine(0, 4);
  if (ImGui::Button("save radiance", {half, 0})) wishes.save_exr = true;
  if (ImGui::Button("copy as command", {half, 0})) wishes.copy_command = true;
  hint("The shlight render line that draws this picture");
  ImGui::SameLine(0, 4);
  if (ImGui::Button("export light", {half, 0})) wishes.export_coefficients = true;
  hint("The light's coefficients as they are drawn, as a JSON file");
  if (ImGui::Button("keys", {half, 0})) studio.settings.keys = !studio.settings.keys;
  ImGui::SameLine(0, 4);
  if (ImGui::Button("reset", {half, 0})) wishes.reset = true;
}

}  // namespace shlight::viewer
