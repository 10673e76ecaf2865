// The golden value by which a convention of spherical harmonics is known: the coefficients of a unit delta light.

#include <array>
#include <cmath>
#include <cstdio>

#include "shlight/sh/basis.h"

int main() {
  constexpr std::array<double, 9> kGolden = {.282095, .234529, .390882, .175897, .188792,
                                             .419539, .290160, .314654, -.055064};
  std::array<double, 9> values;
  shlight::eval_basis<double>(3, {.36, .48, .80}, values);
  bool same = true;
  for (std::size_t i = 0; i < values.size(); ++i) {
    std::printf("%9.6f\n", values[i]);
    same = same && std::abs(values[i] - kGolden[i]) < 1e-6;  // six printed digits
  }
  return same ? 0 : 1;
}
