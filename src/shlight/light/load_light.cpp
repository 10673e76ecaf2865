#include <fmt/format.h>

#include "shlight/core/error.h"
#include "shlight/image/cube_files.h"
#include "shlight/image/recognise_layout.h"
#include "shlight/light/builtin_light.h"
#include "shlight/light/coefficient_file.h"
#include "shlight/light/formula_light.h"
#include "shlight/light/light.h"

namespace shlight {
namespace {

// A picture from a file, or from the six of a cube.
LoadedImage load_picture(const std::string& path, const LoadLightParams& params) {
  if (params.layout.value_or(Layout::kCube) == Layout::kCube)
    if (const auto files = find_cube_files(path)) return load_cube_files(*files, params.image);
  return load_image(path, params.image);
}

LoadedLight load_image_light(const std::string& path, const LoadLightParams& params) {
  LoadedImage loaded = load_picture(path, params);
  Environment environment{std::move(loaded.image), Layout::kLatLong};
  const int width = environment.image.width, height = environment.image.height;
  auto layout = params.layout ? params.layout : loaded.layout;
  if (!layout) layout = recognise_layout(path, environment.image);
  if (!fits(*layout, environment.size()))
    throw Error(path, fmt::format("{} x {} pixels are no {}", width, height, layout_name(*layout)),
                fmt::format("{} for that layout", shape_name(*layout)));
  environment.layout = *layout;
  clear_unused(environment);

  LightInfo info;
  info.kind = LightInfo::Kind::kImage;
  info.name = path;
  info.layout = layout;
  info.width = width, info.height = height;
  info.pixels = report_pixels(environment.image);
  info.warnings = std::move(loaded.warnings);
  if (info.pixels.nan + info.pixels.inf > 0) repair_pixels(environment.image);
  if (params.clamp) info.clamp = clamp_radiance(environment, *params.clamp);
  return {std::make_unique<ImageLight>(std::move(environment)), std::move(info)};
}

}  // namespace

LoadedLight load_light(const std::string& light, const LoadLightParams& params) {
  const bool picture = !light.starts_with("builtin:") && !light.starts_with("fn:") && !light.ends_with(".json");
  if (params.clamp && !picture) throw Error(light, "cannot be clamped", "a picture");
  if (picture) return load_image_light(light, params);
  LightInfo info;
  info.name = light;
  if (light.starts_with("builtin:")) return {make_builtin_light(light.substr(8)), info};
  if (light.starts_with("fn:")) {
    info.kind = LightInfo::Kind::kFormula;
    return {make_formula_light(light.substr(3)), info};
  }
  auto [coefficients, sun] = load_coefficient_file(light);
  info.kind = LightInfo::Kind::kCoefficients;
  info.bands = coefficients.bands();
  return {std::make_unique<CoefficientLight>(std::move(coefficients), sun), info};
}

}  // namespace shlight
