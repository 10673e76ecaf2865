#include <fmt/format.h>

#include <span>

#include "shlight/brdf/make_brdf.h"
#include "shlight/report/html.h"
#include "shlight/report/part.h"
#include "shlight/report/tables.h"
#include "shlight/report/thesis_materials.h"
#include "shlight/truth/svg.h"

// Tables 1 to 4: what the thesis prints, the same measured today, and by the library's own methods.

namespace shlight {
namespace {

// A model that the tables measure, and what the thesis has for it; 0 where it has none.
struct TableModel {
  std::string name;
  Scene scene;
  double thesis = 0;
};

// The thesis's sizes, as knots, and then the models that were given.
std::vector<TableModel> make_models(ReportSources& sources, std::vector<TableModel> knots) {
  for (const std::string& model : sources.params().models) knots.push_back({model, sources.scene(model), 0});
  return knots;
}

std::string or_dash(double value, std::string (*format)(double)) {
  return value > 0 ? format(value) : "–";
}

std::string cell(double value) {
  return fmt::format("{:.6g}", value);
}

void make_table_1(ReportSources& sources, PartWriter& out) {
  constexpr std::pair<int, double> kThesis[] = {
      {256, 0.0086849025}, {512, 0.0095827822}, {640, 0.010086478}, {800, 0.010720915}, {1024, 0.010830147}};
  HtmlTable table = {{"angular map", "thesis", "its method today", "speed-up", "its error", "every pixel", "error",
                      "lat-long, as many pixels", "error", "speed-up"},
                     {}};
  HtmlTable csv = {{"size", "thesis_seconds", "classic_seconds", "classic_error", "exact_seconds", "exact_error",
                    "lat_long_seconds", "lat_long_error"},
                   {}};
  double done = 0;
  for (const auto& [size, seconds] : std::span(kThesis).first(sources.pick<std::size_t>(2, 5))) {
    const LightRow row = measure_light_row(sources.light(), size, sources.params().samples);
    table.rows.push_back({fmt::format("{0}²", size), format_seconds(seconds), format_seconds(row.classic.seconds),
                          format_factor(seconds / row.classic.seconds), format_percent(row.classic.error),
                          format_seconds(row.exact.seconds), format_percent(row.exact.error),
                          format_seconds(row.lat_long.seconds), format_percent(row.lat_long.error),
                          format_factor(seconds / row.lat_long.seconds)});
    csv.rows.push_back({fmt::format("{}", size), cell(seconds), cell(row.classic.seconds), cell(row.classic.error),
                        cell(row.exact.seconds), cell(row.exact.error), cell(row.lat_long.seconds),
                        cell(row.lat_long.error)});
    out.add_time(fmt::format("classic_seconds_{}", size), row.classic.seconds);
    out.add_time(fmt::format("exact_seconds_{}", size), row.exact.seconds);
    out.add_time(fmt::format("lat_long_seconds_{}", size), row.lat_long.seconds);
    out.add_value(fmt::format("classic_error_{}", size), row.classic.error);
    out.add_value(fmt::format("exact_error_{}", size), row.exact.error);
    out.add_value(fmt::format("lat_long_error_{}", size), row.lat_long.error);
    report_progress(out.progress(), (done += 1) / sources.pick(2, 5));
  }
  out.add_csv("table-1", csv_table(csv));
  out.add_html(html_table(table));
}

void make_table_2(ReportSources& sources, PartWriter& out) {
  // Twice as many triangles as vertices, as closed meshes have.
  const auto models = make_models(sources, {{"knot", make_table_knot(46, 13), 0.82},
                                            {"knot", make_table_knot(475, 37), 28.446},
                                            {"knot", make_table_knot(457, 68), 43.774}});
  HtmlTable table = {
      {"model", "vertices", "thesis", "its method today", "speed-up", "its error", "closed form", "error", "speed-up"},
      {}};
  HtmlTable csv = {{"model", "vertices", "triangles", "thesis_seconds", "classic_seconds", "classic_error",
                    "own_seconds", "own_error"},
                   {}};
  double done = 0;
  for (const TableModel& model : models) {
    const TransferRow row = measure_transfer_row(model.scene, sources.params().samples);
    const auto vertices = static_cast<double>(row.vertices);
    table.rows.push_back({escape_xml(model.name), format_count(vertices), or_dash(model.thesis, format_seconds),
                          format_seconds(row.classic.seconds),
                          or_dash(model.thesis / row.classic.seconds, format_factor), format_percent(row.classic.error),
                          format_seconds(row.own.seconds), format_percent(row.own.error),
                          or_dash(model.thesis / row.own.seconds, format_factor)});
    csv.rows.push_back({model.name, fmt::format("{}", row.vertices), fmt::format("{}", row.triangles),
                        cell(model.thesis), cell(row.classic.seconds), cell(row.classic.error), cell(row.own.seconds),
                        cell(row.own.error)});
    const std::string name = fmt::format("{}_{}", model.name, row.vertices);
    out.add_time("classic_seconds_" + name, row.classic.seconds);
    out.add_time("own_seconds_" + name, row.own.seconds);
    out.add_value("classic_error_" + name, row.classic.error);
    out.add_value("own_error_" + name, row.own.error);
    report_progress(out.progress(), (done += 1) / static_cast<double>(models.size()));
  }
  out.add_csv("table-2", csv_table(csv));
  out.add_html(html_table(table));
}

void make_table_3(ReportSources& sources, PartWriter& out) {
  HtmlTable table = {{"model", "thesis", "its method today", "speed-up", "its error", "quadrature", "error",
                      "from a table", "error", "speed-up", "the table itself"},
                     {}};
  HtmlTable csv = {{"model", "thesis_seconds", "classic_seconds", "classic_error", "own_seconds", "own_error",
                    "nodes_seconds", "lookup_seconds", "lookup_error", "table_seconds"},
                   {}};
  double done = 0;
  for (const ThesisMaterial& material : thesis_materials()) {
    const BrdfRow row = measure_brdf_row(*make_brdf(material.text), sources.params().samples);
    table.rows.push_back(
        {fmt::format("{}<br><code>{}</code>", material.name, material.text), format_seconds(material.thesis_seconds),
         format_seconds(row.classic.seconds), format_factor(material.thesis_seconds / row.classic.seconds),
         format_percent(row.classic.error), format_seconds(row.own.seconds), format_percent(row.own.error),
         format_seconds(row.lookup.seconds), format_percent(row.lookup.error),
         format_factor(material.thesis_seconds / row.lookup.seconds), format_seconds(row.table_seconds)});
    csv.rows.push_back({material.text, cell(material.thesis_seconds), cell(row.classic.seconds),
                        cell(row.classic.error), cell(row.own.seconds), cell(row.own.error), cell(row.nodes_seconds),
                        cell(row.lookup.seconds), cell(row.lookup.error), cell(row.table_seconds)});
    const std::string id = material.id;
    out.add_time("classic_seconds_" + id, row.classic.seconds);
    out.add_time("own_seconds_" + id, row.own.seconds);
    out.add_time("lookup_seconds_" + id, row.lookup.seconds);
    out.add_time("nodes_seconds_" + id, row.nodes_seconds);
    out.add_time("table_seconds_" + id, row.table_seconds);
    out.add_value("classic_error_" + id, row.classic.error);
    out.add_value("own_error_" + id, row.own.error);
    out.add_value("lookup_error_" + id, row.lookup.error);
    report_progress(out.progress(), (done += 1) / 4);
  }
  out.add_csv("table-3", csv_table(csv));
  out.add_html(html_table(table));
}

void make_table_4(ReportSources& sources, PartWriter& out) {
  // 1 072, 34 560 and 60 336 triangles: the thesis's numbers are odd where a knot's are even.
  const auto models = make_models(sources, {{"knot", make_table_knot(67, 8), 57},
                                            {"knot", make_table_knot(480, 36), 57},
                                            {"knot", make_table_knot(419, 72), 55}});
  HtmlTable table = {
      {"model", "triangles", "thesis, FPS", "nine coefficients, FPS", "speed-up", "classic, three bands, FPS"}, {}};
  HtmlTable csv = {{"model", "vertices", "triangles", "thesis_fps", "irradiance_fps", "transfer_fps"}, {}};
  std::string renderer;
  double done = 0;
  for (const TableModel& model : models) {
    const FrameRow row = measure_frame_row(model.scene, sources.light(), sources.pick(1, 20));
    renderer = row.gl_renderer;
    const auto triangles = static_cast<double>(row.triangles);
    table.rows.push_back({escape_xml(model.name), format_count(triangles), or_dash(model.thesis, format_count),
                          format_count(row.irradiance),
                          model.thesis > 0 ? format_factor(row.irradiance / model.thesis) : "–",
                          format_count(row.transfer)});
    csv.rows.push_back({model.name, fmt::format("{}", row.vertices), fmt::format("{}", row.triangles),
                        cell(model.thesis), cell(row.irradiance), cell(row.transfer)});
    const std::string name = fmt::format("{}_{}", model.name, row.triangles);
    out.add_time("irradiance_fps_" + name, row.irradiance);
    out.add_time("transfer_fps_" + name, row.transfer);
    report_progress(out.progress(), (done += 1) / static_cast<double>(models.size()));
  }
  out.add_csv("table-4", csv_table(csv));
  out.add_html(html_table(table));
  out.add_html(fmt::format("<p class=\"note\">Drawn by {}, 1440 × 900 pixels.</p>\n", escape_xml(renderer)));
}

}  // namespace

std::vector<PartRecipe> table_recipes() {
  return {{"table-1", "Table 1: coefficients of a light", 6, make_table_1},
          {"table-2", "Table 2: classic transfer", 6, make_table_2},
          {"table-3", "Table 3: BRDFs of 1 024 vertices", 10, make_table_3},
          {"table-4", "Table 4: frames a second", 8, make_table_4}};
}

}  // namespace shlight
