#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <vector>

#include "command.h"
#include "shlight/light/window_name.h"

namespace shlight::app {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

// Comma-separated finite numbers; nothing where the text is anything else.
std::optional<std::vector<double>> parse_numbers(const std::string& text) {
  std::vector<double> numbers;
  for (const std::string& part : CLI::detail::split(text, ',')) {
    double value = 0;
    if (!CLI::detail::lexical_cast(part, value) || !std::isfinite(value)) return {};
    numbers.push_back(value);
  }
  return numbers;
}

// Three numbers are angles about z, y and z, four a quaternion, nine the rows of a matrix.
std::optional<Rotation> parse_rotation(const std::string& text) {
  const auto n = parse_numbers(text).value_or(std::vector<double>());
  if (n.size() == 3) return rotation_zyz(n[0] * kDegree, n[1] * kDegree, n[2] * kDegree);
  if (n.size() == 4 && n[0] * n[0] + n[1] * n[1] + n[2] * n[2] + n[3] * n[3] > 1e-12)
    return rotation_from_quaternion(n[0], n[1], n[2], n[3]);
  if (n.size() == 9) {
    const Rotation rotation = {{Vec3d{n[0], n[1], n[2]}, Vec3d{n[3], n[4], n[5]}, Vec3d{n[6], n[7], n[8]}}};
    if (is_rotation(rotation, 1e-4)) return rotation;
  }
  return {};
}

// Azimuth and elevation in degrees, as the built-in sky takes them.
struct Angles {
  double azimuth, elevation;
};
Angles angles_of(Vec3d d) {
  return {std::atan2(d.x, -d.z) / kDegree, std::asin(std::clamp(d.y, -1.0, 1.0)) / kDegree};
}

}  // namespace

std::string describe_sun(const Sun& sun, Rgb all) {
  const auto [azimuth, elevation] = angles_of(sun.direction);
  return fmt::format("azimuth {:.2f}, elevation {:.2f} degrees, irradiance {:.4g} {:.4g} {:.4g}, {:.1f} % of the light",
                     azimuth, elevation, sun.irradiance.r, sun.irradiance.g, sun.irradiance.b,
                     100 * luminance(sun.irradiance) / luminance(all));
}

nlohmann::ordered_json json_of_sun(const Sun& sun, Rgb all) {
  const auto [azimuth, elevation] = angles_of(sun.direction);
  return {{"direction", {sun.direction.x, sun.direction.y, sun.direction.z}},
          {"azimuth", azimuth},
          {"elevation", elevation},
          {"irradiance", {sun.irradiance.r, sun.irradiance.g, sun.irradiance.b}},
          {"share", luminance(sun.irradiance) / luminance(all)}};
}

void add_shape_options(CLI::App& command, LightShape& shape) {
  command
      .add_option_function<std::string>(
          "--rotate",
          [&shape](const std::string& text) {
            const auto rotation = parse_rotation(text);
            if (!rotation)
              throw CLI::ValidationError("--rotate",
                                         "'" + text +
                                             "' is no rotation: three angles in degrees about z, "
                                             "y and z (the last one first), a quaternion w,x,y,z, or the nine "
                                             "numbers of a rotation matrix, row by row");
            shape.rotation = *rotation;
          },
          "Turn the light: angles about z, y, z in degrees, a quaternion, or a matrix")
      ->type_name("Z,Y,Z|W,X,Y,Z|9 NUMBERS");
  add_window_option(command, shape);
}

void add_window_option(CLI::App& command, LightShape& shape) {
  command
      .add_option(
          "--window", shape.window,
          "Smooth the coefficients against ringing: auto does just enough for irradiance to be nowhere negative, "
          "auto-radiance for radiance")
      ->capture_default_str()
      ->type_name(kWindowNames)
      ->check(CLI::Validator(
          [](std::string& text) {
            return is_window_name(text)
                       ? ""
                       : "'" + text +
                             "' is no window: none, auto, auto-radiance, hann:6 and lanczos:6 (the first degree "
                             "taken away), or laplacian:0.01";
          },
          ""));
}

RgbCoefficients apply_window(const LightShape& shape, const RgbCoefficients& coefficients) {
  const auto [windowed, automatic] = apply_named_window(shape.window, coefficients);
  if (!automatic) return windowed;
  spdlog::info(
      "window {}: {}, {} certified to be at least {:.3g} everywhere, {:.1f} % of the contrast kept", shape.window,
      automatic->strength == 0 ? "nothing to do" : fmt::format("laplacian:{:.4g}", automatic->strength),
      shape.window == "auto" ? "irradiance" : "radiance", automatic->lower_bound, 100 * automatic->contrast_kept);
  return windowed;
}

}  // namespace shlight::app
