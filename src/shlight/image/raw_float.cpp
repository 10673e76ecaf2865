#include "shlight/image/raw_float.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstring>

#include "shlight/image/picture_reader.h"

namespace shlight {
namespace {

std::uint32_t load_word(const std::byte* from, bool swapped) {
  std::uint32_t word;
  std::memcpy(&word, from, sizeof word);
  if (!swapped) return word;
  return word << 24 | (word & 0xff00) << 8 | (word >> 8 & 0xff00) | word >> 24;
}

// The share of values other than 0 that light may have.
double share_of_light(std::span<const std::byte> bytes, bool swapped) {
  std::size_t light = 0, all = 0;
  for (std::size_t i = 0; i + 4 <= bytes.size(); i += 4) {
    const float value = std::abs(std::bit_cast<float>(load_word(bytes.data() + i, swapped)));
    if (value == 0) continue;
    ++all;
    if (value > 1e-12f && value < 1e12f) ++light;
  }
  return all == 0 ? 1 : static_cast<double>(light) / static_cast<double>(all);
}

bool same_in_both(std::span<const std::byte> bytes) {
  for (std::size_t i = 0; i + 4 <= bytes.size(); i += 4)
    if (load_word(bytes.data() + i, false) != load_word(bytes.data() + i, true)) return false;
  return true;
}

}  // namespace

LoadedImage decode_raw_float(std::span<const std::byte> bytes, const std::string& name, std::uint64_t max_pixels) {
  constexpr std::size_t kPixelBytes = 3 * sizeof(float);
  const auto size = std::llround(std::sqrt(static_cast<double>(bytes.size() / kPixelBytes)));
  if (size == 0 || static_cast<std::size_t>(size) * static_cast<std::size_t>(size) * kPixelBytes != bytes.size())
    throw Error(name, fmt::format("has {} bytes", bytes.size()),
                "12 · N · N bytes: three floats for each of N x N pixels");
  check_picture_size(name, size, size, max_pixels);

  // In the wrong sequence, the first byte, most of the exponent, is the noise of a mantissa: at most half of it is
  // light.
  constexpr double kNearlyAll = 0.95, kMany = 0.8;
  constexpr bool kBigEndian = std::endian::native == std::endian::big;
  const double little = share_of_light(bytes, kBigEndian), big = share_of_light(bytes, !kBigEndian);
  if (little < kNearlyAll && big < kNearlyAll)
    throw Error(name, "holds no floats that can be light, in either sequence of bytes",
                "three floats a pixel, nearly all finite and none absurd");
  if (little > kMany && big > kMany && !same_in_both(bytes))
    throw Error(name, "tells no sequence of bytes: its floats can be light in both", "a float file of either kind");

  LoadedImage loaded{Image(static_cast<int>(size), static_cast<int>(size)), Layout::kAngularMap, {}};
  const bool swapped = (little >= big) == kBigEndian;
  for (std::size_t i = 0; i < loaded.image.values.size(); ++i)
    loaded.image.values[i] = std::bit_cast<float>(load_word(bytes.data() + sizeof(float) * i, swapped));
  return loaded;
}

}  // namespace shlight
