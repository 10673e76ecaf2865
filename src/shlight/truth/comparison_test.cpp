#include "shlight/truth/comparison.h"

#include <gtest/gtest.h>

#include "shlight/truth/picture_text.h"

namespace shlight {
namespace {

Image8 constant_picture(int width, int height, unsigned char value) {
  Image8 image{width, height, {}};
  image.values.assign(4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height), value);
  return image;
}

int red(const Image8& image, int x, int y) {
  return image
      .values[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x))];
}

// White pixels of a rectangle.
int ink(const Image8& image, int left, int top, int right, int bottom) {
  int count = 0;
  for (int y = top; y < bottom; ++y)
    for (int x = left; x < right; ++x) count += red(image, x, y) == 255;
  return count;
}

TEST(Comparison, HasPicturesSideBySideAndWordsUnderThem) {
  const Image8 page = make_comparison({{constant_picture(64, 40, 100), {"RMSE 0.5", "b"}},
                                       {constant_picture(50, 30, 200), {"far too long a line for it"}}});
  EXPECT_GT(page.width, 64 + 50);
  EXPECT_GT(page.height, 40 + 2 * kTextHeight);
  const int second = page.width - 50;
  EXPECT_EQ(red(page, 0, 0), 100);
  EXPECT_EQ(red(page, 63, 39), 100);
  EXPECT_EQ(red(page, second, 0), 200);
  EXPECT_EQ(red(page, page.width - 1, 29), 200);
  EXPECT_LT(red(page, second, 35), 60) << "the page below the lower picture";
  EXPECT_GT(ink(page, 0, 40, 64, page.height), 50) << "words under the first";
  EXPECT_GT(ink(page, second, 40, page.width, page.height), 50);
  EXPECT_EQ(ink(page, 64, 40, second, page.height), 0) << "and none between";
}

// Characters that look alike would make numbers lie.
TEST(PictureText, CharactersDiffer) {
  const std::string characters = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZ.,:%/+-=()|_";
  std::vector<Image8> drawn;
  for (const char c : characters) {
    drawn.push_back(constant_picture(kTextAdvance, kTextHeight, 0));
    draw_text(drawn.back(), 0, 0, std::string(1, c));
  }
  for (std::size_t i = 0; i < drawn.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_NE(drawn[i].values, drawn[j].values) << characters[i] << " and " << characters[j];
}

TEST(PictureText, IsCutAtTheEdge) {
  Image8 image = constant_picture(9, 9, 0);
  draw_text(image, -3, -4, "88888");
  EXPECT_GT(ink(image, 0, 0, 9, 9), 0);
}

}  // namespace
}  // namespace shlight
