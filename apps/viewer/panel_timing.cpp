// How long frames take.

#include <fmt/format.h>
#include <imgui.h>

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

void curves(const FrameTimes& times, float scale) {
  // Of the pictures, what is known best of how long the card takes.
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> totals, pictures;
  for (const FrameTimes::Frame& frame : times.kept()) {
    totals.push_back(frame.total_ms);
    pictures.push_back(frame.gpu_ms ? *frame.gpu_ms : frame.picture_ms.value_or(kNone));
  }
  const std::vector<Curve> both = {{totals, kCool}, {pictures, kAccent}};
  time_curves("##frames", both, kShownFrames, 84 * scale);
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
  if (s.max.gpu_ms) row("GPU", kAccent, s.median.gpu_ms, s.p99.gpu_ms, s.max.gpu_ms);
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
