#include "shlight/sh/rotation.h"

#include <cassert>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <type_traits>

#include "shlight/sh/clones.h"

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

Rotation operator*(const Rotation& first, const Rotation& second) {
  const Rotation columns = inverse(second);
  Rotation product;
  for (std::size_t i = 0; i < 3; ++i) product.rows[i] = columns(first.rows[i]);
  return product;
}

Rotation inverse(const Rotation& rotation) {
  const auto& [x, y, z] = rotation.rows;
  return {{Vec3d{x.x, y.x, z.x}, Vec3d{x.y, y.y, z.y}, Vec3d{x.z, y.z, z.z}}};
}

Rotation rotation_about_y(double radians) {
  const double c = std::cos(radians), s = std::sin(radians);
  return {{Vec3d{c, 0, s}, Vec3d{0, 1, 0}, Vec3d{-s, 0, c}}};
}

Rotation rotation_about_z(double radians) {
  const double c = std::cos(radians), s = std::sin(radians);
  return {{Vec3d{c, -s, 0}, Vec3d{s, c, 0}, Vec3d{0, 0, 1}}};
}

Rotation rotation_zyz(double z2, double y, double z1) {
  return rotation_about_z(z2) * rotation_about_y(y) * rotation_about_z(z1);
}

Rotation rotation_from_quaternion(double w, double x, double y, double z) {
  const double length2 = w * w + x * x + y * y + z * z;
  assert(length2 > 0);
  const double s = 2 / length2;
  return {{Vec3d{1 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y)},
           Vec3d{s * (x * y + w * z), 1 - s * (x * x + z * z), s * (y * z - w * x)},
           Vec3d{s * (x * z - w * y), s * (y * z + w * x), 1 - s * (x * x + y * y)}}};
}

bool is_rotation(const Rotation& rotation, double tolerance) {
  const auto& [x, y, z] = rotation.rows;
  const auto near = [&](double a, double b) { return std::abs(a - b) <= tolerance; };
  return near(dot(x, x), 1) && near(dot(y, y), 1) && near(dot(z, z), 1) && near(dot(x, y), 0) && near(dot(y, z), 0) &&
         near(dot(x, z), 0) && near(dot(cross(x, y), z), 1);
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

RgbCoefficients rotate_about_z(double radians, const RgbCoefficients& coefficients) {
  RgbCoefficients result = coefficients;
  for (int m = 1; m < coefficients.bands(); ++m) {
    const double c = std::cos(m * radians), s = std::sin(m * radians);
    for (int l = m; l < coefficients.bands(); ++l) {
      const Rgb cosine = coefficients.at(l, m), sine = coefficients.at(l, -m);
      result.at(l, m) = c * cosine - s * sine;
      result.at(l, -m) = s * cosine + c * sine;
    }
  }
  return result;
}

namespace {

constexpr std::size_t kLanes = 16;
typedef float Lanes __attribute__((vector_size(kLanes * sizeof(float))));

// One degree of `lanes` vectors at once. Rows = 2l+1 at compile time keeps the inputs in registers.
template <int Rows, class Size>
SHLIGHT_ALWAYS_INLINE inline void rotate_degree(const float* matrix, const float* values, float* result,
                                                std::size_t count, Size lanes) {
  Lanes inputs[Rows] = {};
#pragma GCC unroll 16
  for (int k = 0; k < Rows; ++k)
    std::memcpy(&inputs[k], values + static_cast<std::size_t>(k) * count, lanes * sizeof(float));
  for (int i = 0; i < Rows; ++i) {
    Lanes sum = {};
#pragma GCC unroll 16
    for (int k = 0; k < Rows; ++k) sum += matrix[i * Rows + k] * inputs[k];
    std::memcpy(result + static_cast<std::size_t>(i) * count, &sum, lanes * sizeof(float));
  }
}

// `Block` rows of a matrix of any size at once: they share the loads of the inputs, and their sums do not wait for each
// other, as those of one row do.
template <int Block, class Size>
SHLIGHT_ALWAYS_INLINE inline void rotate_rows(int rows, const float* matrix, const float* values, float* result,
                                              std::size_t count, Size lanes) {
  Lanes sums[Block] = {}, input = {};
  for (int k = 0; k < rows; ++k) {
    std::memcpy(&input, values + static_cast<std::size_t>(k) * count, lanes * sizeof(float));
#pragma GCC unroll 16
    for (int i = 0; i < Block; ++i) sums[i] += matrix[i * rows + k] * input;
  }
#pragma GCC unroll 16
  for (int i = 0; i < Block; ++i)
    std::memcpy(result + static_cast<std::size_t>(i) * count, &sums[i], lanes * sizeof(float));
}

// The same for any number of rows, which is odd.
template <class Size>
SHLIGHT_ALWAYS_INLINE inline void rotate_high_degree(int rows, const float* matrix, const float* values, float* result,
                                                     std::size_t count, Size lanes) {
  constexpr int kBlock = 8;
  int i = 0;
  for (; i + kBlock <= rows; i += kBlock)
    rotate_rows<kBlock>(rows, matrix + i * rows, values, result + static_cast<std::size_t>(i) * count, count, lanes);
  for (; i + 2 <= rows; i += 2)
    rotate_rows<2>(rows, matrix + i * rows, values, result + static_cast<std::size_t>(i) * count, count, lanes);
  rotate_rows<1>(rows, matrix + i * rows, values, result + static_cast<std::size_t>(i) * count, count, lanes);
}

// One degree of all vectors: `rotate_lanes(first, lanes)` turns the vectors from `first`, sixteen or, of fewer, all.
// A store across two cache lines costs two: after the first sixteen vectors the next ones start where `result` is
// aligned, and the last sixteen end where it ends. Some are so turned twice, with the same result.
template <class RotateLanes>
SHLIGHT_ALWAYS_INLINE inline void rotate_all(const float* result, std::size_t count, RotateLanes rotate_lanes) {
  if (count < kLanes) return rotate_lanes(0, count);
  const std::size_t last = count - kLanes;
  const std::size_t aligned = kLanes - reinterpret_cast<std::uintptr_t>(result) / sizeof(float) % kLanes;
  for (std::size_t j = 0, next = aligned;; j = next, next += kLanes) {
    rotate_lanes(j, std::integral_constant<std::size_t, kLanes>{});
    if (j == last) return;
    next = next < last ? next : last;
  }
}

template <int Rows>
SHLIGHT_ALWAYS_INLINE inline void rotate_degree_of_all(const float* matrix, const float* values, float* result,
                                                       std::size_t count) {
  rotate_all(result, count, [=](std::size_t j, auto lanes) SHLIGHT_ALWAYS_INLINE {
    rotate_degree<Rows>(matrix, values + j, result + j, count, lanes);
  });
}

// `matrix` holds the blocks of all degrees one after the other, in float. Degree by degree, so that few streams of
// memory are open at a time: with all 25 coefficients of five bands open at once processors fetch ahead too little.
SHLIGHT_CLONES void rotate_many(int bands, const float* matrix, const float* values, float* result, std::size_t count) {
  for (int l = 0; l < bands; ++l) {
    const int rows = 2 * l + 1;
    switch (l) {
      case 0:
        rotate_degree_of_all<1>(matrix, values, result, count);
        break;
      case 1:
        rotate_degree_of_all<3>(matrix, values, result, count);
        break;
      case 2:
        rotate_degree_of_all<5>(matrix, values, result, count);
        break;
      case 3:
        rotate_degree_of_all<7>(matrix, values, result, count);
        break;
      case 4:
        rotate_degree_of_all<9>(matrix, values, result, count);
        break;
      default:
        rotate_all(result, count, [=](std::size_t j, auto lanes) SHLIGHT_ALWAYS_INLINE {
          rotate_high_degree(rows, matrix, values + j, result + j, count, lanes);
        });
    }
    matrix += rows * rows;
    values += static_cast<std::size_t>(rows) * count;
    result += static_cast<std::size_t>(rows) * count;
  }
}

}  // namespace

void rotate(const RotationMatrix& matrix, std::span<const float> values, std::span<float> result, std::size_t count) {
  assert(values.size() == count * static_cast<std::size_t>(num_coefficients(matrix.bands())));
  assert(result.size() == values.size());
  std::vector<float> blocks;
  blocks.reserve(static_cast<std::size_t>(matrix.bands() * (4 * matrix.bands() * matrix.bands() - 1) / 3));
  for (int l = 0; l < matrix.bands(); ++l) blocks.insert(blocks.end(), matrix.block(l).begin(), matrix.block(l).end());
  rotate_many(matrix.bands(), blocks.data(), values.data(), result.data(), count);
}

}  // namespace shlight
