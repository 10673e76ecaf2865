#include <fmt/format.h>

#include <cmath>

#include "shlight/report/html.h"
#include "shlight/report/part.h"
#include "shlight/report/picture.h"
#include "shlight/transfer/transfer.h"

// Figures 17 to 22: one scene under one light, by one to five bands, beside the truth.

namespace shlight {
namespace {

constexpr int kMostBands = 5;

// One picture of the group.
struct Drawn {
  std::string id, title;
  Image radiance;  // of the scene alone
};

// The thesis's classic method: transfer by Monte Carlo, without shadows.
Transfer bake_classic(const Scene& scene, int samples) {
  BakeParams params;
  params.kind = TransferKind::kCosine;
  params.method = TransferMethod::kMonteCarlo;
  params.bands = kMostBands;
  params.samples = samples;
  return bake_transfer(scene, params);
}

std::vector<Drawn> draw_group(const Scene& scene, const RenderLight& light, RenderParams params, int fine,
                              int samples) {
  const Transfer transfer = bake_classic(scene, samples);
  std::vector<Drawn> group;
  const auto classic = [&](const char* id, const char* title, int bands) {
    params.bands = bands;
    group.push_back({id, title, draw_fine(light, params, fine, [&](const RenderLight& l, const RenderParams& p) {
                       return render_transfer(scene, transfer, l, p);
                     })});
  };
  classic("figure-17", "Figure 17. One band", 1);
  classic("figure-18", "Figure 18. Two bands", 2);
  classic("figure-19", "Figure 19. Three bands, classic", 3);
  params.bands = 3;
  group.push_back({"figure-20", "Figure 20. Three bands, nine coefficients",
                   draw_fine(light, params, fine, [&](const RenderLight& l, const RenderParams& p) {
                     return render_irradiance(scene, l, p);
                   })});
  classic("figure-21", "Figure 21. Four bands", 4);
  classic("figure-22", "Figure 22. Five bands", 5);
  return group;
}

Image draw_interreflected(const Scene& scene, const RenderLight& light, RenderParams params, int fine) {
  BakeParams bake;
  bake.kind = TransferKind::kInterreflected;
  bake.bands = params.bands = kMostBands;
  bake.samples = 128;  // enough for a picture
  const Transfer transfer = bake_transfer(scene, bake);
  return draw_fine(light, params, fine,
                   [&](const RenderLight& l, const RenderParams& p) { return render_transfer(scene, transfer, l, p); });
}

void make_figures_17_to_22(ReportSources& sources, PartWriter& out) {
  const Light& light = sources.light();
  const Scene& scene = sources.scene(sources.figure_model());
  RenderParams params;
  params.width = sources.pick(160, 400), params.height = params.width * 3 / 4;
  params.camera = {30, 16, 1};
  params.show_background = false;
  const RenderLight render_light = make_render_light(light, kMostBands);
  const double exposure = auto_exposure(render_light.coefficients);
  const int fine = sources.pick(2, 3);

  const std::vector<Drawn> group = draw_group(scene, render_light, params, fine, sources.params().samples);
  const Reference truth = trace_reference(scene, light, params, nullptr, sources.pick(32, 256), out.progress());
  const Image backdrop = draw_backdrop(scene, render_light, params, fine);
  const auto show = [&](const std::string& id, const std::string& title, const Image& radiance) {
    return out.add_picture(id, make_picture8(add_images(radiance, backdrop), exposure), title);
  };

  HtmlTable table = {{"figure", "relative_error", "resolution"}, {}};
  std::string html = "<div class=\"group four\">\n";
  for (const Drawn& drawn : group) {
    const PictureError error = measure_picture(drawn.radiance, truth);
    add_error(out, drawn.id, error);
    table.rows.push_back({drawn.id, fmt::format("{:.6g}", error.value), fmt::format("{:.6g}", error.resolution)});
    html += html_figure(show(drawn.id, drawn.title, drawn.radiance),
                        {"<b>" + drawn.title + ".</b>", "error " + to_text(error)});
  }
  out.add_value("reference_noise", truth.noise);
  out.add_csv("figures-17-22", csv_table(table));
  html += html_figure(show("reference", "The reference, path traced", truth.radiance),
                      {"<b>The truth</b>, path traced.", "noise " + format_percent(truth.noise)});
  if (!sources.params().quick)
    html += html_figure(show("interreflected", "With shadows and light between surfaces",
                             draw_interreflected(scene, render_light, params, fine)),
                        {"<b>Beyond the thesis.</b>", "five bands with shadows and light between surfaces"});
  out.add_html(html + "</div>\n");
  const Reference nine = {group[3].radiance, Image(params.width, params.height), 0};
  const PictureError difference = measure_picture(group[2].radiance, nine);
  add_error(out, "classic_to_nine", difference);
  out.add_html(
      fmt::format("<p>Figures 19 and 20, the two ways to three bands, differ by {}.</p>\n", to_text(difference)));
}

}  // namespace

std::vector<PartRecipe> irradiance_recipes() {
  return {{"figures-17-22", "Figures 17 to 22: one scene by 1 to 5 bands", 20, make_figures_17_to_22}};
}

}  // namespace shlight
