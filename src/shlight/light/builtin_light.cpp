#include "shlight/light/builtin_light.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

#include "shlight/core/error.h"

namespace shlight {
namespace {

using std::numbers::pi;

constexpr double kDegree = pi / 180;
constexpr const char* kAccepted =
    "builtin:sky, builtin:sky:elevation=0…90,azimuth=…,turbidity=1.7…10,ground=0…1, builtin:studio, "
    "builtin:panel:azimuth=…,elevation=…,width=…,height=…,radiance=…,background=…, builtin:axes or builtin:thesis";

Vec3d direction_from(double azimuth_degrees, double elevation_degrees) {
  const double a = azimuth_degrees * kDegree, e = elevation_degrees * kDegree;
  return {std::cos(e) * std::sin(a), std::sin(e), -std::cos(e) * std::cos(a)};
}

double smoothstep(double low, double high, double v) {
  const double t = std::clamp((v - low) / (high - low), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

// A soft box seen from the origin: a rectangle on the plane at distance 1 before `axis`, with soft edges.
struct SoftBox {
  Vec3d axis, right, up;
  double half_width, half_height;  // on that plane
  Rgb radiance;

  SoftBox(double azimuth, double elevation, double width_degrees, double height_degrees, Rgb rgb)
      : axis(direction_from(azimuth, elevation)),
        right(direction_from(azimuth + 90, 0)),
        up(cross(right, axis)),
        half_width(std::tan(0.5 * width_degrees * kDegree)),
        half_height(std::tan(0.5 * height_degrees * kDegree)),
        radiance(rgb) {}

  Rgb operator()(Vec3d d) const {
    const double forward = dot(d, axis);
    if (forward <= 0.05) return {};
    const double across = std::abs(dot(d, right)) / forward / half_width;
    const double along = std::abs(dot(d, up)) / forward / half_height;
    // Brightest in the middle, as a lamp behind cloth is.
    const double falloff = 1 - 0.35 * std::min(1.0, (across * across + along * along) / 2);
    return smoothstep(1.06, 0.94, across) * smoothstep(1.06, 0.94, along) * falloff * radiance;
  }
};

// Parses "key=value,key=value" into the named numbers.
struct NamedNumber {
  const char* name;
  double* value;
  double min, max;
};
void parse_parameters(const std::string& text, std::initializer_list<NamedNumber> numbers) {
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string part = text.substr(begin, end - begin);
    begin = end + 1;
    const std::size_t equals = std::min(part.find('='), part.size());
    const auto number = std::find_if(numbers.begin(), numbers.end(),
                                     [&](const NamedNumber& n) { return part.substr(0, equals) == n.name; });
    double value = 0;
    const char* last = part.data() + part.size();
    const char* first = std::min(part.data() + equals + 1, last);
    if (number == numbers.end() || std::from_chars(first, last, value).ptr != last || first == last)
      throw Error("builtin", fmt::format("'{}' is no parameter with a number", part), kAccepted);
    if (!(value >= number->min && value <= number->max))
      throw Error("builtin", fmt::format("{} is {}", number->name, value),
                  fmt::format("a number in [{}, {}]", number->min, number->max));
    *number->value = value;
  }
}

}  // namespace

std::unique_ptr<Light> make_studio_light() {
  const std::vector<SoftBox> boxes = {
      SoftBox(-128, 38, 62, 48, {9.5, 8.6, 7.4}),  // key, from the left behind the camera
      SoftBox(112, 18, 46, 62, {1.9, 2.3, 3.0}),   // fill, from the right
      SoftBox(38, 34, 16, 66, {7.0, 7.2, 7.8}),    // strip, from behind on the right
      SoftBox(-30, 84, 70, 70, {2.6, 2.6, 2.6}),   // overhead
  };
  return std::make_unique<FunctionLight>([boxes](Vec3d d) {
    // A grey sweep: darker below and behind the subject, a soft glow at the height of the horizon.
    const double glow = std::exp(-std::pow((d.y - 0.05) / 0.45, 2));
    Rgb sum = (0.10 + 0.26 * glow + 0.06 * d.y) * Rgb{0.94, 0.97, 1.05};
    for (const SoftBox& box : boxes) sum += box(d);
    return sum;
  });
}

std::unique_ptr<Light> make_panel_light(const PanelParams& params) {
  const Vec3d axis = direction_from(params.azimuth, params.elevation);
  const Vec3d right = std::tan(0.5 * params.width * kDegree) * direction_from(params.azimuth + 90, 0);
  const Vec3d up = std::tan(0.5 * params.height * kDegree) * cross(direction_from(params.azimuth + 90, 0), axis);
  return std::make_unique<FunctionLight>(
      [background = params.background](Vec3d) {
        return Rgb{background, background, background};
      },
      std::vector<FunctionLight::Disc>(),
      std::vector<FunctionLight::Polygon>{{{axis - right - up, axis + right - up, axis + right + up, axis - right + up},
                                           {params.radiance, params.radiance, params.radiance}}});
}

std::unique_ptr<Light> make_axes_light() {
  const double half_angle = 25 * kDegree;
  return std::make_unique<FunctionLight>(
      [](Vec3d) {
        return Rgb{0.04, 0.04, 0.04};
      },
      std::vector<FunctionLight::Disc>{{{1, 0, 0}, half_angle, {6, 0.2, 0.2}},
                                       {{-1, 0, 0}, half_angle, {0.2, 6, 6}},
                                       {{0, 1, 0}, half_angle, {0.2, 6, 0.2}},
                                       {{0, -1, 0}, half_angle, {6, 0.2, 6}},
                                       {{0, 0, 1}, half_angle, {0.2, 0.2, 6}},
                                       {{0, 0, -1}, half_angle, {6, 6, 0.2}}});
}

std::unique_ptr<Light> make_thesis_light() {
  return std::make_unique<FunctionLight>([](Vec3d d) {
    const double theta = std::atan2(std::hypot(d.x, d.y), d.z), phi = std::atan2(d.y, d.x);
    const double value =
        std::max(0.0, 5 * std::cos(theta) - 4) + std::max(0.0, -4 * std::sin(theta - pi) * std::cos(phi - 2.5) - 3);
    return Rgb{value, value, value};
  });
}

std::unique_ptr<Light> make_builtin_light(const std::string& name_and_parameters) {
  const std::size_t colon = std::min(name_and_parameters.find(':'), name_and_parameters.size());
  const std::string name = name_and_parameters.substr(0, colon);
  const std::string parameters =
      colon < name_and_parameters.size() ? name_and_parameters.substr(colon + 1) : std::string();
  SkyParams sky;
  PanelParams panel;
  if (name == "sky")
    parse_parameters(parameters, {{"elevation", &sky.elevation, 0, 90},
                                  {"azimuth", &sky.azimuth, -360, 360},
                                  {"turbidity", &sky.turbidity, 1.7, 10},
                                  {"ground", &sky.ground, 0, 1}});
  else if (name == "panel")
    parse_parameters(parameters, {{"azimuth", &panel.azimuth, -360, 360},
                                  {"elevation", &panel.elevation, -90, 90},
                                  {"width", &panel.width, 0.001, 175},
                                  {"height", &panel.height, 0.001, 175},
                                  {"radiance", &panel.radiance, 0, 1e9},
                                  {"background", &panel.background, 0, 1e9}});
  else
    parse_parameters(parameters, {});
  if (name == "sky") return make_sky_light(sky);
  if (name == "studio") return make_studio_light();
  if (name == "panel") return make_panel_light(panel);
  if (name == "axes") return make_axes_light();
  if (name == "thesis") return make_thesis_light();
  throw Error("builtin:" + name, "no such built-in light", kAccepted);
}

}  // namespace shlight
