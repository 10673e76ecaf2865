#include "shlight/truth/comparison.h"

#include <algorithm>

#include "shlight/core/assert.h"
#include "shlight/truth/picture_text.h"

namespace shlight {
namespace {

constexpr int kGap = 8, kLineHeight = kTextHeight + 6;
constexpr Rgb kPage = {0.02, 0.02, 0.02};

}  // namespace

Image8 make_comparison(const std::vector<ComparedPicture>& pictures) {
  SHLIGHT_ASSERT_LT(std::size_t{0}, pictures.size());
  int width = -kGap, height = 0, lines = 0;
  for (const auto& [picture, text] : pictures) {
    width += picture.width + kGap;
    height = std::max(height, picture.height);
    lines = std::max(lines, static_cast<int>(text.size()));
  }
  Image8 page{width, height + kGap + lines * kLineHeight, {}};
  page.values.resize(4 * static_cast<std::size_t>(page.width) * static_cast<std::size_t>(page.height));
  for (int y = 0; y < page.height; ++y)
    for (int x = 0; x < page.width; ++x) set_pixel(page, x, y, kPage);

  int left = 0;
  for (const auto& [picture, text] : pictures) {
    const std::size_t row = 4 * static_cast<std::size_t>(picture.width);
    for (int y = 0; y < picture.height; ++y)
      std::copy_n(picture.values.begin() + static_cast<std::ptrdiff_t>(row * static_cast<std::size_t>(y)), row,
                  page.values.begin() + 4 * (static_cast<std::ptrdiff_t>(y) * page.width + left));
    for (std::size_t i = 0; i < text.size(); ++i)
      draw_text(page, left, height + kGap + static_cast<int>(i) * kLineHeight,
                text[i].substr(0, static_cast<std::size_t>(picture.width / kTextAdvance)));
    left += picture.width + kGap;
  }
  return page;
}

}  // namespace shlight
