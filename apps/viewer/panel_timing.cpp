// How long frames take.

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "chart.h"
#include "panels.h"
#include "theme.h"

namespace shlight::viewer {
namespace {

std::string bytes_text(std::size_t bytes) {
  if (bytes < 10'000) return fmt::format("{} bytes", bytes);
  return bytes < 10'000'000 ? fmt::format("{:.0f} kB", 1e-3 * static_cast<double>(bytes))
                            : fmt::format("{:.0f} MB", 1e-6 * static_cast<double>(bytes));
}

// Pictures are drawn beside frames and have their own pace.
void curves(const FrameTimes& times, float scale) {
  constexpr std::size_t kShownPictures = 60;
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> totals, pictures, gpu;
  for (const FrameTimes::Frame& frame : times.kept()) {
    totals.push_back(frame.total_ms);
    if (!frame.picture_ms) continue;
    pictures.push_back(*frame.picture_ms);
    gpu.push_back(frame.gpu_ms.value_or(kNone));
  }
  const auto newest = static_cast<std::ptrdiff_t>(std::min(pictures.size(), kShownPictures));
  pictures.erase(pictures.begin(), pictures.end() - newest);
  gpu.erase(gpu.begin(), gpu.end() - newest);
  const std::vector<Curve> frames = {{totals, kCool}}, drawn = {{gpu, kInk}, {pictures, kAccent}};
  time_curves("##frames", frames, kShownFrames, 76 * scale);
  time_curves("##pictures", drawn, kShownPictures, 76 * scale);
}

void row(const char* name, ImVec4 color, std::optional<double> median, std::optional<double> p99,
         std::optional<double> max) {
  ImGui::TableNextColumn();
  ImGui::TextColored(color, "%s", name);
  for (const auto& value : {median, p99, max}) {
    ImGui::TableNextColumn();
    if (value)
      ImGui::Text("%.2f", *value);
    else
      ImGui::TextDisabled("-");
  }
}

void table(const FrameTimes::Summary& s) {
  if (!ImGui::BeginTable("times", 4, ImGuiTableFlags_SizingStretchProp)) return;
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch, 1.4f);
  for (int i = 0; i < 3; ++i) ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch, 1);
  for (const char* title : {"ms", "median", "99 %", "most"}) {
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%s", title);
  }
  row("frame", kCool, s.median.total_ms, s.p99.total_ms, s.max.total_ms);
  row("picture", kAccent, s.median.picture_ms, s.p99.picture_ms, s.max.picture_ms);
  if (s.max.gpu_ms) row("GPU", kInk, s.median.gpu_ms, s.p99.gpu_ms, s.max.gpu_ms);
  row("not drawn", kFaint, s.median.own_ms, s.p99.own_ms, s.max.own_ms);
  ImGui::EndTable();
}

}  // namespace

void timing_panel(const Studio& studio, const FrameTimes& times, const Layout& layout) {
  // Below the picture's label where there is no room beside it.
  const float top = layout.picture_width() < 700 * layout.scale ? 56 : 16;
  begin_overlay("timing", {layout.left + layout.picture_width() - 16 * layout.scale, top * layout.scale}, {1, 0});
  ImGui::PushFont(heading_font());
  ImGui::TextUnformatted("Frames");
  ImGui::PopFont();
  ImGui::Dummy({250 * layout.scale, 0});
  curves(times, layout.scale);
  const FrameTimes::Summary summary = times.summary();
  table(summary);
  if (summary.max.picture_ms && !summary.max.gpu_ms) ImGui::TextDisabled("this driver does not tell the GPU's times");
  if (studio.ready()) {
    ImGui::TextDisabled("%zu triangles, %zu vertices", studio.subject().model->triangles,
                        studio.subject().model->vertices);
    ImGui::TextDisabled("%s for the method, %d x %d pixels",
                        bytes_text(studio.side(studio.settings.side).picture().bytes).c_str(), studio.width(),
                        studio.height());
  }
  ImGui::End();
}

}  // namespace shlight::viewer
