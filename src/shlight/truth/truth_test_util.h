#pragma once

// What the tests of truth/ share.

#include <cstdint>

#include "shlight/image/image.h"
#include "shlight/truth/plane.h"

namespace shlight {

// A number in [0, 1) that a seed and an index have (SplitMix64).
inline double noise(std::uint64_t seed, std::uint64_t index) {
  std::uint64_t v = seed * 0x9e3779b97f4a7c15u + index * 0xd1342543de82ef95u + 0x632be59bd9b4e019u;
  v = (v ^ (v >> 30)) * 0xbf58476d1ce4e5b9u;
  v = (v ^ (v >> 27)) * 0x94d049bb133111ebu;
  return static_cast<double>((v ^ (v >> 31)) >> 11) * 0x1p-53;
}

inline Plane noise_plane(int width, int height, std::uint64_t seed) {
  Plane plane(width, height);
  for (std::size_t i = 0; i < plane.values.size(); ++i) plane.values[i] = static_cast<float>(noise(seed, i));
  return plane;
}

inline Image noise_image(int width, int height, std::uint64_t seed) {
  Image image(width, height);
  for (std::size_t i = 0; i < image.values.size(); ++i) image.values[i] = static_cast<float>(noise(seed, i));
  return image;
}

inline Image constant_image(int width, int height, Rgb color) {
  Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) image.set_rgb(x, y, color);
  return image;
}

}  // namespace shlight
