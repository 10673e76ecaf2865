#include "shlight/report/line_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "shlight/core/assert.h"
#include "shlight/truth/svg.h"

namespace shlight {
namespace {

constexpr double kWidth = 480, kLeft = 58, kRight = 464, kTop = 26, kBottom = 270;
constexpr double kLegendLine = 20;

constexpr const char* kStyle =
    "text{font-size:13px}.dot{stroke-width:1}"
    ".c0{stroke:#2a7fc9}.c1{stroke:#c9752a}.c2{stroke:#3f9a5f}.c3{stroke:#c23b5a}.c4{stroke:#7a5cc0}.c5{stroke:#b58a00}"
    ".dot.c0{fill:#2a7fc9}.dot.c1{fill:#c9752a}.dot.c2{fill:#3f9a5f}.dot.c3{fill:#c23b5a}.dot.c4{fill:#7a5cc0}"
    ".dot.c5{fill:#b58a00}";
constexpr const char* kDarkStyle =
    ".c0{stroke:#5aa9ee}.c1{stroke:#ee9d55}.c2{stroke:#6cc98c}.c3{stroke:#f0698a}.c4{stroke:#ab92f0}.c5{stroke:#e0b83a}"
    ".dot.c0{fill:#5aa9ee}.dot.c1{fill:#ee9d55}.dot.c2{fill:#6cc98c}.dot.c3{fill:#f0698a}.dot.c4{fill:#ab92f0}"
    ".dot.c5{fill:#e0b83a}";

double place(const PlotAxis& axis, double value, double from, double to) {
  return std::lerp(from, to, std::clamp((value - axis.low) / (axis.high - axis.low), 0.0, 1.0));
}
double place_x(const PlotAxis& x, double value) {
  return place(x, value, kLeft, kRight);
}
double place_y(const PlotAxis& y, double value) {
  return place(y, value, kBottom, kTop);
}

std::string draw_axes(const PlotAxis& x, const PlotAxis& y) {
  std::string svg;
  for (const auto& [value, label] : y.ticks) {
    svg += svg_line(kLeft, place_y(y, value), kRight, place_y(y, value), "grid");
    svg += svg_text(kLeft - 8, place_y(y, value) + 4, "ink", "end", label);
  }
  for (const auto& [value, label] : x.ticks) {
    svg += svg_line(place_x(x, value), kBottom, place_x(x, value), kBottom + 4, "axis");
    svg += svg_text(place_x(x, value), kBottom + 18, "ink", "middle", label);
  }
  svg += fmt::format("<path d=\"M{0} {1}V{2}H{3}\" class=\"axis\"/>\n", kLeft, kTop, kBottom, kRight);
  svg += svg_text(kLeft, kTop - 10, "faint", "start", y.label);
  return svg + svg_text(kRight, kBottom + 36, "faint", "end", x.label);
}

std::string draw_dot(double x, double y, const std::string& color) {
  return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\" class=\"dot {}\"/>\n", x, y, color);
}

}  // namespace

PlotAxis make_axis(double low, double high, double step, std::string label) {
  PlotAxis axis = {low, high, {}, std::move(label)};
  for (double k = std::ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k)
    axis.ticks.emplace_back(k * step, fmt::format("{:g}", k * step + 0.0));
  return axis;
}

std::string make_line_plot(const PlotAxis& x, const PlotAxis& y, const std::vector<PlotCurve>& curves) {
  SHLIGHT_ASSERT_LE(curves.size(), std::size_t{6});
  const auto named = std::ranges::count_if(curves, [](const PlotCurve& curve) { return !curve.name.empty(); });
  const bool long_names = std::ranges::any_of(curves, [](const PlotCurve& curve) { return curve.name.size() > 14; });
  const int columns = long_names ? 2 : 3;
  const double legend_top = kBottom + 58;
  const double height = legend_top + kLegendLine * std::ceil(static_cast<double>(named) / columns) - 6;
  std::string svg = svg_begin(kWidth, height, kStyle, kDarkStyle) + draw_axes(x, y);
  int entry = 0;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const PlotCurve& curve = curves[i];
    const std::string color = fmt::format("c{}", i);
    std::string path;
    for (const auto& [px, py] : curve.points) {
      path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", place_x(x, px), place_y(y, py));
      if (curve.dots) svg += draw_dot(place_x(x, px), place_y(y, py), color);
    }
    if (curve.line) svg += fmt::format("<path d=\"{}\" class=\"curve {}\"/>\n", path, color);
    if (curve.name.empty()) continue;
    const double left = kLeft + (kRight - kLeft) / columns * (entry % columns);
    const double top = legend_top + kLegendLine * static_cast<double>(entry / columns);
    svg += curve.line ? svg_line(left, top - 4, left + 22, top - 4, "curve " + color)
                      : draw_dot(left + 11, top - 4, color);
    svg += svg_text(left + 28, top, "ink", "start", curve.name);
    ++entry;
  }
  return svg + "</svg>\n";
}

}  // namespace shlight
