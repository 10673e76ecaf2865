#pragma once

#include <string_view>

#include "shlight/image/image.h"
#include "shlight/sh/vec.h"

// Words and numbers on pictures, without a font: characters of 3 x 5 dots, each 2 x 2 pixels. Not installed.

namespace shlight {

inline constexpr int kTextAdvance = 8, kTextHeight = 10;  // of a character, with the gap beside it; of a line

// Sets a pixel to a colour, linear and within [0, 1], and makes it opaque.
void set_pixel(Image8& image, int x, int y, Rgb linear);

// Writes digits, letters (small ones as capitals), and the signs .,:%/+-=()|, from `left` rightward and from `top`
// down; other characters leave a gap. What lies beyond the picture is left out.
void draw_text(Image8& image, int left, int top, std::string_view text, Rgb ink = {1, 1, 1});

}  // namespace shlight
