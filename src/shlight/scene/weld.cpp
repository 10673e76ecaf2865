#include "shlight/scene/weld.h"

#include <algorithm>
#include <bit>
#include <limits>

#include "shlight/core/assert.h"

namespace shlight {
namespace {

// Equal floats have equal keys.
std::uint32_t key_of(float value) {
  return std::bit_cast<std::uint32_t>(value == 0 ? 0.0f : value);
}

std::uint64_t hash_of(std::span<const float> row) {
  // Each step multiplies by an odd constant (2^64 over the golden ratio) and folds the high bits, the well-mixed ones,
  // down.
  std::uint64_t hash = 0;
  for (const float value : row) {
    hash = (hash ^ key_of(value)) * 0x9e3779b97f4a7c15u;
    hash ^= hash >> 32;
  }
  return hash;
}

}  // namespace

Weld weld_rows(std::span<const float> values, std::size_t stride) {
  const std::size_t rows = values.size() / stride;
  constexpr std::uint32_t kFree = std::numeric_limits<std::uint32_t>::max();
  SHLIGHT_ASSERT_EQ(rows * stride, values.size());
  SHLIGHT_ASSERT_LE(rows, std::size_t{kFree});
  const auto row = [&](std::size_t i) { return values.subspan(i * stride, stride); };

  // A hash table with open addressing, at most half full, of group numbers.
  std::vector<std::uint32_t> table(std::bit_ceil(2 * rows + 1), kFree);
  const std::size_t mask = table.size() - 1;
  Weld weld;
  weld.group.reserve(rows);
  for (std::size_t i = 0; i < rows; ++i) {
    std::size_t slot = hash_of(row(i)) & mask;
    while (table[slot] != kFree && !std::ranges::equal(row(weld.first[table[slot]]), row(i), {}, key_of, key_of))
      slot = (slot + 1) & mask;
    if (table[slot] == kFree) {
      table[slot] = static_cast<std::uint32_t>(weld.first.size());
      weld.first.push_back(static_cast<std::uint32_t>(i));
    }
    weld.group.push_back(table[slot]);
  }
  return weld;
}

Weld weld_positions(std::span<const Vec3f> positions) {
  static_assert(sizeof(Vec3f) == 3 * sizeof(float));
  return weld_rows({reinterpret_cast<const float*>(positions.data()), 3 * positions.size()}, 3);
}

}  // namespace shlight
