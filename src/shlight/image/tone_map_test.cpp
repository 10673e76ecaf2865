#include "shlight/image/tone_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace shlight {
namespace {

TEST(ToneMap, SrgbThereAndBack) {
  // The standard's two pieces meet to 3e-8 of linear light.
  for (int i = 0; i <= 1000; ++i) EXPECT_NEAR(encode_srgb(decode_srgb(i / 1000.0)), i / 1000.0, 1e-6) << i;
  EXPECT_NEAR(decode_srgb(128 / 255.0), 0.2158605, 1e-7);
}

TEST(ToneMap, KeepsMiddleGreyAndItsSequence) {
  const double middle = tone_map({0.18, 0.18, 0.18}).g;
  EXPECT_NEAR(middle, 0.18, 1e-12);
  EXPECT_EQ(tone_map({}), Rgb{});
  double before = 0;
  for (double stops = -14; stops <= 14; stops += 0.25) {
    const Rgb shown = tone_map(std::exp2(stops) * Rgb{1, 1, 1});
    EXPECT_GT(shown.g, before) << stops;
    EXPECT_LT(shown.g, 1) << stops;
    EXPECT_NEAR(shown.r, shown.b, 1e-12);
    before = shown.g;
  }
}

TEST(ToneMap, IsDefinedForAllNumbers) {
  const double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(tone_map({nan, -1, 0}), Rgb{});
  EXPECT_GT(tone_map({inf, inf, inf}).r, 0.9999);
  Image image(2, 1);
  image.set_rgb(1, 0, {inf, inf, inf});
  EXPECT_EQ(make_picture8(image, 1).values, (std::vector<unsigned char>{0, 0, 0, 255, 255, 255, 255, 255}));
}

TEST(AutoExposure, TakesTheMeanToOneStopAboveMiddleGrey) {
  RgbCoefficients light(3);
  light[0] = std::sqrt(4 * std::numbers::pi) * Rgb{5, 5, 5};
  EXPECT_NEAR(auto_exposure(light) * 5, 0.36, 1e-12);
  EXPECT_EQ(auto_exposure(RgbCoefficients(3)), 1);
  light[0] = {-1, -1, -1};
  EXPECT_EQ(auto_exposure(light), 1);
  EXPECT_EQ(auto_exposure(RgbCoefficients()), 1);
}

}  // namespace
}  // namespace shlight
