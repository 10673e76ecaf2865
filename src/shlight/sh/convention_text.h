#pragma once

#include <string_view>

// What files that hold coefficients say of the convention they are in, word for word. To it comes what each kind of
// file holds: the quantity, and what else there is to say of the frame.

namespace shlight::convention {

inline constexpr std::string_view kBasis = "real, orthonormal";
inline constexpr bool kCondonShortleyPhase = false;
inline constexpr std::string_view kIndex = "l(l+1)+m";
inline constexpr std::string_view kPolynomials =
    ".282095, .488603 y, .488603 z, .488603 x, 1.092548 xy, 1.092548 yz, .315392(3z^2-1), 1.092548 xz, "
    ".546274(x^2-y^2), ...";
inline constexpr std::string_view kFrame = "right-handed, +Y up, -Z forward, directions toward the light";
inline constexpr std::string_view kColor = "linear Rec. 709";

}  // namespace shlight::convention
