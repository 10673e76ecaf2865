// What helps to understand the light.

#include <fmt/format.h>
#include <imgui.h>

#include <vector>

#include "chart.h"
#include "panels.h"
#include "shlight/sh/zonal.h"
#include "theme.h"

namespace shlight::viewer {
namespace {

void map(const PictureTexture* picture, float width) {
  const float height =
      picture ? width * static_cast<float>(picture->height()) / static_cast<float>(picture->width()) : 0.5f * width;
  if (picture)
    ImGui::Image(id_of(picture->texture()), {width, height});
  else
    ImGui::Dummy({width, height});
}

// The errors of `measure` of 1, 2, … bands.
std::vector<double> errors_of(const std::vector<BandError>& bands, double BandError::*measure) {
  std::vector<double> values;
  for (const BandError& error : bands) values.push_back(error.*measure);
  return values;
}

void error_chart(const BandErrors& errors, int bands, float height) {
  const std::vector<double> rms = errors_of(errors.bands, &BandError::rms),
                            most = errors_of(errors.bands, &BandError::max);
  std::vector<Curve> curves = {{rms, kAccent}, {most, kCool}};
  const std::vector<double> shaped = errors_of(errors.shaped, &BandError::rms);
  if (!shaped.empty()) curves.push_back({shaped, kInk});
  log_curves("##errors", curves, height, bands - 1);
  ImGui::TextColored(kAccent, "root mean square");
  ImGui::SameLine();
  ImGui::TextColored(kCool, "largest");
  if (shaped.empty()) return;
  ImGui::SameLine();
  ImGui::TextColored(kInk, "windowed");
}

}  // namespace

void insight_panel(const Studio& studio, const Insight& insight, const std::optional<Insight::AtPointer>& at_pointer,
                   const Layout& layout) {
  const Look& look = studio.settings.look();
  const float chart = 96 * layout.scale;
  if (section("The light, and what the bands keep of it")) {
    const float gap = 6 * layout.scale, width = 0.5f * (ImGui::GetContentRegionAvail().x - gap);
    map(insight.original(), width);
    ImGui::SameLine(0, gap);
    map(insight.reconstructed(), width);
    ImGui::TextDisabled("%d band%s, %d coefficients a colour", look.bands, look.bands == 1 ? "" : "s",
                        look.bands * look.bands);
  }
  if (section("As a balloon")) {
    if (insight.balloon() != 0) {
      const float width = ImGui::GetContentRegionAvail().x;
      ImGui::Image(id_of(insight.balloon()), {width, kBalloonAspect * width}, {0, 1}, {1, 0});
      hint("As far away in each direction as the light is bright there; magenta where it is negative");
    }
  }
  if (section("Error of what is reflected, by bands")) {
    if (insight.errors())
      error_chart(*insight.errors(), look.bands, chart);
    else
      ImGui::TextDisabled(insight.busy() ? "measuring …" : "no light");
  }
  if (section("Energy of the light in each band")) {
    if (!insight.energy().empty()) {
      const std::vector<Curve> curves = {{insight.energy(), kAccent}};
      log_curves("##energy", curves, 0.85f * chart, look.bands - 1);
    }
  }
  if (at_pointer && section("Transfer of the vertex under the pointer")) {
    bars("##transfer", "coefficient", at_pointer->transfer, kCool, 0.85f * chart, -1);
    const Rgb& white = at_pointer->radiance;
    ImGui::TextDisabled("vertex %zu; white leaves %.3g %.3g %.3g there", at_pointer->picked.vertex, white.r, white.g,
                        white.b);
  }
  if (section("Â, what is kept of each degree", false)) {
    std::vector<double> kept;
    for (int l = 0; l < kMaxRenderBands; ++l) kept.push_back(cosine_lobe_hat(l));
    bars("##cosine", "degree", kept, kCool, 0.85f * chart, look.show == Show::kDegree ? look.degree : -1);
  }
}

}  // namespace shlight::viewer
