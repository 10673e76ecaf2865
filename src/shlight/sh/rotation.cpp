#include "shlight/sh/rotation.h"

#include <cassert>
#include <cmath>
#include <cstdlib>

namespace shlight {
namespace {

// One band from the one below it, in the symbols of [1, tables 1 and 2]: block l has the elements R^l_{m,n}, r is the
// block of degree 1 (rows and columns y, z, x for −1, 0, 1).
class BandRecursion {
 public:
  BandRecursion(int l, const std::vector<double>& r, const std::vector<double>& below) : l_(l), r_(r), below_(below) {}

  double element(int m, int n) const {
    const int am = std::abs(m);
    const double d = m == 0 ? 1 : 0;
    const double denominator = std::abs(n) < l_ ? (l_ + n) * (l_ - n) : (2.0 * l_) * (2 * l_ - 1);
    const double u = std::sqrt((l_ + m) * (l_ - m) / denominator);
    const double v = 0.5 * std::sqrt((1 + d) * (l_ + am - 1) * (l_ + am) / denominator) * (1 - 2 * d);
    const double w = -0.5 * std::sqrt((l_ - am - 1) * (l_ - am) / denominator) * (1 - d);
    // A factor of zero goes with a term that does not exist.
    double sum = 0;
    if (u != 0) sum += u * p(0, m, n);
    if (v != 0) sum += v * v_term(m, n);
    if (w != 0) sum += w * w_term(m, n);
    return sum;
  }

 private:
  double r(int i, int j) const { return r_[static_cast<std::size_t>((i + 1) * 3 + j + 1)]; }
  double below(int a, int b) const {
    return below_[static_cast<std::size_t>((a + l_ - 1) * (2 * l_ - 1) + b + l_ - 1)];
  }

  double p(int i, int a, int n) const {
    if (n == l_) return r(i, 1) * below(a, l_ - 1) - r(i, -1) * below(a, -l_ + 1);
    if (n == -l_) return r(i, 1) * below(a, -l_ + 1) + r(i, -1) * below(a, l_ - 1);
    return r(i, 0) * below(a, n);
  }

  double v_term(int m, int n) const {
    if (m == 0) return p(1, 1, n) + p(-1, -1, n);
    if (m > 0) {
      if (m == 1) return std::sqrt(2.0) * p(1, 0, n);
      return p(1, m - 1, n) - p(-1, -m + 1, n);
    }
    if (m == -1) return std::sqrt(2.0) * p(-1, 0, n);
    return p(1, m + 1, n) + p(-1, -m - 1, n);
  }

  double w_term(int m, int n) const {
    if (m > 0) return p(1, m + 1, n) + p(-1, -m - 1, n);
    return p(1, m - 1, n) - p(-1, -m + 1, n);
  }

  int l_;
  const std::vector<double>& r_;
  const std::vector<double>& below_;
};

}  // namespace

Rotation rotation_about_y(double radians) {
  const double c = std::cos(radians), s = std::sin(radians);
  return {{Vec3d{c, 0, s}, Vec3d{0, 1, 0}, Vec3d{-s, 0, c}}};
}

RotationMatrix::RotationMatrix(int bands, const Rotation& rotation) {
  assert(bands >= 0);
  blocks_.resize(static_cast<std::size_t>(bands));
  if (bands > 0) blocks_[0] = {1};
  if (bands < 2) return;
  // Degree 1 is the rotation itself, in the basis's sequence of axes y, z, x.
  const auto& [x, y, z] = rotation.rows;
  blocks_[1] = {y.y, y.z, y.x, z.y, z.z, z.x, x.y, x.z, x.x};
  for (int l = 2; l < bands; ++l) {
    const BandRecursion recursion(l, blocks_[1], blocks_[static_cast<std::size_t>(l - 1)]);
    std::vector<double>& block = blocks_[static_cast<std::size_t>(l)];
    block.reserve(static_cast<std::size_t>((2 * l + 1) * (2 * l + 1)));
    for (int m = -l; m <= l; ++m)
      for (int n = -l; n <= l; ++n) block.push_back(recursion.element(m, n));
  }
}

RgbCoefficients rotate(const RotationMatrix& matrix, const RgbCoefficients& coefficients) {
  assert(matrix.bands() >= coefficients.bands());
  RgbCoefficients result(coefficients.bands());
  for (int l = 0; l < coefficients.bands(); ++l)
    for (int m = -l; m <= l; ++m)
      for (int m2 = -l; m2 <= l; ++m2) result.at(l, m) += matrix.at(l, m, m2) * coefficients.at(l, m2);
  return result;
}

RgbCoefficients rotate(const Rotation& rotation, const RgbCoefficients& coefficients) {
  return rotate(RotationMatrix(coefficients.bands(), rotation), coefficients);
}

}  // namespace shlight
