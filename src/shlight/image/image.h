#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "shlight/sh/vec.h"

namespace shlight {

// A picture of linear Rec. 709 floats: rows from the top, pixels from the left, three values (red, green, blue) each.
// Pixels are areas; pixel (x, y) covers [x, x+1) x [y, y+1).
struct Image {
  int width = 0;
  int height = 0;
  std::vector<float> values;  // 3 · width · height

  Image() = default;
  Image(int w, int h) : width(w), height(h), values(3 * static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}

  std::size_t num_pixels() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
  std::span<float, 3> pixel(int x, int y) { return std::span<float, 3>(values.data() + offset(x, y), 3); }
  std::span<const float, 3> pixel(int x, int y) const {
    return std::span<const float, 3>(values.data() + offset(x, y), 3);
  }
  std::span<const float> row(int y) const {
    return {values.data() + offset(0, y), 3 * static_cast<std::size_t>(width)};
  }
  Rgb rgb(int x, int y) const {
    const auto p = pixel(x, y);
    return {p[0], p[1], p[2]};
  }
  void set_rgb(int x, int y, Rgb c) {
    const auto p = pixel(x, y);
    p[0] = static_cast<float>(c.r), p[1] = static_cast<float>(c.g), p[2] = static_cast<float>(c.b);
  }

 private:
  std::size_t offset(int x, int y) const {
    return 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
  }
};

// Eight bits a channel, sRGB-encoded colour and linear alpha: rows from the top, four values a pixel. What textures are
// read into and PNG pictures are written from.
struct Image8 {
  int width = 0;
  int height = 0;
  std::vector<unsigned char> values;  // 4 · width · height
};

}  // namespace shlight
