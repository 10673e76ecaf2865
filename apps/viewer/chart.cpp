#include "chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "theme.h"

namespace shlight::viewer {
namespace {

ImU32 packed(ImVec4 color, float alpha = 1) {
  color.w *= alpha;
  return ImGui::ColorConvertFloat4ToU32(color);
}

struct Area {
  ImVec2 min, max;
  float width() const { return max.x - min.x; }
  float height() const { return max.y - min.y; }
};

// Takes room for a chart, with its page; what is left of it is written into.
Area begin_chart(const char* id, float height) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const ImVec2 size = {std::max(ImGui::GetContentRegionAvail().x, 40.0f), height};
  ImGui::InvisibleButton(id, size);
  const Area area = {at, {at.x + size.x, at.y + size.y}};
  ImGui::GetWindowDrawList()->AddRectFilled(area.min, area.max, packed({0, 0, 0, 0.22f}),
                                            ImGui::GetStyle().FrameRounding);
  return area;
}

void write(ImVec2 at, ImVec4 color, const std::string& text) {
  ImGui::GetWindowDrawList()->AddText(at, packed(color), text.c_str());
}

}  // namespace

void log_curves(const char* id, std::span<const Curve> curves, float height, int marked) {
  const Area all = begin_chart(id, height);
  double low = 1e300, high = 0;
  std::size_t count = 1;
  for (const Curve& curve : curves)
    for (const double v : curve.values)
      if (v > 0) low = std::min(low, v), high = std::max(high, v);
  for (const Curve& curve : curves) count = std::max(count, curve.values.size());
  if (high == 0) return;
  // Whole decades, at least two and at most eight.
  const int top = static_cast<int>(std::ceil(std::log10(high)));
  const int bottom = std::clamp(static_cast<int>(std::floor(std::log10(low))), top - 8, top - 2);

  const float line = ImGui::GetTextLineHeight(), left = 3.4f * line;
  const Area area = {{all.min.x + left, all.min.y + 0.5f * line}, {all.max.x - 0.6f * line, all.max.y - 1.35f * line}};
  const auto x_of = [&](std::size_t i) {
    return count == 1 ? area.min.x : area.min.x + area.width() * static_cast<float>(i) / static_cast<float>(count - 1);
  };
  const auto y_of = [&](double v) {
    const double t = (std::log10(v) - bottom) / (top - bottom);
    return area.max.y - area.height() * static_cast<float>(std::clamp(t, 0.0, 1.0));
  };
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const int step = top - bottom > 4 ? 2 : 1;
  for (int decade = bottom; decade <= top; decade += step) {
    const float y = y_of(std::pow(10.0, decade));
    draw.AddLine({area.min.x, y}, {area.max.x, y}, packed({1, 1, 1, 0.07f}));
    const std::string text = decade >= -5 && decade <= 1 ? fmt::format("{:g} %", std::pow(10.0, decade + 2))
                                                         : fmt::format("1e{} %", decade + 2);
    write({area.min.x - ImGui::CalcTextSize(text.c_str()).x - 0.35f * line, y - 0.5f * line}, kFaint, text);
  }
  for (std::size_t i = 0; i < count; ++i) {
    const std::string text = std::to_string(i + 1);
    const bool is_marked = static_cast<int>(i) == marked;
    write({x_of(i) - 0.5f * ImGui::CalcTextSize(text.c_str()).x, area.max.y + 0.2f * line},
          is_marked ? kAccent : kFaint, text);
    if (is_marked) draw.AddLine({x_of(i), area.min.y}, {x_of(i), area.max.y}, packed(kAccent, 0.35f));
  }
  for (const Curve& curve : curves) {
    for (std::size_t i = 0; i < curve.values.size(); ++i) {
      if (!(curve.values[i] > 0)) continue;
      const ImVec2 at = {x_of(i), y_of(curve.values[i])};
      if (i > 0 && curve.values[i - 1] > 0)
        draw.AddLine({x_of(i - 1), y_of(curve.values[i - 1])}, at, packed(curve.color), 1.8f);
      draw.AddCircleFilled(at, 0.17f * line, packed(curve.color));
    }
  }
}

void time_curves(const char* id, std::span<const Curve> curves, std::size_t room, float height) {
  const Area all = begin_chart(id, height);
  const float line = ImGui::GetTextLineHeight();
  const Area area = {{all.min.x + 2.2f * line, all.min.y + 0.5f * line},
                     {all.max.x - 0.4f * line, all.max.y - 0.6f * line}};
  double high = 10;
  for (const Curve& curve : curves)
    for (const double v : curve.values)
      if (v > high) high = v;
  // Two to five lines, a round number apart.
  double step = std::pow(10, std::floor(std::log10(high / 2)));
  for (const double factor : {2.5, 2.0}) step *= high / step > 5 ? factor : 1;
  const auto y_of = [&](double v) { return area.max.y - area.height() * static_cast<float>(v / high); };
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  for (double v = 0; v <= high; v += step) {
    draw.AddLine({area.min.x, y_of(v)}, {area.max.x, y_of(v)}, packed({1, 1, 1, 0.07f}));
    const std::string text = fmt::format("{:g}", v);
    write({area.min.x - ImGui::CalcTextSize(text.c_str()).x - 0.35f * line, y_of(v) - 0.5f * line}, kFaint, text);
  }
  for (const Curve& curve : curves) {
    const std::size_t count = curve.values.size();
    const auto at = [&](std::size_t i) {
      const auto from_right =
          static_cast<float>(count - 1 - i) / static_cast<float>(std::max<std::size_t>(room, 2) - 1);
      return ImVec2{area.max.x - from_right * area.width(), y_of(curve.values[i])};
    };
    for (std::size_t i = 1; i < count; ++i)
      if (!std::isnan(curve.values[i - 1]) && !std::isnan(curve.values[i]))
        draw.AddLine(at(i - 1), at(i), packed(curve.color), 1.4f);
  }
}

void bars(const char* id, const char* axis, std::span<const double> values, ImVec4 color, float height, int marked) {
  const Area all = begin_chart(id, height);
  if (values.empty()) return;
  double low = 0, high = 0;
  for (const double v : values) low = std::min(low, v), high = std::max(high, v);
  if (high == low) return;
  const float line = ImGui::GetTextLineHeight();
  const Area area = {{all.min.x + 0.5f * line, all.min.y + 0.5f * line},
                     {all.max.x - 0.5f * line, all.max.y - 1.35f * line}};
  const auto y_of = [&](double v) { return area.max.y - area.height() * static_cast<float>((v - low) / (high - low)); };
  const float step = area.width() / static_cast<float>(values.size());
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddLine({area.min.x, y_of(0)}, {area.max.x, y_of(0)}, packed({1, 1, 1, 0.12f}));
  for (std::size_t i = 0; i < values.size(); ++i) {
    const float x = area.min.x + step * static_cast<float>(i);
    const bool is_marked = static_cast<int>(i) == marked;
    const float zero = y_of(0), y = y_of(values[i]);
    draw.AddRectFilled({x + 0.18f * step, std::min(zero, y)}, {x + 0.82f * step, std::max(zero, y) + 1},
                       packed(color, is_marked ? 1.0f : 0.7f), 2);
    const std::string text = std::to_string(i);
    if (step > 1.2f * line || (i % 5 == 0 && values.size() > 12))
      write({x + 0.5f * (step - ImGui::CalcTextSize(text.c_str()).x), area.max.y + 0.2f * line},
            is_marked ? kAccent : kFaint, text);
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    if (ImGui::IsItemHovered() && mouse.x >= x && mouse.x < x + step)
      ImGui::SetTooltip("%s %zu: %.4g", axis, i, values[i]);
  }
}

}  // namespace shlight::viewer
