#include "shlight/truth/image_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "shlight/core/error.h"
#include "shlight/image/tone_map.h"
#include "shlight/truth/truth_test_util.h"

namespace shlight {
namespace {

ImageErrorParams radiance() {
  ImageErrorParams params;
  params.meaning = Meaning::kRadiance;
  return params;
}

TEST(ImageError, EqualPicturesHaveNone) {
  const Image a = noise_image(20, 20, 1);
  for (const ImageErrorParams& params : {ImageErrorParams{}, radiance()}) {
    const ImageError error = measure_error(a, a, params);
    EXPECT_EQ(error.rmse, 0);
    EXPECT_EQ(error.relative, 0);
    EXPECT_EQ(error.max_error, 0);
    EXPECT_EQ(error.psnr, std::numeric_limits<double>::infinity());
    EXPECT_NEAR(error.ssim, 1, 1e-6);
    EXPECT_EQ(error.flip, 0);
    EXPECT_TRUE(error.worst.empty());
  }
}

// One channel of one pixel of 32 is off by 0.5 of a grey of 1.
TEST(ImageError, OfRadianceIsItsDefinition) {
  const Image b = constant_image(8, 4, {1, 1, 1});
  Image a = b;
  a.set_rgb(3, 2, {1, 1.5, 1});
  const ImageError error = measure_error(a, b, radiance());
  const double expected = 0.5 / std::sqrt(3 * 32.0);
  EXPECT_NEAR(error.rmse, expected, 1e-9);
  EXPECT_NEAR(error.relative, expected, 1e-9);
  EXPECT_NEAR(error.psnr, -20 * std::log10(expected), 1e-6);
  EXPECT_EQ(error.max_error, 0.5);
  ASSERT_EQ(error.worst.size(), 1u);
  EXPECT_EQ(error.worst[0].pixel, (Pixel{3, 2}));
  EXPECT_EQ(error.worst[0].test.g, 1.5);
  EXPECT_EQ(error.worst[0].reference.g, 1);
  EXPECT_EQ(error.difference.at(3, 2), 0.5f);
}

// Two bytes, 128 and 138, a picture apart.
TEST(ImageError, OfWhatIsShownIsOfItsBytes) {
  const auto grey = [](int byte) {
    const double v = decode_srgb(byte / 255.0);
    return constant_image(6, 6, {v, v, v});
  };
  const ImageError error = measure_error(grey(138), grey(128));
  EXPECT_NEAR(error.rmse, 10 / 255.0, 1e-6);
  EXPECT_NEAR(error.psnr, 20 * std::log10(25.5), 1e-3);
  EXPECT_NEAR(error.relative, 10.0 / 128, 1e-6);
}

TEST(ImageError, GrowsWithTheDifference) {
  const Image b = noise_image(24, 24, 2), n = noise_image(24, 24, 3);
  for (ImageErrorParams params : {ImageErrorParams{}, radiance()}) {
    params.num_worst = 0;
    ImageError before;
    before.psnr = before.ssim = std::numeric_limits<double>::infinity();
    for (const float amount : {0.02f, 0.1f, 0.5f}) {
      Image a = b;
      for (std::size_t i = 0; i < a.values.size(); ++i) a.values[i] = std::lerp(b.values[i], n.values[i], amount);
      const ImageError error = measure_error(a, b, params);
      EXPECT_GT(error.rmse, before.rmse);
      EXPECT_GT(error.flip, before.flip);
      EXPECT_GT(error.max_error, before.max_error);
      EXPECT_LT(error.psnr, before.psnr);
      EXPECT_LT(error.ssim, before.ssim);
      EXPECT_TRUE(error.worst.empty());
      before = error;
    }
  }
}

TEST(ImageError, WorstPixelsAreOfDifferentPlaces) {
  const Image b = constant_image(60, 40, {});
  Image a = b;
  a.set_rgb(10, 10, {0, 0, 1});
  a.set_rgb(11, 10, {0.9, 0, 0});
  a.set_rgb(50, 30, {0, 0.5, 0});
  ImageErrorParams params = radiance();
  const ImageError error = measure_error(a, b, params);
  ASSERT_EQ(error.worst.size(), 2u);
  EXPECT_EQ(error.worst[0].pixel, (Pixel{10, 10}));
  EXPECT_EQ(error.worst[1].pixel, (Pixel{50, 30}));
  EXPECT_TRUE(std::isinf(error.relative)) << "of a black reference";
  EXPECT_TRUE(std::isinf(error.psnr) && error.psnr < 0) << "a peak of 0";
}

TEST(ImageError, RefusesWhatCannotBeCompared) {
  const auto message = [](const Image& a, const Image& b) -> std::string {
    try {
      check_comparable(a, "a.exr", b, "b.exr");
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  Image a(4, 3);
  EXPECT_EQ(message(a, Image(4, 3)), "");
  EXPECT_EQ(message(a, Image(3, 4)), "a.exr: 4 x 3 pixels, but b.exr has 3 x 4: two pictures of one size");
  Image bad = a;
  bad.set_rgb(2, 1, {0, std::numeric_limits<double>::quiet_NaN(), 0});
  EXPECT_EQ(message(a, bad), "b.exr: 1 pixels with NaN and 0 with infinite values, the first at 2, 1: finite pixels");
  bad.set_rgb(2, 1, {0, 0, -std::numeric_limits<double>::infinity()});
  EXPECT_EQ(message(bad, a), "a.exr: 0 pixels with NaN and 1 with infinite values, the first at 2, 1: finite pixels");
}

}  // namespace
}  // namespace shlight
