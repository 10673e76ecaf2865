#include "shlight/truth/heat_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "shlight/truth/picture_text.h"

namespace shlight {
namespace {

// [1]
Rgb rgb_from_oklab(double lightness, double a, double b) {
  const auto cubed = [](double v) { return v * v * v; };
  const double l = cubed(lightness + 0.3963377774 * a + 0.2158037573 * b);
  const double m = cubed(lightness - 0.1055613458 * a - 0.0638541728 * b);
  const double s = cubed(lightness - 0.0894841775 * a - 1.2914855480 * b);
  return {4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
          -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
          -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
}

bool can_be_shown(Rgb c) {
  return std::min({c.r, c.g, c.b}) >= 0 && std::max({c.r, c.g, c.b}) <= 1;
}

// A bar from the largest value at the top to 0 at the bottom, numbers beside it.
void draw_scale(Image8& image, int left, double largest) {
  constexpr int kMargin = 8, kBarWidth = 8, kTick = 3, kEnd = kTextHeight / 2 + 4;
  constexpr double kPage = 0.02;  // a dark grey
  const int top = kEnd, bottom = image.height - 1 - kEnd;
  for (int y = 0; y < image.height; ++y)
    for (int x = left; x < image.width; ++x) {
      const bool is_bar = x >= left + kMargin && x < left + kMargin + kBarWidth && y >= top && y <= bottom;
      set_pixel(image, x, y,
                is_bar ? heat_color(static_cast<double>(bottom - y) / (bottom - top)) : Rgb{kPage, kPage, kPage});
    }
  constexpr int kSteps = 4;
  for (int i = 0; i <= kSteps; ++i) {
    const int y = bottom - (bottom - top) * i / kSteps, x = left + kMargin + kBarWidth;
    for (int j = 0; j < kTick; ++j) set_pixel(image, x + j, y, {1, 1, 1});
    draw_text(image, x + 2 * kTick, y - kTextHeight / 2, fmt::format("{:.2g}", largest * i / kSteps));
  }
}

}  // namespace

Rgb heat_color(double t) {
  constexpr double kDarkest = 0.12, kLightest = 0.97, kMostChroma = 0.19;
  const double lightness = std::lerp(kDarkest, kLightest, std::clamp(t, 0.0, 1.0));
  // Hues from violet over red to yellow, most colourful in the middle.
  const double hue = std::lerp(285.0, 465.0, std::clamp(t, 0.0, 1.0)) * std::numbers::pi / 180;
  // What a screen cannot show is made paler, at the same lightness.
  double chroma = kMostChroma * std::sin(std::numbers::pi * (0.1 + 0.8 * std::clamp(t, 0.0, 1.0)));
  Rgb color = rgb_from_oklab(lightness, chroma * std::cos(hue), chroma * std::sin(hue));
  while (!can_be_shown(color)) {
    chroma *= 0.97;
    color = rgb_from_oklab(lightness, chroma * std::cos(hue), chroma * std::sin(hue));
  }
  return color;
}

Image8 make_heat_map(const Plane& plane, double largest) {
  Image8 image{plane.width + kScaleWidth, std::max(plane.height, kScaleHeight), {}};
  image.values.resize(4 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height), 255);
  // As many colours as a screen tells apart, and more.
  constexpr int kColors = 1024;
  std::vector<Rgb> colors;
  for (int i = 0; i <= kColors; ++i) colors.push_back(heat_color(static_cast<double>(i) / kColors));
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < plane.width; ++x) {
      const double t = y < plane.height ? std::clamp(double{plane.at(x, y)} / largest, 0.0, 1.0) : 0;
      set_pixel(image, x, y, colors[static_cast<std::size_t>(std::lround(t * kColors))]);
    }
  draw_scale(image, plane.width, largest);
  return image;
}

}  // namespace shlight
