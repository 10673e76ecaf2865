#include "shlight/light/window_name.h"

#include <charconv>
#include <cmath>

#include "shlight/core/error.h"

namespace shlight {
namespace {

struct FixedWindow {
  Window window;
  double strength;
};

// "hann:6", "lanczos:6", "laplacian:0.01".
std::optional<FixedWindow> parse_fixed(std::string_view text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string_view::npos) return {};
  const std::string_view name = text.substr(0, colon), number = text.substr(colon + 1);
  double value = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
  if (error != std::errc() || end != number.data() + number.size() || !(value > 0) || !std::isfinite(value)) return {};
  if (name == "hann") return FixedWindow{Window::kHann, 1 / value};
  if (name == "lanczos") return FixedWindow{Window::kLanczos, 1 / value};
  if (name == "laplacian") return FixedWindow{Window::kLaplacian, value};
  return {};
}

}  // namespace

bool is_window_name(std::string_view name) {
  return name == "none" || name == "auto" || name == "auto-radiance" || parse_fixed(name).has_value();
}

NamedWindowResult apply_named_window(std::string_view name, const RgbCoefficients& coefficients) {
  if (name == "none") return {coefficients, {}};
  if (const auto fixed = parse_fixed(name)) return {apply_window(fixed->window, fixed->strength, coefficients), {}};
  if (name != "auto" && name != "auto-radiance") throw Error(name, "is no window", kWindowNames);
  const Positive positive = name == "auto" ? Positive::kIrradiance : Positive::kRadiance;
  AutoWindow result = make_auto_window(Window::kLaplacian, positive, coefficients);
  return {result.coefficients, result};
}

}  // namespace shlight
