// The picture, and what is done with the pointer in it.

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "navigation.h"
#include "panels.h"
#include "shlight/image/tone_map.h"
#include "shlight/truth/heat_map.h"
#include "theme.h"

namespace shlight::viewer {
namespace {

struct Rect {
  ImVec2 min, max;
  float width() const { return max.x - min.x; }
  float height() const { return max.y - min.y; }
};

std::string describe(const Look& look) {
  if (look.show == Show::kNormals) return "normals";
  if (look.show == Show::kVisibility) return "visibility";
  std::string text = to_text(look.method);
  if (look.method == Method::kTransfer || look.method == Method::kReference)
    text = fmt::format("{}, {}", text, to_text(look.transfer));
  if (look.method != Method::kReference) text += fmt::format(", {} band{}", look.bands, look.bands == 1 ? "" : "s");
  if (look.show == Show::kDegree) text += fmt::format(", degree {} alone", look.degree);
  if (look.window != "none") text += ", window " + look.window;
  return text;
}

const ImVec4 kLabel = {0.07f, 0.075f, 0.085f, 0.72f};  // what words on the picture stand on

enum class Corner { kTopLeft, kBottomRight };

// A label on the picture: a name, what goes on, and how far that is; in lines where it is too wide for one. Returns
// where it ends below.
float label(const std::string& text, const Side& side, const Rect& picture, Corner corner, float scale) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const std::string activity = side.activity();
  const float margin = 12 * scale, pad = 8 * scale, gap = activity.empty() ? 0 : 16 * scale;
  const float widest =
      std::max(picture.width() - 2 * margin - 2 * pad, 120 * scale);  // narrower lines are hard to read
  const auto size_of = [&](const std::string& words) {
    return ImGui::CalcTextSize(words.c_str(), nullptr, false, widest);
  };
  const auto write = [&](const std::string& words, ImVec2 at, const ImVec4& color) {
    draw.AddText(nullptr, 0, at, ImGui::GetColorU32(color), words.c_str(), nullptr, widest);
  };
  const ImVec2 name = size_of(text), news = activity.empty() ? ImVec2{} : size_of(activity);
  const bool beside = text.find('\n') == std::string::npos && name.x + gap + news.x <= widest;
  const ImVec2 inside = beside ? ImVec2{name.x + gap + news.x, std::max(name.y, news.y)}
                               : ImVec2{std::max(name.x, news.x), name.y + news.y};
  const ImVec2 size = {inside.x + 2 * pad, inside.y + 1.2f * pad};
  const ImVec2 min = corner == Corner::kTopLeft
                         ? ImVec2{picture.min.x + margin, picture.min.y + margin}
                         : ImVec2{picture.max.x - margin - size.x, picture.max.y - margin - size.y};
  const ImVec2 max = {min.x + size.x, min.y + size.y};
  draw.AddRectFilled(min, max, ImGui::GetColorU32(kLabel), 6 * scale);
  const ImVec2 first = {min.x + pad, min.y + 0.6f * pad};
  write(text, first, kInk);
  if (activity.empty()) return max.y;
  write(activity, beside ? ImVec2{first.x + name.x + gap, first.y} : ImVec2{first.x, first.y + name.y}, kAccent);
  const float filled = inside.x * static_cast<float>(std::clamp(side.fraction(), 0.0, 1.0));
  draw.AddRectFilled({min.x + pad, max.y - 3 * scale}, {min.x + pad + filled, max.y - 1.5f * scale},
                     ImGui::GetColorU32(kAccent));
  return max.y;
}

// Returns where the label at the top ends.
float draw_pictures(const Studio& studio, const Rect& rect, float scale) {
  const Settings& s = studio.settings;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const auto picture = [&](int which, float from, float to) {
    const Side& side = studio.side(which);
    if (!side.has_picture() || to <= from) return;
    draw.AddImage(id_of(side.picture().target->texture()), {rect.min.x + from * rect.width(), rect.min.y},
                  {rect.min.x + to * rect.width(), rect.max.y}, {from, 1}, {to, 0});
  };
  if (s.compare == Compare::kOne) {
    picture(s.side, 0, 1);
    return label(describe(s.look()), studio.side(s.side), rect, Corner::kTopLeft, scale);
  }
  const auto divider = static_cast<float>(s.divider);
  picture(0, 0, divider);
  picture(1, divider, 1);
  const float x = std::round(rect.min.x + divider * rect.width()), y = 0.5f * (rect.min.y + rect.max.y);
  draw.AddLine({x, rect.min.y}, {x, rect.max.y}, ImGui::GetColorU32({1, 1, 1, 0.75f}), 1.5f * scale);
  draw.AddCircleFilled({x, y}, 7 * scale, ImGui::GetColorU32({1, 1, 1, 0.9f}), 24);
  draw.AddCircleFilled({x, y}, 3 * scale, ImGui::GetColorU32(kAccent), 16);
  label("B  " + describe(s.looks[1]), studio.side(1), rect, Corner::kBottomRight, scale);
  return label("A  " + describe(s.looks[0]), studio.side(0), rect, Corner::kTopLeft, scale);
}

ImU32 heat(double t) {
  const Rgb linear = heat_color(t);
  const auto byte = [](double v) { return static_cast<int>(std::lround(255 * std::clamp(encode_srgb(v), 0.0, 1.0))); };
  return IM_COL32(byte(linear.r), byte(linear.g), byte(linear.b), 255);
}

// What the colours of the map mean, from 0 to `largest`, in the corner at the bottom right.
void heat_scale(double largest, const Rect& picture, float scale) {
  constexpr int kSteps = 4, kPieces = 32;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float margin = 12 * scale, pad = 10 * scale, bar = 10 * scale, tick = 4 * scale;
  const float line = ImGui::GetTextLineHeight(), numbers = ImGui::CalcTextSize("0.000").x;
  const float height = std::min(180 * scale, picture.height() - 2 * margin - 2 * pad);
  if (height < 3 * line) return;
  const ImVec2 max = {picture.max.x - margin, picture.max.y - margin};
  const ImVec2 min = {max.x - 2 * pad - bar - 2 * tick - numbers, max.y - 2 * pad - height};
  draw.AddRectFilled(min, max, ImGui::GetColorU32(kLabel), 6 * scale);
  const float left = min.x + pad, bottom = max.y - pad - 0.5f * line, length = height - line;
  for (int i = 0; i < kPieces; ++i) {
    const auto y_of = [&](int piece) { return bottom - length * static_cast<float>(piece) / kPieces; };
    const ImU32 low = heat(static_cast<double>(i) / kPieces), high = heat((i + 1.0) / kPieces);
    draw.AddRectFilledMultiColor({left, y_of(i + 1)}, {left + bar, y_of(i)}, high, high, low, low);
  }
  for (int i = 0; i <= kSteps; ++i) {
    const float y = bottom - length * static_cast<float>(i) / kSteps;
    draw.AddLine({left + bar, y}, {left + bar + tick, y}, ImGui::GetColorU32(kFaint));
    draw.AddText({left + bar + 2 * tick, y - 0.5f * line}, ImGui::GetColorU32(kInk),
                 fmt::format("{:.2g}", largest * i / kSteps).c_str());
  }
}

// The same. The map lies where the pictures are.
float draw_difference(const Studio& studio, const Rect& rect, float scale) {
  const Settings& s = studio.settings;
  const Difference::Result& result = *studio.difference().result();
  const PictureTexture& map = *studio.difference().texture();
  const ImageError& e = result.error;
  // Beside the map the texture has a scale of pictures' small letters.
  const ImVec2 end = {static_cast<float>(result.width) / static_cast<float>(map.width()),
                      static_cast<float>(result.height) / static_cast<float>(map.height())};
  ImGui::GetWindowDrawList()->AddImage(id_of(map.texture()), rect.min, rect.max, {0, 0}, end);
  heat_scale(result.largest, rect, scale);
  return label(fmt::format("A  {}\nB  {}\nFLIP {:.4f}   off by {:.3g} % (root mean square)   SSIM {:.4f}",
                           describe(s.looks[0]), describe(s.looks[1]), e.flip, 100 * e.relative, e.ssim),
               studio.side(1), rect, Corner::kTopLeft, scale);
}

// A ring around the vertex whose transfer is told.
void mark_vertex(const Studio& studio, Vec3d position, const Rect& rect, float scale) {
  const View view =
      make_view(studio.settings.camera, studio.subject().model->extent, rect.width() / std::max(rect.height(), 1.0f));
  const auto place = place_in_picture(view, position);
  if (!place || std::abs(place->x) > 1 || std::abs(place->y) > 1) return;
  const ImVec2 at = {rect.min.x + static_cast<float>(0.5 + 0.5 * place->x) * rect.width(),
                     rect.min.y + static_cast<float>(0.5 - 0.5 * place->y) * rect.height()};
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddCircle(at, 5 * scale, ImGui::GetColorU32({0, 0, 0, 0.6f}), 20, 4 * scale);
  draw.AddCircle(at, 5 * scale, ImGui::GetColorU32(kCool), 20, 2 * scale);
}

void navigate(Studio& studio, const Rect& rect, float scale) {
  Settings& s = studio.settings;
  const ImGuiIO& io = ImGui::GetIO();
  ImGui::SetCursorScreenPos(rect.min);
  ImGui::InvisibleButton(
      "picture", {std::max(rect.width(), 1.0f), std::max(rect.height(), 1.0f)},
      ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight | ImGuiButtonFlags_MouseButtonMiddle);
  ImGui::SetItemAllowOverlap();
  const float divider = rect.min.x + static_cast<float>(s.divider) * rect.width();
  const bool at_divider = s.compare == Compare::kSplit && std::abs(io.MousePos.x - divider) < 9 * scale;
  if (ImGui::IsItemHovered()) {
    if (at_divider) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    if (io.MouseWheel != 0) zoom(s, io.MouseWheel);
  }
  bool& dragging_divider = *ImGui::GetStateStorage()->GetBoolRef(ImGui::GetID("divider"));
  if (ImGui::IsItemActivated()) dragging_divider = at_divider && io.MouseDown[0];
  if (!ImGui::IsItemActive()) return;
  if (dragging_divider) {
    s.divider = std::clamp((io.MousePos.x - rect.min.x) / std::max(rect.width(), 1.0f), 0.0f, 1.0f);
    return;
  }
  const double right = io.MouseDelta.x / std::max(rect.height(), 1.0f),
               up = -io.MouseDelta.y / std::max(rect.height(), 1.0f);
  if (right == 0 && up == 0) return;
  if (io.MouseDown[1])
    turn_light(s, right, up);
  else if (studio.ready() && (io.MouseDown[2] || io.KeyShift))
    pan(s, studio.subject().model->extent, rect.width() / std::max(rect.height(), 1.0f), right, up);
  else
    orbit(s, right, up);
}

}  // namespace

void viewport(Studio& studio, const std::optional<Insight::AtPointer>& at_pointer, const Layout& layout) {
  const Rect rect = {{layout.left, 0}, {layout.width - layout.right, layout.height}};
  ImGui::SetNextWindowPos(rect.min);
  ImGui::SetNextWindowSize({std::max(rect.width(), 1.0f), std::max(rect.height(), 1.0f)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2{0, 0});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2{1, 1});
  ImGui::Begin("viewport", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoBackground |
                   ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoScrollWithMouse);
  ImGui::PopStyleVar(2);
  navigate(studio, rect, layout.scale);
  float top = rect.min.y;
  if (studio.settings.compare == Compare::kDifference && studio.difference_fits())
    top = draw_difference(studio, rect, layout.scale);
  else if (studio.ready())
    top = draw_pictures(studio, rect, layout.scale);
  if (at_pointer) mark_vertex(studio, at_pointer->picked.position, rect, layout.scale);
  if (studio.side(studio.settings.side).can_cancel()) {
    ImGui::SetCursorScreenPos({rect.min.x + 12 * layout.scale, top + 6 * layout.scale});
    if (ImGui::SmallButton("stop")) studio.side(studio.settings.side).cancel();
    hint("Keeps what there is so far");
  }
  ImGui::End();
}

}  // namespace shlight::viewer
