#include "shlight/image/image_io.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

#include "shlight/core/error.h"
#include "shlight/core/file.h"
#include "shlight/core/temporary_folder.h"

namespace shlight {
namespace {

Image some_image() {
  Image image(5, 3);
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 5; ++x) image.set_rgb(x, y, {x + 0.5, y + 0.25, -1.0 * x * y});
  return image;
}

std::string error_of(const std::filesystem::path& path, const LoadImageParams& params = {}) {
  try {
    load_image(path, params);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(ImageIo, ExrRoundTrip) {
  const TemporaryFolder folder;
  const Image image = some_image();
  save_image(folder / "a.exr", image);
  const Image back = load_image(folder / "a.exr").image;
  EXPECT_EQ(back.width, 5);
  EXPECT_EQ(back.height, 3);
  EXPECT_EQ(back.values, image.values);  // all are exact in half
}

TEST(ImageIo, ExrKeepsASunAndWhatIsNotANumber) {
  const TemporaryFolder folder;
  Image image = some_image();
  image.set_rgb(1, 1, {1e6, NAN, std::numeric_limits<float>::infinity()});
  save_image(folder / "a.exr", image);
  const Image back = load_image(folder / "a.exr").image;
  EXPECT_EQ(back.pixel(1, 1)[0], 1e6f);
  EXPECT_TRUE(std::isnan(back.pixel(1, 1)[1]));
  EXPECT_TRUE(std::isinf(back.pixel(1, 1)[2]));
}

TEST(ImageIo, RgbeIsMantissaTimesTwoToTheExponentMinus136) {
  const TemporaryFolder folder;
  std::string file = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n";
  for (const int byte : {128, 64, 1, 129, 255, 0, 3, 137}) file += static_cast<char>(byte);
  write_file(folder / "a.hdr", file);
  const Image image = load_image(folder / "a.hdr").image;
  ASSERT_EQ(image.values.size(), 6u);
  EXPECT_EQ(image.rgb(0, 0), (Rgb{1, 0.5, 1.0 / 128}));
  EXPECT_EQ(image.rgb(1, 0), (Rgb{510, 0, 6}));
}

TEST(ImageIo, PngRoundTripAndLinearisation) {
  const TemporaryFolder folder;
  Image8 image{2, 1, {0, 128, 255, 255, 10, 20, 30, 128}};
  save_image8(folder / "a.png", image);
  EXPECT_EQ(load_image8(folder / "a.png").values, image.values);
  const Image linear = load_image(folder / "a.png").image;
  EXPECT_EQ(linear.pixel(0, 0)[0], 0);
  EXPECT_NEAR(linear.pixel(0, 0)[1], 0.2158605, 1e-6);
  EXPECT_EQ(linear.pixel(0, 0)[2], 1);

  const auto bytes = read_file(folder / "a.png", 1 << 20);
  EXPECT_EQ(load_image8(bytes, "memory.png").values, image.values);
}

TEST(ImageIo, RefusesWhatIsNoPicture) {
  const TemporaryFolder folder;
  EXPECT_EQ(error_of(folder / "none.hdr"),
            (folder / "none.hdr").string() + ": no such file: a picture such as .hdr, .exr, .png, .jpg or .tif");
  EXPECT_EQ(error_of(folder.path()),
            folder.path().string() + ": is not a regular file: a picture such as .hdr, .exr, .png, .jpg or .tif");
  write_file(folder / "empty.exr", std::string_view());
  write_file(folder / "text.hdr", std::string_view("hello"));
  write_file(folder / "zero.hdr", std::string_view("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 0 +X 0\n"));
  write_file(folder / "huge.hdr", std::string_view("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 100000 +X 100000\n"));
  for (const char* name : {"empty.exr", "text.hdr", "zero.hdr", "huge.hdr"}) {
    const std::string error = error_of(folder / name);
    EXPECT_TRUE(error.starts_with((folder / name).string() + ": ")) << error;
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
  }
}

TEST(ImageIo, RefusesTruncatedPictures) {
  const TemporaryFolder folder;
  Image image(64, 64);
  for (std::size_t i = 0; i < image.values.size(); ++i) image.values[i] = static_cast<float>(i % 1013);
  save_image(folder / "whole.exr", image);
  const auto bytes = read_file(folder / "whole.exr", 1 << 20);
  for (const double fraction : {0.01, 0.3, 0.7, 0.99}) {
    write_file(folder / "cut.exr", std::span(bytes).first(static_cast<std::size_t>(fraction * double(bytes.size()))));
    EXPECT_NE(error_of(folder / "cut.exr"), "no error") << fraction;
  }
}

TEST(ImageIo, RefusesMorePixelsThanAllowed) {
  const TemporaryFolder folder;
  save_image(folder / "a.exr", some_image());
  LoadImageParams params;
  params.max_pixels = 14;
  EXPECT_EQ(error_of(folder / "a.exr", params), (folder / "a.exr").string() + ": has 5 x 3 pixels: at most 14 pixels");
}

TEST(ImageIo, RefusesToWriteUnknownFormats) {
  const TemporaryFolder folder;
  EXPECT_THROW(save_image(folder / "a.xyz", some_image()), Error);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

// Every damaged picture is either read to the end or refused in one line; none crashes, hangs or fills the memory.
TEST(ImageIo, DamagedPicturesAreRefusedCleanly) {
  const char* data = std::getenv("SHLIGHT_TEST_DATA");
  if (!data) GTEST_SKIP() << "SHLIGHT_TEST_DATA names no folder";
  LoadImageParams params;
  int read = 0, refused = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(std::filesystem::path(data) / "bad/image")) {
    if (!entry.is_regular_file()) continue;
    try {
      const Image image = load_image(entry.path(), params).image;
      EXPECT_EQ(image.values.size(), 3 * image.num_pixels());
      ++read;
    } catch (const Error& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
      ++refused;
    }
  }
  RecordProperty("read", read);
  EXPECT_GT(refused, 20);
}

}  // namespace
}  // namespace shlight
