#include "shlight/transfer/sobol.h"

#include "shlight/core/assert.h"

namespace shlight {
namespace {

// Nested uniform scrambling: each bit is flipped or not at random, by a coin of its own for every value of the bits
// before it. Points of one dyadic box stay in one box.
std::uint32_t owen_scramble(std::uint32_t digits, std::uint64_t seed) {
  std::uint32_t scrambled = 0;
  for (int bit = 0; bit < 32; ++bit) {
    const std::uint32_t before = bit == 0 ? 0 : digits >> (32 - bit);
    const std::uint64_t coin = mix_bits(seed ^ (std::uint64_t{1} << 32 << bit) ^ before);
    scrambled = scrambled << 1 | ((digits >> (31 - bit) ^ static_cast<std::uint32_t>(coin)) & 1);
  }
  return scrambled;
}

}  // namespace

void make_scrambled_sobol(std::uint64_t seed, std::span<double> x, std::span<double> y) {
  SHLIGHT_ASSERT_EQ(x.size(), y.size());
  const std::uint64_t seed_x = mix_bits(2 * seed), seed_y = mix_bits(2 * seed + 1);
  for (std::size_t j = 0; j < x.size(); ++j) {
    // Column k of a generator matrix is what bit k of the index adds (modulo 2) to the digits.
    std::uint32_t digits_x = 0, digits_y = 0;
    std::uint32_t column_x = 1u << 31, column_y = 1u << 31;
    for (std::size_t index = j; index != 0; index >>= 1) {
      if (index & 1) digits_x ^= column_x, digits_y ^= column_y;
      column_x >>= 1;
      column_y ^= column_y >> 1;
    }
    x[j] = owen_scramble(digits_x, seed_x) * 0x1p-32;
    y[j] = owen_scramble(digits_y, seed_y) * 0x1p-32;
  }
}

}  // namespace shlight
