#include "shlight/image/rgbe.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include "shlight/image/fuzz_test_util.h"

namespace shlight {
namespace {

using Pixel = std::array<int, 4>;
using Pixels = std::vector<Pixel>;

constexpr std::uint64_t kMaxPixels = 1 << 20;

LoadedImage decode(std::span<const std::byte> bytes) {
  return decode_rgbe(bytes, "a.hdr", kMaxPixels);
}
LoadedImage decode(const std::string& text) {
  return decode(bytes_of_text(text));
}
std::string error_of(const std::string& text) {
  return decode_error(bytes_of_text(text), [](auto bytes) { return decode(bytes); });
}

std::string file_of(const std::string& header, const std::string& size, const std::string& pixels) {
  return "#?RADIANCE\n" + header + "FORMAT=32-bit_rle_rgbe\n\n" + size + "\n" + pixels;
}

// A picture with runs and without in each channel; no mantissas of 1, 1, 1 or 2, 2, n.
Pixel some_pixel(int x, int y) {
  return {x / 5 % 2 ? 200 : 130 + x * 7 % 100, y % 3 ? 17 : x % 50, 90, 120 + (x + 3 * y) / 4 % 20};
}
Rgb value_of(Pixel p) {
  const double unit = std::ldexp(1, p[3] - 136);
  return p[3] == 0 ? Rgb{} : Rgb{p[0] * unit, p[1] * unit, p[2] * unit};
}
Image image_of(int width, int height) {
  Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) image.set_rgb(x, y, value_of(some_pixel(x, y)));
  return image;
}

std::string flat(const Pixels& run) {
  std::string text;
  for (const Pixel& pixel : run)
    for (const int byte : pixel) text += static_cast<char>(byte);
  return text;
}

// Mantissas of 1 with a count, in as many digits as it needs.
std::string old_rle(const Pixels& run) {
  std::string text;
  for (std::size_t x = 0; x < run.size();) {
    std::size_t end = x + 1;
    while (end < run.size() && run[end] == run[x]) ++end;
    text += flat({run[x]});
    for (std::size_t count = end - x - 1; count > 0; count >>= 8) text += flat({{1, 1, 1, int(count & 255)}});
    x = end;
  }
  return text;
}

std::string new_rle(const Pixels& run) {
  std::string text = {2, 2, static_cast<char>(run.size() >> 8), static_cast<char>(run.size() & 255)};
  for (std::size_t channel = 0; channel < 4; ++channel)
    for (std::size_t x = 0; x < run.size();) {
      const int byte = run[x][channel];
      std::size_t end = x + 1;
      while (end < run.size() && end - x < 127 && run[end][channel] == byte) ++end;
      if (end - x > 2) {
        text += static_cast<char>(128 + (end - x));
      } else {
        end = std::min(run.size(), x + 1 + x % 128);
        text += static_cast<char>(end - x);
        for (std::size_t i = x; i < end - 1; ++i) text += static_cast<char>(run[i][channel]);
      }
      text += static_cast<char>(run[end - 1][channel]);
      x = end;
    }
  return text;
}

// The picture in one of the eight sequences, say "-Y +X".
std::string encoded(int width, int height, const std::string& sequence,
                    const std::function<std::string(const Pixels&)>& encode_run) {
  const bool rows = sequence[1] == 'Y';
  const bool x_up = sequence[rows ? 3 : 0] == '+', y_up = sequence[rows ? 0 : 3] == '+';
  const int count = rows ? height : width, length = rows ? width : height;
  std::string text;
  for (int i = 0; i < count; ++i) {
    Pixels run;
    for (int j = 0; j < length; ++j) {
      const int across = rows ? j : i, along = rows ? i : j;  // from the file's first corner
      run.push_back(some_pixel(x_up ? across : width - 1 - across, y_up ? height - 1 - along : along));
    }
    text += encode_run(run);
  }
  const std::string size =
      sequence.substr(0, 2) + " " + std::to_string(count) + " " + sequence.substr(3) + " " + std::to_string(length);
  return file_of("", size, text);
}

// Every way to write one picture reads the same.
TEST(Rgbe, SequencesAndEncodingsReadTheSame) {
  for (const auto& [width, height] : {std::pair{5, 3}, {40, 9}, {9, 300}, {300, 8}}) {
    const Image expected = image_of(width, height);
    for (const char* sequence : {"-Y +X", "-Y -X", "+Y +X", "+Y -X", "+X -Y", "+X +Y", "-X -Y", "-X +Y"}) {
      const int length = sequence[1] == 'Y' ? width : height;
      EXPECT_EQ(decode(encoded(width, height, sequence, flat)).image.values, expected.values) << sequence;
      EXPECT_EQ(decode(encoded(width, height, sequence, old_rle)).image.values, expected.values) << sequence;
      if (length < 8) continue;
      const LoadedImage loaded = decode(encoded(width, height, sequence, new_rle));
      EXPECT_EQ(loaded.image.values, expected.values) << sequence;
      EXPECT_EQ(loaded.image.width, width);
      EXPECT_TRUE(loaded.warnings.empty());
    }
  }
}

// Where the first pixels of each sequence are seen, with +Y up.
TEST(Rgbe, TheFirstPixelsOfEachSequence) {
  struct Case {
    const char* size;
    int x, y, next_x, next_y;
  };
  for (const Case& c : {Case{"-Y 2 +X 3", 0, 0, 1, 0}, Case{"-Y 2 -X 3", 2, 0, 1, 0}, Case{"+Y 2 +X 3", 0, 1, 1, 1},
                        Case{"+Y 2 -X 3", 2, 1, 1, 1}, Case{"+X 3 -Y 2", 0, 0, 0, 1}, Case{"+X 3 +Y 2", 0, 1, 0, 0},
                        Case{"-X 3 -Y 2", 2, 0, 2, 1}, Case{"-X 3 +Y 2", 2, 1, 2, 0}}) {
    Pixels pixels(6, {0, 0, 0, 0});
    pixels[0] = {128, 0, 0, 129};
    pixels[1] = {0, 128, 0, 129};
    const Image image = decode(file_of("", c.size, flat(pixels))).image;
    ASSERT_EQ(image.width, 3) << c.size;
    EXPECT_EQ(image.rgb(c.x, c.y), (Rgb{1, 0, 0})) << c.size;
    EXPECT_EQ(image.rgb(c.next_x, c.next_y), (Rgb{0, 1, 0})) << c.size;
  }
}

TEST(Rgbe, ExposuresMultiplyAndAreDividedBy) {
  const auto with = [](const std::string& header) {
    return decode(file_of(header, "-Y 1 +X 1", flat({{128, 64, 32, 131}})));
  };
  EXPECT_EQ(with("").image.rgb(0, 0), (Rgb{4, 2, 1}));
  EXPECT_EQ(with("EXPOSURE=2\nEXPOSURE= 2.0e+00\n").image.rgb(0, 0), (Rgb{1, 0.5, 0.25}));
  EXPECT_EQ(with("EXPOSURE=.5\r\n").image.rgb(0, 0), (Rgb{8, 4, 2}));
  EXPECT_EQ(with("COLORCORR= 2 1 .5\nEXPOSURE=+4\nCOLORCORR=1 1 2\n").image.rgb(0, 0), (Rgb{0.5, 0.5, 0.25}));
  EXPECT_TRUE(with("EXPOSURE=2\n").warnings.empty());
  for (const char* bad : {"EXPOSURE=0\n", "EXPOSURE=-1\n", "EXPOSURE=nan\n", "EXPOSURE=inf\n", "EXPOSURE=x\n",
                          "EXPOSURE=\n", "EXPOSURE=1e999\n", "COLORCORR=1 2\n", "COLORCORR=0 1 1\n",
                          "EXPOSURE=1e300\nEXPOSURE=1e300\n", "EXPOSURE=1e-300\nEXPOSURE=1e-300\n"}) {
    const LoadedImage loaded = with(bad);
    EXPECT_EQ(loaded.image.rgb(0, 0), (Rgb{4, 2, 1})) << bad;
    EXPECT_EQ(loaded.warnings.size(), 1u) << bad;
  }
}

TEST(Rgbe, MagicLinesAndFormats) {
  const std::string pixel = flat({{128, 64, 32, 131}});
  for (const char* header : {"#?RADIANCE\n#?RGBE\nFORMAT=32-bit_rle_rgbe\n\n", "#?RGBE\nFORMAT=32-bit_rle_rgbe\n\n",
                             "#?RADIANCE\r\n#=comment\r\nsome command=3\r\nFORMAT = 32-bit_rle_rgbe \r\n\r\n"})
    EXPECT_EQ(decode(header + ("-Y 1 +X 1\n" + pixel)).image.rgb(0, 0), (Rgb{4, 2, 1})) << header;
  const LoadedImage bare = decode("#?RADIANCE\n\n-Y 1 +X 1\n" + pixel);
  EXPECT_EQ(bare.image.rgb(0, 0), (Rgb{4, 2, 1}));
  EXPECT_EQ(bare.warnings.size(), 1u);
}

// Equal energy is white in CIE XYZ, as equal parts are in Rec. 709.
TEST(Rgbe, Xyz) {
  const LoadedImage loaded =
      decode("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 2\n" + flat({{128, 128, 128, 129}, {128, 0, 0, 129}}));
  for (const float value : loaded.image.pixel(0, 0)) EXPECT_NEAR(value, 1, 1e-6);
  EXPECT_GT(loaded.image.rgb(1, 0).r, 2);  // X alone is outside of Rec. 709
  EXPECT_LT(loaded.image.rgb(1, 0).g, 0);
}

TEST(Rgbe, Primaries) {
  const auto with = [](const std::string& primaries) {
    return decode(
        file_of("PRIMARIES=" + primaries + "\n", "-Y 1 +X 2", flat({{128, 0, 0, 129}, {128, 128, 128, 129}})));
  };
  // Nothing is said, or what is the case anyway.
  for (const char* ours : {"0 0 0 0 0 0 0 0", ".64 .33 .30 .60 .15 .06 .3127 .3290"}) {
    EXPECT_EQ(with(ours).image.rgb(0, 0), (Rgb{1, 0, 0})) << ours;
    EXPECT_TRUE(with(ours).warnings.empty()) << ours;
  }
  for (const char* nonsense :
       {"1 1 1 1 1 1 1 1", "nan 0 0 0 0 0 0 0", "0.64 0.33", "", "0.64 0.33 0.3 0.6 0.15 0.06 9 9"}) {
    EXPECT_EQ(with(nonsense).image.rgb(0, 0), (Rgb{1, 0, 0})) << nonsense;
    EXPECT_EQ(with(nonsense).warnings.size(), 1u) << nonsense;
  }
  const LoadedImage wide = with("0.708 0.292 0.170 0.797 0.131 0.046 0.3127 0.3290");
  EXPECT_NEAR(wide.image.rgb(0, 0).r, 1.6605, 1e-4);
  EXPECT_NEAR(wide.image.rgb(0, 0).g, -0.1246, 1e-4);
  EXPECT_NEAR(wide.image.rgb(1, 0).g, 1, 1e-6);
}

TEST(Rgbe, WhatIsWrongIsSaid) {
  const std::string pixel = flat({{128, 64, 32, 131}});
  EXPECT_EQ(error_of("hello\n"),
            "a.hdr: is not a readable picture (no #?RADIANCE at its start): a picture such as .hdr, .exr, .png, .jpg "
            "or .tif");
  EXPECT_NE(error_of("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n").find("its header does not end"), std::string::npos);
  EXPECT_NE(error_of("#?RADIANCE\nFORMAT=ascii\n\n-Y 1 +X 1\n" + pixel).find("the format 'ascii'"), std::string::npos);
  EXPECT_NE(
      error_of("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n" + pixel).find("differ"),
      std::string::npos);
  for (const char* size : {"", "-Y 1", "-Y 1 +Y 1", "-X 1 +X 1", "Y 1 X 1", "-Y 1 +X 1 3", "-Y1 +X1", "-Y x +X 1",
                           "1 1", "-Y 99999999999 +X 1", "-Y 1.5 +X 1"})
    EXPECT_NE(error_of(file_of("", size, pixel)).find("no size such as '-Y 512 +X 1024'"), std::string::npos) << size;
  EXPECT_NE(error_of(file_of("", "-Y 0 +X 4", pixel)).find("has 4 x 0 pixels"), std::string::npos);
  EXPECT_NE(error_of(file_of("", "-Y -2 +X 4", pixel)).find("has 4 x -2 pixels"), std::string::npos);
  EXPECT_NE(error_of(file_of("", "-Y 2000 +X 2000", pixel)).find("at most 1048576 pixels"), std::string::npos);
  EXPECT_NE(error_of(file_of("", "-Y 2000000000 +X 2000000000", pixel)).find("at most 1048576 pixels"),
            std::string::npos);
  EXPECT_NE(error_of(file_of("", "-Y 2 +X 1", pixel)).find("ends too soon"), std::string::npos);
  // Runs before any pixel, beyond the scanline, and with more digits than any count has.
  EXPECT_NE(error_of(file_of("", "-Y 1 +X 2", flat({{1, 1, 1, 2}}))).find("leaves its scanline"), std::string::npos);
  EXPECT_NE(error_of(file_of("", "-Y 1 +X 2", pixel + flat({{1, 1, 1, 2}}))).find("leaves its scanline"),
            std::string::npos);
  EXPECT_NE(error_of(file_of("", "-Y 1 +X 2", pixel + flat(Pixels(5, {1, 1, 1, 0})))).find("leaves its scanline"),
            std::string::npos);
  const std::string start = {2, 2, 0, 8};
  EXPECT_NE(error_of(file_of("", "-Y 1 +X 9", start + std::string(64, 1))).find("another length"), std::string::npos);
  EXPECT_NE(error_of(file_of("", "-Y 1 +X 8", start + std::string(2, '\x89'))).find("leaves its scanline"),
            std::string::npos);
  EXPECT_NE(error_of(file_of("", "-Y 1 +X 8", start + std::string(64, 0))).find("leaves its scanline"),
            std::string::npos);
}

TEST(Rgbe, DamagedFilesAreReadOrRefused) {
  for (const auto& encode_run : {flat, old_rle, new_rle}) {
    const auto bytes = bytes_of_text(encoded(16, 4, "-Y +X", encode_run));
    fuzz_decoder(bytes, 60, 3000, [](auto b) { return decode(b); });
  }
}

TEST(Rgbe, EncodedPicturesComeBackAndHaveNoBias) {
  Image image(256, 64);
  double sum = 0, back_sum = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const double value = std::exp2(-20 + 40.0 * x / image.width + 0.01 * y);
      image.set_rgb(x, y, {value, 0.7 * value, 0.01 * y * value});
    }
  image.set_rgb(3, 3, {});
  image.set_rgb(4, 3, {0, 0, 255.7});  // rounds up to the next exponent
  image.set_rgb(5, 3, {1e-42, 0, 0});  // smaller than any value
  image.set_rgb(6, 3, {1.6e38, 1, 0});
  const auto bytes = encode_rgbe(image, "a.hdr");
  const LoadedImage back = decode(std::span<const std::byte>(bytes));
  EXPECT_TRUE(back.warnings.empty());
  ASSERT_EQ(back.image.width, image.width);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const Rgb a = image.rgb(x, y), b = back.image.rgb(x, y);
      const double largest = std::max({a.r, a.g, a.b});
      EXPECT_NEAR(b.r, a.r, largest / 256 + 1e-40) << x << " " << y;
      EXPECT_NEAR(b.g, a.g, largest / 256) << x << " " << y;
      EXPECT_NEAR(b.b, a.b, largest / 256) << x << " " << y;
      if (largest > 0 && y > 3) sum += 1, back_sum += b.r / a.r;
    }
  EXPECT_NEAR(back_sum / sum, 1, 5e-5);  // truncation would lose 0.003
  EXPECT_EQ(back.image.rgb(4, 3), (Rgb{0, 0, 256}));
  // What was read is written as it was.
  EXPECT_EQ(encode_rgbe(back.image, "a.hdr"), bytes);
}

TEST(Rgbe, RefusesToWriteWhatItCannotHold) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInfinity = std::numeric_limits<double>::infinity();
  for (const double bad : {-1e-3, 2e38, kNan, kInfinity}) {
    Image image(3, 2);
    image.set_rgb(2, 1, {1, bad, 1});
    try {
      encode_rgbe(image, "a.hdr");
      ADD_FAILURE() << bad;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("of pixel 2, 1: values from 0 to 1.69e38"), std::string::npos)
          << error.what();
    }
  }
}

}  // namespace
}  // namespace shlight
