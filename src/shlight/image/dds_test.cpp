#include "shlight/image/dds.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <functional>

#include "shlight/core/file.h"
#include "shlight/core/temporary_folder.h"
#include "shlight/image/fuzz_test_util.h"

namespace shlight {
namespace {

using Words = std::array<std::uint32_t, 32>;  // "DDS " and the header
using Texel = std::function<std::string(Rgb)>;

// Indices into Words.
enum { kHeight = 3, kWidth = 4, kLevels = 7, kPixelFlags = 20, kFourCc = 21, kBits = 22, kMasks = 23, kCaps2 = 28 };

Words header_of(std::uint32_t width, std::uint32_t height) {
  Words words = {};
  std::memcpy(&words[0], "DDS ", 4);
  words[1] = 124, words[2] = 0x1007, words[kHeight] = height, words[kWidth] = width, words[kLevels] = 1;
  words[19] = 32, words[27] = 0x1008, words[kCaps2] = 0xfe00;
  return words;
}

template <class Value>
std::string bytes_of(const Value& value) {
  return {reinterpret_cast<const char*>(&value), sizeof value};
}

std::string legacy(std::uint32_t size, std::uint32_t four_cc, std::uint32_t levels = 1) {
  Words words = header_of(size, size);
  words[kPixelFlags] = 4, words[kFourCc] = four_cc, words[kLevels] = levels;
  return bytes_of(words);
}
std::string dx10(std::uint32_t size, std::uint32_t format, std::array<std::uint32_t, 3> rest = {3, 4, 1}) {
  return legacy(size, 0x30315844) + bytes_of(std::array<std::uint32_t, 5>{format, rest[0], rest[1], rest[2], 0});
}
std::string masks(std::uint32_t size, std::uint32_t bits, std::array<std::uint32_t, 3> rgb) {
  Words words = header_of(size, size);
  words[kPixelFlags] = 0x40, words[kBits] = bits;
  for (std::size_t c = 0; c < 3; ++c) words[kMasks + c] = rgb[c];
  return bytes_of(words);
}

// Exact in every float kind: mantissas of one bit or two, within R9G9B9E5's common exponent.
Rgb some_colour(int face, int x, int y) {
  return {std::exp2(face - 3) * (y % 2 ? 1 : 1.5), std::exp2(face - 3 + x % 3 - 1), x == 1 ? 0 : std::exp2(face - 4)};
}

std::string pixels(int size, const Texel& texel, int faces = 6) {
  std::string bytes;
  for (int face = 0; face < faces; ++face)
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x) bytes += texel(some_colour(face, x, y));
  return bytes;
}
Image expected(int size, int faces = 6) {
  Image image(size, size * faces);
  for (int y = 0; y < size * faces; ++y)
    for (int x = 0; x < size; ++x) image.set_rgb(x, y, some_colour(y / size, x, y % size));
  return image;
}

std::uint16_t half_of(double value) {  // of a value that is normal, or 0, in half
  if (value == 0) return 0;
  const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(value));
  return static_cast<std::uint16_t>((bits >> 16 & 0x8000) | ((bits >> 13) - (112u << 10)));
}
std::string half4(Rgb c) {
  return bytes_of(std::array<std::uint16_t, 4>{half_of(c.r), half_of(c.g), half_of(c.b), half_of(1)});
}
std::string float4(Rgb c) {
  return bytes_of(std::array<float, 4>{float(c.r), float(c.g), float(c.b), 1});
}
std::string float3(Rgb c) {
  return bytes_of(std::array<float, 3>{float(c.r), float(c.g), float(c.b)});
}
std::string r11g11b10(Rgb c) {
  return bytes_of(std::uint32_t(half_of(c.r) >> 4 | half_of(c.g) >> 4 << 11 | half_of(c.b) >> 5 << 22));
}
std::string r9g9b9e5(Rgb c) {
  int exponent = 0;
  std::frexp(std::max({c.r, c.g, c.b}), &exponent);
  const auto mantissa = [&](double v) { return static_cast<std::uint32_t>(std::ldexp(v, 9 - exponent)); };
  return bytes_of(mantissa(c.r) | mantissa(c.g) << 9 | mantissa(c.b) << 18 | std::uint32_t(exponent + 15) << 27);
}

LoadedImage decode(const std::string& bytes) {
  const auto loaded = decode_dds(bytes_of_text(bytes), "a.dds", 1 << 20, [](auto) -> Image {
    ADD_FAILURE() << "no blocks here";
    return {};
  });
  if (!loaded) throw Error("a.dds: nothing of ours");
  return *loaded;
}
std::string error_of(const std::string& bytes) {
  try {
    decode(bytes);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

// One cube of lights, in every way to say it.
TEST(Dds, EveryFloatKindIsTheSameCube) {
  constexpr int kSize = 3;
  const Image image = expected(kSize);
  for (const auto& [header, texel] : {std::pair<std::string, Texel>{legacy(kSize, 113), half4},
                                      {legacy(kSize, 116), float4},
                                      {dx10(kSize, 10), half4},
                                      {dx10(kSize, 2), float4},
                                      {dx10(kSize, 6), float3},
                                      {dx10(kSize, 26), r11g11b10},
                                      {dx10(kSize, 67), r9g9b9e5}}) {
    const LoadedImage loaded = decode(header + pixels(kSize, texel));
    EXPECT_EQ(loaded.image.width, kSize);
    EXPECT_EQ(loaded.image.height, 6 * kSize);
    EXPECT_EQ(loaded.image.values, image.values);
    EXPECT_EQ(loaded.layout, Layout::kCube);
    EXPECT_TRUE(loaded.warnings.empty());
  }
}

// Every half is what IEEE 754 says, in the layout 1-5-10.
TEST(Dds, EveryHalf) {
  constexpr int kSize = 105;  // 6 · 105² > 65536
  std::string bytes = dx10(kSize, 10);
  for (std::uint32_t i = 0; i < 6 * kSize * kSize; ++i) {
    const auto half = static_cast<std::uint16_t>(i);
    bytes += bytes_of(std::array<std::uint16_t, 4>{half, half, half, half});
  }
  const Image image = decode(bytes).image;
  for (std::uint32_t half = 0; half < 65536; ++half) {
    const float value = image.values[3 * half];
    const int exponent = half >> 10 & 31, mantissa = half & 1023;
    if (exponent == 31) {
      EXPECT_EQ(std::isnan(value), mantissa != 0);
      EXPECT_EQ(std::isinf(value), mantissa == 0);
    } else {
      const double size =
          exponent == 0 ? mantissa * std::exp2(-24) : (1 + mantissa / 1024.0) * std::exp2(exponent - 15);
      EXPECT_EQ(value, half & 0x8000 ? -size : size) << half;
    }
  }
}

TEST(Dds, BytesAreSrgb) {
  const auto rgba = [](Rgb) { return std::string("\xff\x80\x00\x55", 4); };
  const auto rgb = [](Rgb) { return std::string("\xff\x80\x00", 3); };
  const auto bgra = [](Rgb) { return std::string("\x00\x80\xff\x55", 4); };
  const auto bgr = [](Rgb) { return std::string("\x00\x80\xff", 3); };
  for (const auto& [header, texel] : {std::pair<std::string, Texel>{masks(2, 32, {0xff, 0xff00, 0xff0000}), rgba},
                                      {masks(2, 24, {0xff, 0xff00, 0xff0000}), rgb},
                                      {masks(2, 32, {0xff0000, 0xff00, 0xff}), bgra},
                                      {masks(2, 24, {0xff0000, 0xff00, 0xff}), bgr},
                                      {dx10(2, 28), rgba},
                                      {dx10(2, 29), rgba},
                                      {dx10(2, 87), bgra},
                                      {dx10(2, 93), bgra}}) {
    const Image image = decode(header + pixels(2, texel)).image;
    EXPECT_EQ(image.pixel(1, 11)[0], 1);
    EXPECT_NEAR(image.pixel(1, 11)[1], 0.2158605, 1e-6);
    EXPECT_EQ(image.pixel(1, 11)[2], 0);
  }
}

// Each face's smaller levels lie between it and the next.
TEST(Dds, SmallerLevelsAreSkipped) {
  constexpr int kSize = 4;
  std::string bytes = legacy(kSize, 116, 3);
  for (int face = 0; face < 6; ++face)
    for (const int size : {4, 2, 1})
      for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) bytes += float4(size == 4 ? some_colour(face, x, y) : Rgb{-1, -1, -1});
  EXPECT_EQ(decode(bytes).image.values, expected(kSize).values);
  bytes[4 * kLevels] = 4;
  EXPECT_NE(error_of(bytes).find("4 levels of 4 x 4 pixels"), std::string::npos);
}

TEST(Dds, SinglePicturesAreReadAndUnknownOnesLeft) {
  std::string bytes = legacy(4, 116) + pixels(4, float4, 1);
  for (std::size_t i = 0; i < 4; ++i) bytes[4 * kCaps2 + i] = 0;
  const LoadedImage loaded = decode(bytes);
  EXPECT_EQ(loaded.image.values, expected(4, 1).values);
  EXPECT_FALSE(loaded.layout);
  bytes[4 * kFourCc] = 36;
  EXPECT_EQ(error_of(bytes), "a.dds: nothing of ours");

  std::string grey = masks(4, 8, {0xff, 0, 0}) + std::string(16, '\1');
  for (std::size_t i = 0; i < 4; ++i) grey[4 * kCaps2 + i] = 0;
  EXPECT_NE(error_of(grey).find("has pixels without masks for red, green and blue"), std::string::npos);
}

TEST(Dds, WhatIsWrongIsSaid) {
  const std::string good = legacy(3, 116) + pixels(3, float4);
  const auto with = [&](int word, std::uint32_t value) {
    std::string bytes = good;
    std::memcpy(&bytes[4 * static_cast<std::size_t>(word)], &value, 4);
    return error_of(bytes);
  };
  EXPECT_EQ(error_of(good), "no error");
  EXPECT_NE(with(1, 123).find("no DDS header"), std::string::npos);
  EXPECT_NE(with(19, 0).find("no DDS header"), std::string::npos);
  EXPECT_NE(with(kCaps2, 0x7e00).find("has 5 of a cube map's faces: all six"), std::string::npos);
  EXPECT_NE(with(kCaps2, 0x20fe00).find("is no plain cube map"), std::string::npos);
  EXPECT_NE(with(kFourCc, 36).find("has the pixel format 0x24"), std::string::npos);
  EXPECT_NE(with(kWidth, 2).find("has faces of 2 x 3 pixels"), std::string::npos);
  EXPECT_NE(with(kLevels, 0xffffffff).find("levels of 3 x 3"), std::string::npos);
  for (const std::uint32_t huge : {500u, 1u << 24, 1u << 31, 0xffffffffu}) {
    const std::string bytes = legacy(huge, 116) + pixels(3, float4);
    EXPECT_NE(error_of(bytes).find("at most 1048576 pixels"), std::string::npos) << huge;
  }
  EXPECT_NE(error_of(legacy(0, 116)).find("has 0 x 0 pixels"), std::string::npos);
  EXPECT_NE(error_of(legacy(4, 116) + pixels(3, float4)).find("ends too soon"), std::string::npos);
  EXPECT_NE(error_of(dx10(3, 2, {3, 4, 2}) + pixels(3, float4)).find("is an array of 2 cube maps"), std::string::npos);
  EXPECT_NE(error_of(dx10(3, 2, {4, 4, 1}) + pixels(3, float4)).find("is no plain cube map"), std::string::npos);
  EXPECT_NE(error_of(dx10(3, 3) + pixels(3, float4)).find("has the pixel format DXGI 3"), std::string::npos);
}

TEST(Dds, DamagedFilesAreReadOrRefused) {
  const auto decode_any = [](std::span<const std::byte> bytes) {
    const auto loaded = decode_dds(bytes, "a.dds", 1 << 16, [](auto) { return Image(4, 4); });
    if (!loaded) throw Error("a.dds: nothing of ours");
    return *loaded;
  };
  for (const std::string& good : {legacy(2, 116) + pixels(2, float4), dx10(4, 10) + pixels(4, half4),
                                  dx10(4, 26) + pixels(4, r11g11b10), dx10(4, 95) + std::string(6 * 16, '\1')})
    fuzz_decoder(bytes_of_text(good), 148, 5000, decode_any);
}

// Blocks whose pixels can be told without a decoder. BC6H: one region, endpoints of ten bits, all indices 0, so that
// all pixels are the first endpoint q, which stands for the half ((q · 65536 + 32768) >> 10) · 31 >> 6. DXT1: one
// colour of 5-6-5 bits.
TEST(Dds, BlocksOfOneColour) {
  const TemporaryFolder folder;
  const std::uint64_t q[3] = {500, 300, 0};
  const std::array<std::uint64_t, 2> bc6h = {3 | q[0] << 5 | q[1] << 15 | q[2] << 25, 0};
  const auto half = [](std::uint64_t v) { return v == 0 ? 0 : ((v * 65536 + 32768) >> 10) * 31 >> 6; };
  std::string blocks;
  for (int i = 0; i < 6 * 4; ++i) blocks += bytes_of(bc6h);
  write_file(folder / "bc6h.dds", std::string_view(dx10(8, 95) + blocks));
  const LoadedImage loaded = load_image(folder / "bc6h.dds");
  EXPECT_EQ(loaded.layout, Layout::kCube);
  EXPECT_EQ(loaded.image.width, 8);
  EXPECT_EQ(loaded.image.height, 48);
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 8; ++x)
      for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(half_of(loaded.image.pixel(x, y)[c]), half(q[c])) << x << " " << y;

  blocks.clear();
  for (int face = 0; face < 6; ++face)
    blocks += bytes_of(std::array<std::uint16_t, 4>{std::uint16_t(face % 2 ? 0xf800 : 0x07e0), 0, 0, 0});
  for (const std::string& header : {legacy(3, 0x31545844), dx10(3, 71)}) {
    write_file(folder / "bc1.dds", std::string_view(header + blocks));
    const Image image = load_image(folder / "bc1.dds").image;
    for (int y = 0; y < 18; ++y) EXPECT_EQ(image.rgb(2, y), (y / 3 % 2 ? Rgb{1, 0, 0} : Rgb{0, 1, 0})) << y;
  }
}

}  // namespace
}  // namespace shlight
