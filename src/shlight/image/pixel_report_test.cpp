#include "shlight/image/pixel_report.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace shlight {
namespace {

TEST(PixelReport, CountsPixelsAndNamesTheFirst) {
  Image image(4, 3);
  image.set_rgb(1, 0, {0, -1, 2});
  image.set_rgb(2, 1, {NAN, NAN, -3});
  image.set_rgb(3, 1, {NAN, 1, 1});
  image.pixel(0, 2)[2] = std::numeric_limits<float>::infinity();
  const PixelReport report = report_pixels(image);
  EXPECT_EQ(report.nan, 2u);
  EXPECT_EQ(report.inf, 1u);
  EXPECT_EQ(report.negative, 2u);
  EXPECT_EQ(report.first_nan->x, 2);
  EXPECT_EQ(report.first_nan->y, 1);
  EXPECT_EQ(report.min, -3);
  EXPECT_EQ(report.max, 2);
  EXPECT_EQ(describe(report),
            "2 pixels with NaN (first at 2, 1), taken as 0; 1 pixel with infinite values (first at 0, 2), taken as 0; "
            "2 pixels with negative values (first at 1, 0), kept");
  repair_pixels(image);
  const PixelReport after = report_pixels(image);
  EXPECT_EQ(after.nan + after.inf, 0u);
  EXPECT_EQ(after.negative, 2u);
  EXPECT_EQ(image.pixel(2, 1)[0], 0);
}

TEST(PixelReport, CleanPicturesAreClean) {
  Image image(4, 3);
  image.set_rgb(1, 1, {1, 2, 3});
  const PixelReport report = report_pixels(image);
  EXPECT_TRUE(report.clean());
  EXPECT_EQ(report.min, 0);
  EXPECT_EQ(report.max, 3);
  EXPECT_EQ(describe(report), "");
  EXPECT_TRUE(report_pixels(Image()).clean());
}

TEST(PixelReport, NothingFiniteLeavesTheRangeEmpty) {
  Image image(1, 1);
  image.set_rgb(0, 0, {NAN, NAN, NAN});
  const PixelReport report = report_pixels(image);
  EXPECT_EQ(report.nan, 1u);
  EXPECT_EQ(report.min, 0);
  EXPECT_EQ(report.max, 0);
}

}  // namespace
}  // namespace shlight
