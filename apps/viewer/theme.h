#pragma once

#include <imgui.h>

// What the window looks like: calm greys around the picture, one warm accent, one cool.

namespace shlight::viewer {

inline const ImVec4 kInk = {0.90f, 0.91f, 0.93f, 1}, kFaint = {0.58f, 0.61f, 0.66f, 1};
inline const ImVec4 kAccent = {0.95f, 0.72f, 0.38f, 1}, kCool = {0.45f, 0.72f, 0.85f, 1};
inline const ImVec4 kWarning = {0.96f, 0.52f, 0.42f, 1};

// Sets ImGui's colours, spacing and font, all for controls of this scale. The font is Lato or DejaVu Sans where they
// are installed, else ImGui's own.
void apply_theme(double scale);

// Text of headings.
ImFont* heading_font();

}  // namespace shlight::viewer
