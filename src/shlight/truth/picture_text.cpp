#include "shlight/truth/picture_text.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "shlight/image/tone_map.h"

namespace shlight {
namespace {

// A row a number, whose bits are the dots from the left.
struct Glyph {
  char character;
  std::array<unsigned char, 5> rows;
};
constexpr int kGlyphWidth = 3, kGlyphHeight = 5, kGlyphScale = 2;
constexpr std::array<Glyph, 48> kGlyphs = {
    {{'0', {7, 5, 5, 5, 7}}, {'1', {2, 6, 2, 2, 7}}, {'2', {7, 1, 7, 4, 7}}, {'3', {7, 1, 3, 1, 7}},
     {'4', {5, 5, 7, 1, 1}}, {'5', {7, 4, 7, 1, 7}}, {'6', {7, 4, 7, 5, 7}}, {'7', {7, 1, 2, 2, 2}},
     {'8', {7, 5, 7, 5, 7}}, {'9', {7, 5, 7, 1, 7}}, {'A', {2, 5, 7, 5, 5}}, {'B', {6, 5, 6, 5, 6}},
     {'C', {3, 4, 4, 4, 3}}, {'D', {6, 5, 5, 5, 6}}, {'E', {7, 4, 6, 4, 7}}, {'F', {7, 4, 6, 4, 4}},
     {'G', {3, 4, 5, 5, 3}}, {'H', {5, 5, 7, 5, 5}}, {'I', {7, 2, 2, 2, 7}}, {'J', {1, 1, 1, 5, 2}},
     {'K', {5, 5, 6, 5, 5}}, {'L', {4, 4, 4, 4, 7}}, {'M', {5, 7, 7, 5, 5}}, {'N', {6, 5, 5, 5, 5}},
     {'O', {2, 5, 5, 5, 2}}, {'P', {6, 5, 6, 4, 4}}, {'Q', {2, 5, 5, 6, 3}}, {'R', {6, 5, 6, 5, 5}},
     {'S', {3, 4, 2, 1, 6}}, {'T', {7, 2, 2, 2, 2}}, {'U', {5, 5, 5, 5, 7}}, {'V', {5, 5, 5, 5, 2}},
     {'W', {5, 5, 7, 7, 5}}, {'X', {5, 5, 2, 5, 5}}, {'Y', {5, 5, 2, 2, 2}}, {'Z', {7, 1, 2, 4, 7}},
     {'.', {0, 0, 0, 0, 2}}, {',', {0, 0, 0, 2, 4}}, {':', {0, 2, 0, 2, 0}}, {'%', {5, 1, 2, 4, 5}},
     {'/', {1, 1, 2, 4, 4}}, {'+', {0, 2, 7, 2, 0}}, {'-', {0, 0, 7, 0, 0}}, {'=', {0, 7, 0, 7, 0}},
     {'(', {1, 2, 2, 2, 1}}, {')', {4, 2, 2, 2, 4}}, {'|', {2, 2, 2, 2, 2}}, {'_', {0, 0, 0, 0, 7}}}};

static_assert(kTextAdvance == (kGlyphWidth + 1) * kGlyphScale && kTextHeight == kGlyphHeight * kGlyphScale);

}  // namespace

void set_pixel(Image8& image, int x, int y, Rgb linear) {
  const std::size_t i =
      4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x));
  const std::array<double, 3> channels = {linear.r, linear.g, linear.b};
  for (std::size_t c = 0; c < 3; ++c)
    image.values[i + c] = static_cast<unsigned char>(std::lround(255 * encode_srgb(channels[c])));
  image.values[i + 3] = 255;
}

void draw_text(Image8& image, int left, int top, std::string_view text, Rgb ink) {
  for (const char character : text) {
    const auto capital = static_cast<char>(std::toupper(static_cast<unsigned char>(character)));
    const auto* glyph = std::ranges::find(kGlyphs, capital, &Glyph::character);
    for (int y = 0; glyph != kGlyphs.end() && y < kTextHeight; ++y)
      for (int x = 0; x < kGlyphWidth * kGlyphScale; ++x) {
        const int row = glyph->rows[static_cast<std::size_t>(y / kGlyphScale)];
        const bool inside = left + x >= 0 && left + x < image.width && top + y >= 0 && top + y < image.height;
        if (inside && row >> (kGlyphWidth - 1 - x / kGlyphScale) & 1) set_pixel(image, left + x, top + y, ink);
      }
    left += kTextAdvance;
  }
}

}  // namespace shlight
