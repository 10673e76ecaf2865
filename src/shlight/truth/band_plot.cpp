#include "shlight/truth/band_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "shlight/core/assert.h"
#include "shlight/truth/svg.h"

namespace shlight {
namespace {

constexpr double kWidth = 760, kPlotLeft = 70, kPlotRight = 500, kLegendLeft = 524;
constexpr double kErrorTop = 48, kErrorBottom = 318, kEnergyTop = 372, kEnergyBottom = 480, kHeight = 528;

// Of the curves, on top of those that all plots share (svg.h).
constexpr const char* kStyle =
    ".title{font-size:14px;font-weight:bold}"
    ".rms{stroke:#2a7fc9}.p99{stroke:#c9752a}.max{stroke:#c23b5a}.light{stroke:#b58a00}.reflectance{stroke:#3f9a5f}"
    ".local{stroke-dasharray:6 4}.windowed{stroke-width:1.2;stroke-dasharray:2 3}"
    ".tolerance{stroke:#888888;stroke-dasharray:8 3 2 3}";
constexpr const char* kDarkStyle =
    ".rms{stroke:#5aa9ee}.p99{stroke:#ee9d55}.max{stroke:#f0698a}.light{stroke:#e0b83a}.reflectance{stroke:#6cc98c}";

// One curve: a value for each number of bands from 1 on, and how it is drawn and called.
struct Curve {
  std::string style, name;
  std::vector<double> values;
};

// A pair of axes, x over bands, y over the powers of ten from `low` to `high`.
struct Panel {
  double top, bottom;
  int count;      // bands
  int low, high;  // exponents

  double x(double band) const {
    return count == 1 ? (kPlotLeft + kPlotRight) / 2 : std::lerp(kPlotLeft, kPlotRight, (band - 1) / (count - 1));
  }
  double y(double value) const { return std::lerp(bottom, top, (std::log10(value) - low) / (high - low)); }
  double floor() const { return std::pow(10, low); }
};

// The powers of ten around all values, but no more than six of them: what lies lower is drawn at the lower end.
Panel make_panel(double top, double bottom, const std::vector<Curve>& curves) {
  double least = 1e300, most = 0;
  for (const Curve& curve : curves)
    for (const double v : curve.values)
      if (v > 0) least = std::min(least, v), most = std::max(most, v);
  if (!(most > 0)) least = most = 1;
  constexpr int kMostDecades = 6;
  const int high = static_cast<int>(std::ceil(std::log10(most) - 1e-9));
  const int low = std::max(static_cast<int>(std::floor(std::log10(least))), high - kMostDecades);
  return {top, bottom, static_cast<int>(curves[0].values.size()), std::min(low, high - 1), high};
}

std::string draw_axes(const Panel& panel) {
  std::string svg;
  for (int exponent = panel.low; exponent <= panel.high; ++exponent) {
    const double y = panel.y(std::pow(10, exponent));
    svg += svg_line(kPlotLeft, y, kPlotRight, y, "grid");
    svg += svg_text(kPlotLeft - 8, y + 4, "ink", "end", fmt::format("{:g} %", 100 * std::pow(10, exponent)));
  }
  const int step = (panel.count + 15) / 16;
  for (int n = 1; n <= panel.count; n += step) {
    svg += svg_line(panel.x(n), panel.bottom, panel.x(n), panel.bottom + 4, "axis");
    svg += svg_text(panel.x(n), panel.bottom + 18, "ink", "middle", fmt::format("{}", n));
  }
  return svg + fmt::format("<path d=\"M{0:.1f} {1:.1f}V{2:.1f}H{3:.1f}\" class=\"axis\"/>\n", kPlotLeft, panel.top,
                           panel.bottom, kPlotRight);
}

std::string draw_curve(const Panel& panel, const Curve& curve, double legend_y) {
  std::string path;
  for (std::size_t i = 0; i < curve.values.size(); ++i)
    path += fmt::format("{}{:.1f} {:.1f}", i == 0 ? "M" : "L", panel.x(static_cast<double>(i) + 1),
                        panel.y(std::max(curve.values[i], panel.floor())));
  // Round ends make a single point visible.
  std::string svg = fmt::format("<path d=\"{}\" class=\"curve {}\" stroke-linecap=\"round\"/>\n", path, curve.style);
  svg += svg_line(kLegendLeft, legend_y - 4, kLegendLeft + 28, legend_y - 4, "curve " + curve.style);
  return svg + svg_text(kLegendLeft + 36, legend_y, "ink", "start", curve.name);
}

std::string draw_panel(const Panel& panel, const std::vector<Curve>& curves, double legend_y) {
  std::string svg = draw_axes(panel);
  for (const Curve& curve : curves) {
    svg += draw_curve(panel, curve, legend_y);
    legend_y += 19;
  }
  return svg;
}

std::vector<double> values_of(const std::vector<BandError>& errors, double BandError::*measure) {
  std::vector<double> values;
  for (const BandError& error : errors) values.push_back(error.*measure);
  return values;
}

std::vector<double> shares_of(const std::vector<double>& energy, double total) {
  std::vector<double> shares;
  for (const double e : energy) shares.push_back(total > 0 ? e / total : 0);
  return shares;
}

}  // namespace

std::string make_band_plot(const BandErrors& errors, const BandPlotParams& params) {
  SHLIGHT_ASSERT_LT(std::size_t{0}, errors.bands.size());
  std::vector<Curve> curves = {{"rms", "root mean square", values_of(errors.bands, &BandError::rms)},
                               {"p99", "99 % of directions", values_of(errors.bands, &BandError::p99)},
                               {"max", "maximum", values_of(errors.bands, &BandError::max)},
                               {"rms local", "root mean square", values_of(errors.bands, &BandError::rms_local)},
                               {"p99 local", "99 % of directions", values_of(errors.bands, &BandError::p99_local)},
                               {"max local", "maximum", values_of(errors.bands, &BandError::max_local)}};
  if (!errors.shaped.empty()) {
    curves.push_back({"rms windowed", "root mean square", values_of(errors.shaped, &BandError::rms)});
    curves.push_back({"p99 windowed", "99 % of directions", values_of(errors.shaped, &BandError::p99)});
    curves.push_back({"max windowed", "maximum", values_of(errors.shaped, &BandError::max)});
  }
  const Panel panel = make_panel(kErrorTop, kErrorBottom, curves);
  std::string svg = svg_begin(kWidth, kHeight, kStyle, kDarkStyle);
  svg += svg_text(kPlotLeft, 26, "ink title", "start", params.title);
  svg += draw_axes(panel);
  // Three curves a group, each group under its heading.
  const std::string headings[] = {"error, of the largest", "error, of the local", "of the largest, " + params.windowed};
  double y = kErrorTop + 10;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    if (i % 3 == 0) {
      svg += svg_text(kLegendLeft, y, "faint", "start", headings[i / 3]);
      y += 19;
    }
    svg += draw_curve(panel, curves[i], y);
    y += i % 3 == 2 ? 27 : 19;
  }
  if (params.tolerance > panel.floor() && panel.y(params.tolerance) > panel.top) {
    svg += svg_line(kPlotLeft, panel.y(params.tolerance), kPlotRight, panel.y(params.tolerance), "tolerance");
    const auto enough = find_enough_bands(errors.bands, band_measure(params.measure).value, params.tolerance);
    if (enough)
      svg += svg_line(panel.x(*enough), panel.y(params.tolerance), panel.x(*enough), panel.bottom, "tolerance");
    svg += svg_line(kLegendLeft, y - 4, kLegendLeft + 28, y - 4, "tolerance");
    svg += svg_text(kLegendLeft + 36, y, "ink", "start",
                    fmt::format("{:.3g} %: {}", 100 * params.tolerance,
                                enough ? fmt::format("{} bands", *enough) : std::string("not reached")));
    svg += svg_text(kLegendLeft + 36, y + 15, "faint", "start", band_measure(params.measure).meaning);
  }

  const std::vector<Curve> energies = {
      {"light", "light", shares_of(errors.light_energy, errors.light_total)},
      {"reflectance", "reflectance", shares_of(errors.reflectance_energy, errors.reflectance_total)}};
  const Panel energy = make_panel(kEnergyTop, kEnergyBottom, energies);
  svg += svg_text(kPlotRight, kErrorBottom + 36, "faint", "end", "bands n: error with the degrees 0 … n−1");
  svg += svg_text(kLegendLeft, kEnergyTop + 10, "faint", "start", "energy in the n-th band alone");
  svg += draw_panel(energy, energies, kEnergyTop + 29);
  svg += svg_text(kPlotRight, kEnergyBottom + 36, "faint", "end", "band n: degree n−1");
  return svg + "</svg>\n";
}

}  // namespace shlight
