#pragma once

#include <array>
#include <cstddef>
#include <span>
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

// First `second`, then `first`, as matrices are multiplied.
Rotation operator*(const Rotation& first, const Rotation& second);
Rotation inverse(const Rotation& rotation);

// Counter-clockwise, seen from the positive end of the axis: about +Y takes +Z to +X, about +Z takes +X to +Y.
Rotation rotation_about_y(double radians);
Rotation rotation_about_z(double radians);

// R_z(z2) R_y(y) R_z(z1): about z by z1 first, then about y, then about z by z2. Every rotation is one.
Rotation rotation_zyz(double z2, double y, double z1);

// From a quaternion w + xi + yj + zk of any length but zero.
Rotation rotation_from_quaternion(double w, double x, double y, double z);

// Whether the rows are orthonormal and right-handed to `tolerance`.
bool is_rotation(const Rotation& rotation, double tolerance = 1e-6);

// The blocks of the matrix that turns coefficients, band by band: block l is (2l+1) x (2l+1), row by row, indexed
// [(m + l)(2l+1) + (m' + l)]. O(bands³) numbers.
class RotationMatrix {
 public:
  RotationMatrix(int bands, const Rotation& rotation);
  int bands() const { return static_cast<int>(blocks_.size()); }
  std::span<const double> block(int l) const { return blocks_[static_cast<std::size_t>(l)]; }
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

// About z each pair (m, −m) turns by m times the angle: O(bands²) work, no matrix.
RgbCoefficients rotate_about_z(double radians, const RgbCoefficients& coefficients);

// Turns `count` vectors of the matrix's bands at once: values[i · count + j] is coefficient i of vector j, channels of
// a light count as vectors. `result` must not overlap `values`. The matrix is read once for sixteen vectors.
void rotate(const RotationMatrix& matrix, std::span<const float> values, std::span<float> result, std::size_t count);

}  // namespace shlight
