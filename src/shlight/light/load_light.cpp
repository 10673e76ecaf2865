#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "shlight/core/error.h"
#include "shlight/light/builtin_light.h"
#include "shlight/light/coefficient_file.h"
#include "shlight/light/formula_light.h"
#include "shlight/light/light.h"

namespace shlight {
namespace {

std::string layout_names() {
  std::string names;
  for (const Layout layout : all_layouts()) names += (names.empty() ? "" : " or ") + std::string(layout_name(layout));
  return names;
}

// Whether pictures of this layout can be taken yet.
bool is_known(Layout layout) {
  return std::ranges::count(all_layouts(), layout) > 0;
}

// Corners outside of an angular map's circle hold no light, whatever was painted there.
void clear_unused(Environment& environment) {
  if (environment.layout != Layout::kAngularMap) return;
  Image& image = environment.image;
  const auto nearest = [](int i, int size) { return std::abs(2.0 * i + 1 - size) / size - 1.0 / size; };
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (std::hypot(std::max(0.0, nearest(x, image.width)), std::max(0.0, nearest(y, image.height))) >= 1)
        image.set_rgb(x, y, {});
}

LoadedLight load_image_light(const std::string& path, const LoadLightParams& params) {
  LoadedImage loaded = load_image(path, params.image);
  Environment environment{std::move(loaded.image), Layout::kLatLong};
  const int width = environment.image.width, height = environment.image.height;
  auto layout = params.layout;
  if (!layout && loaded.layout && is_known(*loaded.layout)) layout = loaded.layout;
  if (!layout) layout = layout_from_shape(width, height);
  if (!layout)
    throw Error(path, fmt::format("{} x {} pixels tell no layout", width, height),
                "2:1 for lat-long, 1:1 for angular-map, or a layout named with --layout: " + layout_names());
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
  return {std::make_unique<ImageLight>(std::move(environment)), std::move(info)};
}

}  // namespace

LoadedLight load_light(const std::string& light, const LoadLightParams& params) {
  LightInfo info;
  info.name = light;
  if (light.starts_with("builtin:")) return {make_builtin_light(light.substr(8)), info};
  if (light.starts_with("fn:")) {
    info.kind = LightInfo::Kind::kFormula;
    return {make_formula_light(light.substr(3)), info};
  }
  if (!light.ends_with(".json")) return load_image_light(light, params);
  RgbCoefficients coefficients = load_coefficients(light);
  info.kind = LightInfo::Kind::kCoefficients;
  info.bands = coefficients.bands();
  return {std::make_unique<CoefficientLight>(std::move(coefficients)), info};
}

}  // namespace shlight
