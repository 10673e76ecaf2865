#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "shlight/light/builtin_light.h"
#include "shlight/render/render.h"
#include "shlight/report/basis_figures.h"
#include "shlight/report/html.h"
#include "shlight/report/line_plot.h"
#include "shlight/report/part.h"
#include "shlight/report/picture.h"
#include "shlight/sh/zonal.h"

// Figures 10 to 16: the basis, the samples, the cosine lobe.

namespace shlight {
namespace {

void make_figure_10(ReportSources& sources, PartWriter& out) {
  constexpr int kBands = 5;
  const auto light = make_studio_light();
  RenderParams params;
  params.width = sources.pick(360, 1080), params.height = params.width * 5 / 9;
  params.camera = {0, 6, 1.3, 14};
  RenderLight studio = make_render_light(*light, params.bands);
  // A plain dark ground instead of the studio.
  studio.background = Image(4, 2);
  std::ranges::fill(studio.background.values, 0.015f);
  const Scene scene = make_balloon_scene(kBands);
  const Image radiance = draw_fine(
      studio, params, 3, [&](const RenderLight& l, const RenderParams& p) { return render_irradiance(scene, l, p); });
  out.add_html(html_figure(
      out.add_picture("figure-10", make_picture8(radiance, 1.1 * auto_exposure(light->project(1))),
                      "Twenty-five surfaces in five rows, one for each spherical harmonic of five bands"),
      {"<b>Figure 10.</b> The basis functions of five bands: the distance of the surface is |<i>y</i>|, orange where "
       "it "
       "is positive, blue where it is negative. A row is a band, <i>m</i> grows to the right, <i>z</i> points up. "
       "Without the phase (−1)<sup><i>m</i></sup>."}));
}

void make_figure_11(ReportSources&, PartWriter& out) {
  std::vector<PlotCurve> curves;
  HtmlTable table = {{"x"}, {}};
  for (int l = 0; l <= 2; ++l)
    for (int m = 0; m <= l; ++m) {
      PlotCurve curve = {fmt::format("l = {}, m = {}", l, m), {}};
      for (int i = -60; i <= 60; ++i) curve.points.push_back({i / 60.0, eval_associated_legendre(l, m, i / 60.0)});
      table.head.push_back(fmt::format("P_{}^{}", l, m));
      curves.push_back(std::move(curve));
    }
  for (std::size_t i = 0; i < curves[0].points.size(); ++i) {
    std::vector<std::string> row = {fmt::format("{:.6f}", curves[0].points[i][0])};
    for (const PlotCurve& curve : curves) row.push_back(fmt::format("{:.6f}", curve.points[i][1]));
    table.rows.push_back(row);
  }
  out.add_csv("figure-11", csv_table(table));
  out.add_html(html_figure(
      out.add_plot("figure-11", make_line_plot(make_axis(-1, 1, 0.5, "x = cos θ"), make_axis(-3, 3, 1, "P"), curves),
                   "Six curves over x from minus one to one"),
      {"<b>Figure 11.</b> The first six associated Legendre polynomials, with the phase that the "
       "print gives them."}));
}

void make_figure_12(ReportSources& sources, PartWriter& out) {
  constexpr int kShown = 1024, kBands = 3;
  const int strata = strata_for(sources.params().samples);
  const double stratified = orthonormality_error(make_sphere_samples(kBands, strata, 1));
  const double independent = orthonormality_error(make_independent_samples(kBands, strata * strata));
  out.add_value("samples", strata * strata);
  out.add_value("stratified_error", stratified);
  out.add_value("independent_error", independent);
  const SphereSamples shown = make_sphere_samples(1, strata_for(kShown), 1);
  HtmlTable table = {{"x", "y", "z"}, {}};
  for (const Vec3d& d : shown.directions)
    table.rows.push_back({fmt::format("{:.9g}", d.x), fmt::format("{:.9g}", d.y), fmt::format("{:.9g}", d.z)});
  out.add_csv("figure-12", csv_table(table));
  out.add_html(html_figure(
      out.add_plot("figure-12", make_sample_plot(shown), "Points on a chart of two angles and on a sphere"),
      {fmt::format(
          "<b>Figure 12.</b> {} stratified samples, one from each cell of a 32 × 32 grid. On {} of them the nine "
          "functions of three bands are orthonormal to {:.2g}; on as many samples drawn without the grid to {:.2g}.",
          kShown, format_count(strata * strata), stratified, independent)}));
}

void make_figure_16(ReportSources&, PartWriter& out) {
  constexpr int kLast = 12;
  PlotCurve lobe = {"Âₗ", {}, false, true}, decay = {"Â₂ (2/l)²·⁵", {}};
  HtmlTable table = {{"l", "Â_l"}, {}};
  for (int l = 0; l <= kLast; ++l) {
    const double value = cosine_lobe_hat(l);
    lobe.points.push_back({double(l), value});
    table.rows.push_back({fmt::format("{}", l), fmt::format("{:.9f}", value)});
    out.add_value(fmt::format("A_{}", l), value);
  }
  for (double l = 2; l <= kLast; l += 0.25) decay.points.push_back({l, cosine_lobe_hat(2) * std::pow(2 / l, 2.5)});
  out.add_csv("figure-16", csv_table(table));
  out.add_html(html_figure(
      out.add_plot("figure-16",
                   make_line_plot(make_axis(0, kLast, 2, "degree l"), make_axis(-0.5, 3.5, 0.5, "Â"), {lobe, decay}),
                   "Dots that fall from pi to nearly zero"),
      {fmt::format("<b>Figure 16.</b> <i>Â<sub>l</sub></i> against the degree: {:.6f}, {:.6f}, {:.6f}, 0, −{:.6f}, 0, "
                   "{:.6f}: the first three bands hold nearly all of it.",
                   cosine_lobe_hat(0), cosine_lobe_hat(1), cosine_lobe_hat(2), -cosine_lobe_hat(4),
                   cosine_lobe_hat(6))}));
}

}  // namespace

std::vector<PartRecipe> basis_recipes() {
  return {{"figure-10", "Figure 10: the basis as surfaces", 2, make_figure_10},
          {"figure-11", "Figure 11: associated Legendre polynomials", 0.1, make_figure_11},
          {"figure-12", "Figure 12: the samples", 0.1, make_figure_12},
          {"figure-16", "Figure 16: the cosine lobe", 0.1, make_figure_16}};
}

}  // namespace shlight
