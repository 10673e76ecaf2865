#include "shlight/image/raw_float.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "shlight/image/fuzz_test_util.h"

namespace shlight {
namespace {

LoadedImage decode(std::span<const std::byte> bytes) {
  return decode_raw_float(bytes, "a.float", 1 << 20);
}
std::string error_of(const std::vector<std::byte>& bytes) {
  return decode_error(bytes, [](auto b) { return decode(b); });
}

std::vector<std::byte> bytes_of(const Image& image, bool swapped) {
  const auto raw = std::as_bytes(std::span(image.values));
  std::vector<std::byte> bytes(raw.begin(), raw.end());
  if (swapped)
    for (std::size_t i = 0; i < bytes.size(); i += 4) std::reverse(&bytes[i], &bytes[i] + 4);
  return bytes;
}

// Values over 24 stops with all bits of the mantissa in use.
Image some_probe(int size) {
  Image image(size, size);
  for (std::size_t i = 0; i < image.values.size(); ++i)
    image.values[i] = static_cast<float>(std::exp2(12 * std::sin(0.37 * static_cast<double>(i))));
  return image;
}

TEST(RawFloat, BothSequencesOfBytesReadTheSame) {
  for (const int size : {4, 33}) {
    Image image = some_probe(size);
    image.set_rgb(1, 1, {});
    image.set_rgb(2, 1, {-1, 0, 1e6});
    for (const bool swapped : {false, true}) {
      const LoadedImage loaded = decode(bytes_of(image, swapped));
      EXPECT_EQ(loaded.image.values, image.values);
      EXPECT_EQ(loaded.image.width, size);
      EXPECT_EQ(loaded.layout, Layout::kAngularMap);
    }
  }
}

TEST(RawFloat, ValuesOfFewBitsAndBadPixelsAreTold) {
  Image image(32, 32);
  for (std::size_t i = 0; i < image.values.size(); ++i) image.values[i] = static_cast<float>(1 + i % 4);
  image.set_rgb(3, 4, {NAN, HUGE_VAL, 1});
  for (const bool swapped : {false, true}) {
    const LoadedImage loaded = decode(bytes_of(image, swapped));
    EXPECT_EQ(loaded.image.pixel(4, 4)[0], image.pixel(4, 4)[0]);
    EXPECT_TRUE(std::isnan(loaded.image.pixel(3, 4)[0]));
    EXPECT_TRUE(std::isinf(loaded.image.pixel(3, 4)[1]));
  }
}

TEST(RawFloat, BlackIsBlack) {
  EXPECT_EQ(decode(bytes_of(Image(8, 8), false)).image.values, Image(8, 8).values);
}

TEST(RawFloat, RefusesWhatItCannotTell) {
  EXPECT_EQ(error_of({}), "a.float: has 0 bytes: 12 · N · N bytes: three floats for each of N x N pixels");
  EXPECT_NE(error_of(std::vector<std::byte>(12 * 4 * 3)).find("has 144 bytes"), std::string::npos);
  EXPECT_NE(error_of(std::vector<std::byte>(12 * 4 + 1)).find("has 49 bytes"), std::string::npos);
  EXPECT_NE(error_of(std::vector<std::byte>(12 * 2000 * 2000)).find("at most 1048576 pixels"), std::string::npos);
  // Floats in both sequences, but different ones.
  Image both(8, 8);
  for (std::size_t i = 0; i < both.values.size(); ++i)
    both.values[i] = std::bit_cast<float>(0x3f0000be + (static_cast<std::uint32_t>(i) << 16));
  EXPECT_NE(error_of(bytes_of(both, false)).find("can be light in both"), std::string::npos);
  // Text.
  std::string text;
  while (text.size() < 12 * 16 * 16) text += "nothing at all ";
  text.resize(12 * 16 * 16);
  EXPECT_NE(error_of(bytes_of_text(text)), "no error");
  // Bytes that are large in any sequence.
  EXPECT_NE(error_of(std::vector<std::byte>(12 * 64, std::byte{0x7e})).find("can be light, in either"),
            std::string::npos);
}

TEST(RawFloat, DamagedFilesAreReadOrRefused) {
  fuzz_decoder(bytes_of(some_probe(2), false), 0, 3000, [](auto b) { return decode(b); }, {0, 12});
}

}  // namespace
}  // namespace shlight
