#include "shlight/image/chromaticities.h"

#include <cmath>

namespace shlight {
namespace {

using Column = std::array<double, 3>;

// Cone responses from XYZ.
constexpr ColourMatrix kBradford = {{{0.8951, 0.2664, -0.1614}, {-0.7502, 1.7135, 0.0367}, {0.0389, -0.0685, 1.0296}}};

Column multiply(const ColourMatrix& a, const Column& b) {
  Column product = {};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) product[i] += a[i][k] * b[k];
  return product;
}

ColourMatrix multiply(const ColourMatrix& a, const ColourMatrix& b) {
  ColourMatrix product = {};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k) product[i][j] += a[i][k] * b[k][j];
  return product;
}

// By cofactors; nothing where the determinant is not above `least` in size.
std::optional<ColourMatrix> invert(const ColourMatrix& m, double least) {
  const auto cofactor = [&](std::size_t i, std::size_t j) {
    const std::size_t a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
    return m[a][c] * m[b][d] - m[a][d] * m[b][c];
  };
  const double determinant = m[0][0] * cofactor(0, 0) + m[0][1] * cofactor(0, 1) + m[0][2] * cofactor(0, 2);
  if (!(std::abs(determinant) > least)) return {};
  ColourMatrix inverse;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) inverse[j][i] = cofactor(i, j) / determinant;
  return inverse;
}

Column xyz_of(Chromaticity c) {
  return {c.x, c.y, 1 - c.x - c.y};
}

// XYZ from RGB, in which RGB (1, 1, 1) is white with Y = 1. Columns are the primaries, scaled to make that white.
std::optional<ColourMatrix> xyz_from(const Chromaticities& from) {
  for (const Chromaticity c : {from.red, from.green, from.blue, from.white})
    if (!(std::abs(c.x) <= 2 && std::abs(c.y) <= 2)) return {};
  if (!(from.white.y > 1e-3)) return {};
  const Column red = xyz_of(from.red), green = xyz_of(from.green), blue = xyz_of(from.blue);
  ColourMatrix matrix;
  for (std::size_t i = 0; i < 3; ++i) matrix[i] = {red[i], green[i], blue[i]};
  constexpr double kLeastArea = 1e-3;  // twice the triangle's; Rec. 709's is 0.22
  const auto inverse = invert(matrix, kLeastArea);
  if (!inverse) return {};
  Column scale = multiply(*inverse, xyz_of(from.white));
  for (std::size_t j = 0; j < 3; ++j) {
    if (!(scale[j] > 1e-3)) return {};  // white lies outside of the triangle or on its side
    for (std::size_t i = 0; i < 3; ++i) matrix[i][j] *= scale[j] / from.white.y;
  }
  return matrix;
}

}  // namespace

std::optional<ColourMatrix> rec709_from(const Chromaticities& from) {
  const auto xyz = xyz_from(from);
  if (!xyz) return {};
  const Column ours = multiply(kBradford, multiply(*xyz_from(kRec709), Column{1, 1, 1}));
  const Column theirs = multiply(kBradford, multiply(*xyz, Column{1, 1, 1}));
  ColourMatrix adapted = multiply(kBradford, *xyz);
  for (std::size_t i = 0; i < 3; ++i) {
    if (!(theirs[i] > 1e-3)) return {};
    for (double& value : adapted[i]) value *= ours[i] / theirs[i];
  }
  return multiply(*invert(multiply(kBradford, *xyz_from(kRec709)), 0), adapted);
}

bool is_nearly_identity(const ColourMatrix& matrix) {
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      if (std::abs(matrix[i][j] - (i == j ? 1 : 0)) > 1.0 / 2000) return false;
  return true;
}

void convert_colours(const ColourMatrix& m, Image& image) {
  for (std::size_t i = 0; i < image.values.size(); i += 3) {
    float* p = image.values.data() + i;
    const Column converted = multiply(m, Column{p[0], p[1], p[2]});
    for (std::size_t c = 0; c < 3; ++c) p[c] = static_cast<float>(converted[c]);
  }
}

}  // namespace shlight
