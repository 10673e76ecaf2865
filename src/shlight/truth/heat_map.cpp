#include "shlight/truth/heat_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

#include "shlight/image/tone_map.h"

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

// What numbers are written with: 3 x 5 pixels, a row a number whose bits are the pixels from the left.
struct Glyph {
  char character;
  std::array<unsigned char, 5> rows;
};
constexpr int kGlyphWidth = 3, kGlyphHeight = 5, kGlyphScale = 2;
constexpr std::array<Glyph, 14> kGlyphs = {{{'0', {7, 5, 5, 5, 7}},
                                            {'1', {2, 6, 2, 2, 7}},
                                            {'2', {7, 1, 7, 4, 7}},
                                            {'3', {7, 1, 3, 1, 7}},
                                            {'4', {5, 5, 7, 1, 1}},
                                            {'5', {7, 4, 7, 1, 7}},
                                            {'6', {7, 4, 7, 5, 7}},
                                            {'7', {7, 1, 2, 2, 2}},
                                            {'8', {7, 5, 7, 5, 7}},
                                            {'9', {7, 5, 7, 1, 7}},
                                            {'.', {0, 0, 0, 0, 2}},
                                            {'-', {0, 0, 7, 0, 0}},
                                            {'+', {0, 2, 7, 2, 0}},
                                            {'e', {0, 7, 7, 4, 7}}}};

void set_pixel(Image8& image, int x, int y, Rgb linear) {
  const std::size_t i =
      4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x));
  const std::array<double, 3> channels = {linear.r, linear.g, linear.b};
  for (std::size_t c = 0; c < 3; ++c)
    image.values[i + c] = static_cast<unsigned char>(std::lround(255 * encode_srgb(channels[c])));
  image.values[i + 3] = 255;
}

void write_number(Image8& image, int left, int top, std::string_view text) {
  constexpr Rgb kInk = {1, 1, 1};
  for (const char character : text) {
    const auto* glyph = std::ranges::find(kGlyphs, character, &Glyph::character);
    if (glyph == kGlyphs.end()) continue;
    for (int y = 0; y < kGlyphHeight * kGlyphScale; ++y)
      for (int x = 0; x < kGlyphWidth * kGlyphScale; ++x) {
        const int row = glyph->rows[static_cast<std::size_t>(y / kGlyphScale)];
        if (row >> (kGlyphWidth - 1 - x / kGlyphScale) & 1 && left + x < image.width && top + y < image.height)
          set_pixel(image, left + x, top + y, kInk);
      }
    left += (kGlyphWidth + 1) * kGlyphScale;
  }
}

// A bar from the largest value at the top to 0 at the bottom, numbers beside it.
void draw_scale(Image8& image, int left, double largest) {
  constexpr int kMargin = 8, kBarWidth = 8, kTick = 3;
  constexpr double kPage = 0.02;  // a dark grey
  const int top = kGlyphHeight, bottom = image.height - 1 - kGlyphHeight;
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
    write_number(image, x + 2 * kTick, y - kGlyphHeight, fmt::format("{:.2g}", largest * i / kSteps));
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
