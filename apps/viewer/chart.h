#pragma once

#include <cstddef>
#include <span>
#include <string>

#include <imgui.h>

namespace shlight::viewer {

struct Curve {
  std::span<const double> values;
  ImVec4 color;
};

// Curves over 1, 2, 3, … on a logarithmic axis of values, with the numbers of its decades, as wide as there is room.
// What is not above 0 is left out. `marked` is a place that is pointed out, from 0; -1 for none.
void log_curves(const char* id, std::span<const Curve> curves, float height, int marked);

// Curves over what goes on, the newest at the right, at most `room` values, on an axis from 0 to above the largest one.
// NaN is left out.
void time_curves(const char* id, std::span<const Curve> curves, std::size_t room, float height);

// Bars of either sign over 0, 1, 2, …, which are called `axis`; the value of the one under the pointer is shown.
void bars(const char* id, const char* axis, std::span<const double> values, ImVec4 color, float height, int marked);

}  // namespace shlight::viewer
