#pragma once

#include <optional>
#include <string_view>

#include "shlight/sh/window.h"

// Windows (sh/window.h) by name, as command lines and files have them.

namespace shlight {

// "none"; "auto" and "auto-radiance", the least Laplacian window for which irradiance or radiance is nowhere negative;
// "hann:6" and "lanczos:6" with the first degree taken away; "laplacian:0.01" with its λ.
inline constexpr const char* kWindowNames = "none|auto|auto-radiance|hann:W|lanczos:W|laplacian:LAMBDA";
bool is_window_name(std::string_view name);

struct NamedWindowResult {
  RgbCoefficients coefficients;         // windowed
  std::optional<AutoWindow> automatic;  // what an automatic one did
};
// Throws Error where is_window_name is false.
NamedWindowResult apply_named_window(std::string_view name, const RgbCoefficients& coefficients);

}  // namespace shlight
