#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "shlight/core/error.h"
#include "shlight/image/image_io.h"

namespace shlight {

inline std::vector<std::byte> bytes_of_text(const std::string& text) {
  const auto raw = std::as_bytes(std::span(text));
  return {raw.begin(), raw.end()};
}

// What is wrong with a file, or "no error".
template <class Decode>
std::string decode_error(const std::vector<std::byte>& bytes, Decode&& decode) {
  try {
    decode(std::span<const std::byte>(bytes));
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

// Damages a good file in every way that is quick to make: cut at every length, `rounds` times a few bytes changed, some
// among the first `header` bytes. Each is read whole or refused by an Error; nothing else may be thrown, and sanitizers
// see the rest. Every cut must be refused, but those of the lengths `whole`.
template <class Decode>
void fuzz_decoder(const std::vector<std::byte>& good, std::size_t header, int rounds, Decode&& decode,
                  const std::vector<std::size_t>& whole = {}) {
  const auto try_one = [&](const std::vector<std::byte>& bytes) {
    try {
      const LoadedImage loaded = decode(std::span<const std::byte>(bytes));
      EXPECT_EQ(loaded.image.values.size(), 3 * loaded.image.num_pixels());
      return true;
    } catch (const Error& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
      return false;
    }
  };
  ASSERT_TRUE(try_one(good));
  for (std::size_t length = 0; length < good.size(); ++length) {
    const std::vector<std::byte> cut(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(length));
    const bool read = try_one(cut);
    EXPECT_TRUE(!read || std::ranges::count(whole, length) > 0) << length;
  }
  std::mt19937_64 random(1);
  for (int round = 0; round < rounds; ++round) {
    std::vector<std::byte> bytes = good;
    for (std::uint64_t change = 0, changes = 1 + random() % 4; change < changes; ++change) {
      const std::size_t among = random() % 2 == 0 && header > 0 ? header : bytes.size();
      std::byte& byte = bytes[random() % among];
      // Any value, one bit, or an extreme.
      const std::uint64_t kind = random() % 3, value = random();
      byte = kind == 0   ? std::byte(value & 255)
             : kind == 1 ? byte ^ std::byte(1 << value % 8)
                         : std::byte(value % 2 ? 0 : 255);
    }
    try_one(bytes);
  }
}

}  // namespace shlight
