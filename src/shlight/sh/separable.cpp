#include "shlight/sh/separable.h"

#include <cassert>

#include "shlight/sh/rotation.h"

namespace shlight {

void SeparableSum::add_row(std::span<const double> legendre, std::span<const Rgb> moments) {
  const int bands = local_.bands();
  assert(static_cast<int>(legendre.size()) == bands * (bands + 1) / 2 && static_cast<int>(moments.size()) == 2 * bands);
  for (int l = 0; l < bands; ++l)
    for (int m = 0; m <= l; ++m) {
      const double p = legendre[static_cast<std::size_t>(l * (l + 1) / 2 + m)];
      local_.at(l, m) += p * moments[static_cast<std::size_t>(2 * m)];
      if (m > 0) local_.at(l, -m) += p * moments[static_cast<std::size_t>(2 * m + 1)];
    }
}

RgbCoefficients SeparableSum::to_world() const {
  // Local x, the azimuth's start, is the world's −Z; local y is +X; local z is up, +Y.
  return rotate(Rotation{{Vec3d{0, 1, 0}, Vec3d{0, 0, 1}, Vec3d{-1, 0, 0}}}, local_);
}

}  // namespace shlight
