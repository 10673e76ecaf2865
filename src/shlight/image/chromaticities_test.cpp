#include "shlight/image/chromaticities.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace shlight {
namespace {

void expect_matrix(const ColourMatrix& matrix, const ColourMatrix& expected, double tolerance) {
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) EXPECT_NEAR(matrix[i][j], expected[i][j], tolerance) << i << " " << j;
}

constexpr ColourMatrix kIdentity = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
constexpr Chromaticities kRec2020 = {{0.708, 0.292}, {0.170, 0.797}, {0.131, 0.046}, {0.3127, 0.3290}};
constexpr Chromaticities kAp0 = {{0.7347, 0.2653}, {0, 1}, {0.0001, -0.0770}, {0.32168, 0.33767}};
constexpr Chromaticities kRadiance = {{0.640, 0.330}, {0.290, 0.600}, {0.150, 0.060}, {0.3333, 0.3333}};

TEST(Chromaticities, Rec709IsItself) {
  expect_matrix(*rec709_from(kRec709), kIdentity, 1e-14);
  EXPECT_TRUE(is_nearly_identity(*rec709_from(kRec709)));
}

// Whatever the primaries are, equal parts of them are white, and white is white.
TEST(Chromaticities, WhiteStaysWhite) {
  for (const Chromaticities& from : {kRec2020, kAp0, kRadiance, kCieXyz}) {
    const ColourMatrix matrix = *rec709_from(from);
    for (const auto& row : matrix) EXPECT_NEAR(row[0] + row[1] + row[2], 1, 1e-12);
  }
}

// ITU-R BT.2087's inverse, to the four digits it is printed with; AP0 by Bradford as ACES's own transforms have it.
TEST(Chromaticities, PublishedMatrices) {
  expect_matrix(*rec709_from(kRec2020),
                {{{1.6605, -0.5876, -0.0728}, {-0.1246, 1.1329, -0.0083}, {-0.0182, -0.1006, 1.1187}}}, 6e-5);
  EXPECT_FALSE(is_nearly_identity(*rec709_from(kRadiance)));
}

// Rec. 709 primaries that were adapted to another white by the same transform come back as themselves: here to D50, as
// ICC profiles state sRGB, with six digits.
TEST(Chromaticities, AdaptedPrimariesComeBack) {
  const Chromaticities srgb_at_d50 = {
      {0.648447, 0.330877}, {0.321187, 0.597894}, {0.155901, 0.0660563}, {0.345708, 0.358541}};
  expect_matrix(*rec709_from(srgb_at_d50), kIdentity, 1e-4);
  EXPECT_TRUE(is_nearly_identity(*rec709_from(srgb_at_d50)));
}

TEST(Chromaticities, NonsenseHasNoMatrix) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(rec709_from({}));
  EXPECT_FALSE(rec709_from({{0.64, 0.33}, {0.64, 0.33}, {0.15, 0.06}, {0.31, 0.33}}));  // two the same
  EXPECT_FALSE(rec709_from({{0.1, 0.1}, {0.2, 0.2}, {0.3, 0.3}, {0.31, 0.33}}));        // on a line
  EXPECT_FALSE(rec709_from({{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, {0.1, 0.8}}));    // white outside
  EXPECT_FALSE(rec709_from({{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, {0.3, 0}}));
  EXPECT_FALSE(rec709_from({{kNan, 0.33}, {0.30, 0.60}, {0.15, 0.06}, {0.3, 0.3}}));
  EXPECT_FALSE(rec709_from({{0.64, kInfinity}, {0.30, 0.60}, {0.15, 0.06}, {0.3, 0.3}}));
}

TEST(Chromaticities, EveryPixelIsConverted) {
  Image image(2, 2);
  for (int i = 0; i < 4; ++i) image.set_rgb(i % 2, i / 2, {i + 1.0, 2, -1});
  Image converted = image;
  const ColourMatrix m = {{{1, 2, 3}, {0, 1, 0}, {0.5, 0, 0}}};
  convert_colours(m, converted);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(converted.rgb(i % 2, i / 2), (Rgb{i + 1.0 + 4 - 3, 2, 0.5 * (i + 1)}));
}

}  // namespace
}  // namespace shlight
