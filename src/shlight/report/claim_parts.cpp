#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "shlight/brdf/make_brdf.h"
#include "shlight/core/error.h"
#include "shlight/report/html.h"
#include "shlight/report/line_plot.h"
#include "shlight/report/part.h"
#include "shlight/report/tables.h"
#include "shlight/report/thesis_materials.h"
#include "shlight/sh/zonal.h"
#include "shlight/transfer/cosine_transfer.h"
#include "shlight/truth/band_error.h"
#include "shlight/truth/svg.h"

// The thesis's claims, each with a criterion, figures, and the verdict that follows from them.

namespace shlight {
namespace {

constexpr double kRealTime = 25;  // frames a second

std::string verdict(bool confirmed, bool partly, const std::string& words) {
  const char* const kind = confirmed ? (partly ? "Confirmed in part" : "Confirmed") : "Refuted";
  return fmt::format("<p class=\"verdict {}\"><b>{}.</b> {}</p>\n", confirmed ? "yes" : "no", kind, words);
}

// The light of the report and, of built-in ones, as many more as there is time for.
std::vector<std::string> lights_of(ReportSources& sources) {
  std::vector<std::string> names = {sources.params().light};
  for (const char* name : {"builtin:sky", "builtin:studio", "builtin:panel", "builtin:thesis"})
    if (std::ranges::find(names, name) == names.end()) names.emplace_back(name);
  names.resize(std::min(names.size(), sources.pick<std::size_t>(1, 4)));
  return names;
}

BandErrors measure(ReportSources& sources, const std::string& light, const std::string& material, int bands) {
  BandErrorParams params;
  params.max_bands = bands;
  const auto brdf = make_brdf(material);
  const auto errors = light == sources.params().light ? measure_band_errors(sources.light(), *brdf, params)
                                                      : measure_band_errors(*load_light(light).light, *brdf, params);
  if (!errors) throw Error(light, "gives no light", "a light that is not black");
  return *errors;
}

// How much of ∫ max(0, cos θ)² = 2π/3 the first bands hold.
double cosine_energy(int bands) {
  double sum = 0;
  for (int l = 0; l < bands; ++l) sum += cosine_lobe(l) * cosine_lobe(l);
  return sum / (2 * std::numbers::pi / 3);
}

void make_claim_1(ReportSources& sources, PartWriter& out) {
  constexpr double kMostMean = 0.02;
  HtmlTable table = {{"light", "mean", "root mean square", "99 % of normals", "largest", "largest, of what is there"},
                     {}};
  double worst_mean = 0, worst_local = 0;
  int kept = 0;
  const std::vector<std::string> lights = lights_of(sources);
  for (const std::string& light : lights) {
    const BandError error = measure(sources, light, "lambert", 3).bands.back();
    std::vector<std::string> row = {escape_xml(light)};
    for (const auto& [name, value] : {std::pair{"mean", error.mean},
                                      {"rms", error.rms},
                                      {"p99", error.p99},
                                      {"max", error.max},
                                      {"max_local", error.max_local}}) {
      row.push_back(format_percent(value));
      out.add_value(fmt::format("{}_{}", name, light), value);
    }
    table.rows.push_back(row);
    kept += error.mean <= kMostMean;
    worst_mean = std::max(worst_mean, error.mean), worst_local = std::max(worst_local, error.max_local);
  }
  out.add_value("cosine_energy", cosine_energy(3));
  out.add_html(html_table(table));
  out.add_html(verdict(
      kept > 0, kept < std::ssize(lights),
      fmt::format(
          "Three bands hold {:.2f} % of the energy of the clamped cosine. The mean error over all normals stays "
          "within {} of the largest irradiance under {} of {} lights, and is {:.3g} % under the worst of them. Where "
          "little light falls, they are off by up to {} of what there is.",
          100 * cosine_energy(3), format_percent(kMostMean), kept, lights.size(), 100 * worst_mean,
          format_percent(worst_local))));
}

// Irradiance of three bands at the normals of a knot by both of the thesis's ways: root mean square and largest
// difference, of the largest irradiance.
std::array<double, 2> measure_agreement(const Light& light, int samples) {
  constexpr int kBands = 3;
  const RgbCoefficients radiance = light.project(kBands);
  const Scene scene = make_table_knot(64, 16);
  const std::vector<Vec3f>& normals = scene.meshes[0].normals;
  std::vector<float> transfer(normals.size() * num_coefficients(kBands));
  sample_cosine_transfer(kBands, normals, samples, 1, transfer);
  double square = 0, most = 0, largest = 0;
  for (std::size_t v = 0; v < normals.size(); ++v) {
    const Rgb nine = eval_irradiance_polynomial(radiance, vec_cast<double>(normals[v]));
    Rgb classic;
    for (std::size_t i = 0; i < radiance.size(); ++i)
      classic += std::numbers::pi * double{transfer[v * radiance.size() + i]} * radiance[i];
    const double difference = std::abs(luminance(classic - nine));
    square += difference * difference, most = std::max(most, difference), largest = std::max(largest, luminance(nine));
  }
  return {std::sqrt(square / static_cast<double>(normals.size())) / largest, most / largest};
}

void make_claim_2(ReportSources& sources, PartWriter& out) {
  constexpr double kMost = 0.01;
  const auto [rms, most] = measure_agreement(sources.light(), sources.params().samples);
  out.add_value("rms", rms);
  out.add_value("largest", most);
  out.add_html(
      verdict(most <= kMost, false,
              fmt::format("At 1 024 normals the two differ by {} of the largest irradiance (root mean square), "
                          "by {} at most, which is what the samples scatter ({} was to be kept). Without "
                          "samples, in closed form, they are the same sum.",
                          format_percent(rms), format_percent(most), format_percent(kMost))));
}

std::string plot_errors(const std::vector<PlotCurve>& curves) {
  PlotAxis y = {-4, 0, {}, "root mean square error, of the largest"};
  for (int k = -4; k <= 0; ++k) y.ticks.emplace_back(k, fmt::format("{:g} %", 100 * std::pow(10, k)));
  return make_line_plot(make_axis(1, 10, 1, "bands"), y, curves);
}

void make_claim_3(ReportSources& sources, PartWriter& out) {
  constexpr int kBands = 10;
  HtmlTable table = {{"light", "material", "3 bands", "5 bands", "8 bands", "as good as Lambert by 3"}, {}};
  std::vector<PlotCurve> curves;
  int few = 0, many = 0;
  const std::vector<std::string> lights = lights_of(sources);
  double done = 0;
  for (const std::string& light : lights) {
    double wanted = 0;  // the error of Lambert's three bands
    const auto add = [&](const char* id, const char* name, const char* material) {
      const std::vector<BandError> errors = measure(sources, light, material, kBands).bands;
      if (wanted == 0) wanted = errors[2].rms;
      const auto enough = find_enough_bands(errors, &BandError::rms, wanted);
      (enough && *enough < 5 ? few : many) += id != std::string_view("lambert");
      table.rows.push_back({escape_xml(light), name, format_percent(errors[2].rms), format_percent(errors[4].rms),
                            format_percent(errors[7].rms),
                            enough ? fmt::format("{} bands", *enough) : "more than 10 bands"});
      for (const int n : {3, 5, 8})
        out.add_value(fmt::format("{}_{}_{}", light, id, n), errors[static_cast<std::size_t>(n - 1)].rms);
      out.add_value(fmt::format("{}_{}_enough", light, id), enough.value_or(kBands + 1));
      if (light != lights[0]) return;
      curves.push_back({name, {}, true, true});
      for (const BandError& e : errors) curves.back().points.push_back({double(e.bands), std::log10(e.rms)});
    };
    add("lambert", "Lambert", "lambert");
    for (const ThesisMaterial& material : thesis_materials()) {
      add(material.id, material.name, material.text);
      report_progress(out.progress(), (done += 0.25) / static_cast<double>(lights.size()));
    }
  }
  out.add_csv("claim-3", csv_table(table));
  out.add_html(html_figure(out.add_plot("claim-3", plot_errors(curves), "Errors that fall with the number of bands"),
                           {fmt::format("Error of 1 to 10 bands under {}.", escape_xml(lights[0]))}));
  out.add_html(html_table(table));
  out.add_html(verdict(many > few, few > 0,
                       fmt::format("To be as good as three bands are for Lambert under the same light, {} of {} pairs "
                                   "of a light and another material take five bands or more, and {} do with fewer.",
                                   many, many + few, few)));
}

void make_claim_4(ReportSources& sources, PartWriter& out) {
  const Scene scene = make_table_knot(64, 16);
  const double rotation = measure_rotation_seconds(1024);
  out.add_time("rotation_seconds", rotation);
  HtmlTable table = {{"material", "thesis, a new eye", "a new eye today", "at each vertex, FPS", "at each pixel, FPS"},
                     {}};
  double slowest = 0, done = 0;
  for (const ThesisMaterial& material : thesis_materials().first(sources.pick<std::size_t>(1, 4))) {
    const auto brdf = make_brdf(material.text);
    const auto fps = [&](Shade shade) {
      return measure_reflectance_frames(scene, *brdf, sources.light(), shade, sources.pick(1, 20));
    };
    const double view = measure_view_seconds(*brdf), vertex = fps(Shade::kVertex), pixel = fps(Shade::kPixel);
    out.add_time(fmt::format("view_seconds_{}", material.id), view);
    out.add_time(fmt::format("vertex_fps_{}", material.id), vertex);
    out.add_time(fmt::format("pixel_fps_{}", material.id), pixel);
    table.rows.push_back({material.name, format_seconds(material.thesis_seconds), format_seconds(view),
                          format_count(vertex), format_count(pixel)});
    slowest = std::max(slowest, view);
    report_progress(out.progress(), (done += 1) / 4);
  }
  out.add_html(html_table(table));
  const FrameRow plain = measure_frame_row(scene, sources.light(), sources.pick(1, 20));
  out.add_time("plain_fps", plain.irradiance);
  out.add_html(
      verdict(slowest > 1 / kRealTime, false,
              fmt::format("Turning 3 × 25 coefficients into the frames of 1 024 vertices takes {} of one "
                          "thread. With F* from a table of all views, a new eye costs {} at most, where 1/{:g} s "
                          "is real time. Frames of 1 440 × 900 pixels are drawn by {}, the light turned and F* "
                          "looked up at each vertex or each pixel of each frame; nine coefficients are drawn {} "
                          "times a second there.",
                          format_seconds(rotation), format_seconds(slowest), kRealTime, escape_xml(plain.gl_renderer),
                          format_count(plain.irradiance))));
}

void make_claim_5(ReportSources& sources, PartWriter& out) {
  const MethodCost cost = measure_lat_long(sources.light(), 1024);
  out.add_time("seconds", cost.seconds);
  out.add_value("error", cost.error);
  out.add_html(
      verdict(1 / cost.seconds >= kRealTime, false,
              fmt::format("All of the 524 288 pixels of a 1024 × 512 map become three bands in {}, {} times a "
                          "second, right to {}.",
                          format_seconds(cost.seconds), format_count(1 / cost.seconds), format_percent(cost.error))));
}

}  // namespace

std::vector<PartRecipe> claim_recipes() {
  return {{"claim-1", "Claim 1: three bands are enough for Lambertian surfaces", 4, make_claim_1},
          {"claim-2", "Claim 2: classic and nine-coefficient results agree", 0.5, make_claim_2},
          {"claim-3", "Claim 3: anything else needs at least five bands", 30, make_claim_3},
          {"claim-4", "Claim 4: rotation and projection rule out real time", 8, make_claim_4},
          {"claim-5", "Claim 5: projection is quick enough for dynamic light", 0.5, make_claim_5}};
}

}  // namespace shlight
