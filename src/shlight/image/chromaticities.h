#pragma once

#include <array>
#include <optional>

#include "shlight/image/image.h"

namespace shlight {

// A colour's CIE 1931 x and y.
struct Chromaticity {
  double x = 0, y = 0;
};

// What a picture's red, green and blue are, and the white that equal parts of them make.
struct Chromaticities {
  Chromaticity red, green, blue, white;
};

inline constexpr Chromaticities kRec709 = {{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, {0.3127, 0.3290}};
// CIE XYZ itself, with the white of equal energy, as Radiance has it.
inline constexpr Chromaticities kCieXyz = {{1, 0}, {0, 1}, {0, 0}, {1.0 / 3, 1.0 / 3}};

using ColourMatrix = std::array<std::array<double, 3>, 3>;

// The matrix from linear RGB of these primaries to linear Rec. 709; white goes to white, by the linear Bradford
// transform [1]. Nothing where the primaries make no colour space: not finite, on a line, or white not between them.
//
// [1] ICC.1:2022 Annex E.3; Lindbloom, http://www.brucelindbloom.com, Chromatic Adaptation.
std::optional<ColourMatrix> rec709_from(const Chromaticities& from);

// Whether a matrix does no more than the rounding of a header's primaries would: each entry within 1/2000, the
// precision of a half, of the identity's. Leaving values alone is then more exact than converting them.
bool is_nearly_identity(const ColourMatrix& matrix);

// Multiplies every pixel by the matrix.
void convert_colours(const ColourMatrix& matrix, Image& image);

}  // namespace shlight
