#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace shlight {

struct PlotCurve {
  std::string name;                           // empty: not in the legend
  std::vector<std::array<double, 2>> points;  // x, y
  bool line = true, dots = false;
};

struct PlotAxis {
  double low = 0, high = 1;
  std::vector<std::pair<double, std::string>> ticks;
  std::string label;
};

// Up to six curves over a grid, with a legend below: an SVG picture, narrow enough for a phone. What lies outside of
// the axes is drawn at their ends. Not installed.
std::string make_line_plot(const PlotAxis& x, const PlotAxis& y, const std::vector<PlotCurve>& curves);

// The ticks at every multiple of `step` within [low, high].
PlotAxis make_axis(double low, double high, double step, std::string label);

}  // namespace shlight
