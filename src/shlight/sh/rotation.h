#pragma once

#include <array>
#include <vector>

#include "shlight/sh/coefficients.h"
#include "shlight/sh/vec.h"

// Turning functions on the sphere by turning their coefficients.
//
// [1] Ivanic & Ruedenberg 1996, Rotation Matrices for Real Spherical Harmonics. Direct Determination by Recursion,
//     J. Phys. Chem. 100(15), with the corrections of 102(45), 1998.

namespace shlight {

// Rows of a rotation: the world after it, v' = (rows[0]·v, rows[1]·v, rows[2]·v).
struct Rotation {
  std::array<Vec3d, 3> rows = {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}};
  Vec3d operator()(Vec3d v) const { return {dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)}; }
};

// Counter-clockwise about +Y, seen from above (from +Y): takes +Z to +X.
Rotation rotation_about_y(double radians);

// The blocks of the matrix that turns coefficients, band by band: block l is (2l+1) x (2l+1), row by row, indexed
// [(m + l)(2l+1) + (m' + l)]. O(bands³) numbers.
class RotationMatrix {
 public:
  RotationMatrix(int bands, const Rotation& rotation);
  int bands() const { return static_cast<int>(blocks_.size()); }
  double at(int l, int m, int m2) const {
    return blocks_[static_cast<std::size_t>(l)][static_cast<std::size_t>((m + l) * (2 * l + 1) + m2 + l)];
  }

 private:
  std::vector<std::vector<double>> blocks_;
};

// The coefficients of the turned function, f'(v) = f(R⁻¹ v): a light from direction d then comes from R d.
// The matrix has at least as many bands as the coefficients.
RgbCoefficients rotate(const RotationMatrix& matrix, const RgbCoefficients& coefficients);
RgbCoefficients rotate(const Rotation& rotation, const RgbCoefficients& coefficients);

}  // namespace shlight
