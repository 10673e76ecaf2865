#include "shlight/sh/basis.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <type_traits>
#include <utility>
#include <vector>

#include "shlight/sh/clones.h"

// With p_l^m = K_l^m P_l^m / sin^m θ · √(2 if m > 0), a polynomial in z, the recursion of the Legendre functions
// becomes
//
//     p_0^0 = √(1/4π)       p_m^m = p_{m−1}^{m−1} √((2m+1)/2m) · √(2 if m = 1)
//     p_l^m = a_l^m z p_{l−1}^m − b_l^m p_{l−2}^m,
//         a_l^m = √((4l²−1)/(l²−m²)),   b_l^m = √((2l+1)/(2l−3) · ((l−1)²−m²)/(l²−m²))   (b_{m+1}^m = 0)
//
// and sin^m θ cos(mφ), sin^m θ sin(mφ) are the real and imaginary part of (x + iy)^m. Nothing in it grows like a
// factorial, so that it holds at any number of bands.

namespace shlight {
namespace {

constexpr double kPi = 3.14159265358979323846;

// √v for v >= 0; at compile time by Newton's iteration from above until it stands still.
constexpr double square_root(double v) {
  if (!std::is_constant_evaluated()) return std::sqrt(v);
  if (v == 0) return 0;
  double r = v > 1 ? v : 1;
  for (int i = 0; i < 200; ++i) {
    const double next = 0.5 * (r + v / r);
    if (next >= r) break;
    r = next;
  }
  return r;
}

constexpr double kY00 = square_root(1 / (4 * kPi));

// p_m^m / p_{m−1}^{m−1}
constexpr double start_ratio(int m) {
  return square_root((m == 1 ? 2.0 : 1.0) * (2.0 * m + 1) / (2.0 * m));
}

constexpr double factor_a(int l, int m) {
  return square_root((4.0 * l * l - 1) / (double(l) * l - double(m) * m));
}

constexpr double factor_b(int l, int m) {
  if (l == m + 1) return 0;
  return square_root((2.0 * l + 1) / (2.0 * l - 3) * ((l - 1.0) * (l - 1.0) - double(m) * m) /
                     (double(l) * l - double(m) * m));
}

// The factors of the recursion for the first bands, made once at compile time.
struct RecursionTable {
  static constexpr int kBands = 20;
  std::array<double, kBands> start{};  // p_m^m
  std::array<std::array<double, kBands>, kBands> a{}, b{};
  constexpr RecursionTable() {
    start[0] = kY00;
    for (int m = 1; m < kBands; ++m) start[m] = start[m - 1] * start_ratio(m);
    for (int m = 0; m < kBands; ++m)
      for (int l = m + 1; l < kBands; ++l) a[l][m] = factor_a(l, m), b[l][m] = factor_b(l, m);
  }
};
constexpr RecursionTable kTable;

// a_l^m and b_l^m at run time, looked up where they can be.
struct FactorPair {
  double a, b;
};
inline FactorPair factors(int l, int m) {
  if (l < RecursionTable::kBands) return {kTable.a[l][m], kTable.b[l][m]};
  return {factor_a(l, m), factor_b(l, m)};
}

// Calls f(0), f(1) … f(Count-1) with compile-time arguments: a loop that is always unrolled.
template <int Count, class F>
SHLIGHT_ALWAYS_INLINE inline void unrolled(F&& f) {
  [&]<int... I>(std::integer_sequence<int, I...>) SHLIGHT_ALWAYS_INLINE {
    (f(std::integral_constant<int, I>{}), ...);
  }
  (std::make_integer_sequence<int, Count>{});
}

// Y of one direction, or of a vector of them, as straight-line code; calls store(i, Y_i).
template <int Bands, class Real, class Vector, class Store>
SHLIGHT_ALWAYS_INLINE inline void eval_unrolled(const Vector& x, const Vector& y, const Vector& z, Store&& store) {
  Vector c = x * Real(0) + Real(1), s = x * Real(0);  // real and imaginary part of (x + iy)^m
  unrolled<Bands>([&](auto m_constant) SHLIGHT_ALWAYS_INLINE {
    constexpr int m = m_constant;
    Vector before = x * Real(0), p = before + static_cast<Real>(kTable.start[m]);
    unrolled<Bands - m>([&](auto k) SHLIGHT_ALWAYS_INLINE {
      constexpr int l = m + k;
      if constexpr (l > m) {
        Vector next = static_cast<Real>(kTable.a[l][m]) * z * p;
        if constexpr (l > m + 1) next -= static_cast<Real>(kTable.b[l][m]) * before;
        before = p;
        p = next;
      }
      store(l * (l + 1) + m, m == 0 ? p : p * c);
      if constexpr (m > 0) store(l * (l + 1) - m, p * s);
    });
    const Vector next = x * c - y * s;
    s = x * s + y * c;
    c = next;
  });
}

// Calls f with `bands` as a compile-time number; false where it is too large to be one.
template <class F>
SHLIGHT_ALWAYS_INLINE inline bool with_constant_bands(int bands, F&& f) {
  switch (bands) {
    case 0:
      return true;
    case 1:
      f(std::integral_constant<int, 1>{});
      return true;
    case 2:
      f(std::integral_constant<int, 2>{});
      return true;
    case 3:
      f(std::integral_constant<int, 3>{});
      return true;
    case 4:
      f(std::integral_constant<int, 4>{});
      return true;
    case 5:
      f(std::integral_constant<int, 5>{});
      return true;
    case 6:
      f(std::integral_constant<int, 6>{});
      return true;
    default:
      return false;
  }
}

// The recursion on a block of directions: each line of it runs along the block.
constexpr std::size_t kBlock = 64;

SHLIGHT_CLONES void eval_block_recursive(int bands, std::size_t count, const float* x, const float* y, const float* z,
                                         float* values, std::size_t stride) {
  float c[kBlock], s[kBlock], before[kBlock], p[kBlock];
  for (std::size_t j = 0; j < kBlock; ++j) c[j] = 1, s[j] = 0;
  double start = kY00;
  for (int m = 0; m < bands; ++m) {
    if (m > 0) {
      start *= start_ratio(m);
      for (std::size_t j = 0; j < count; ++j) {
        const float next = x[j] * c[j] - y[j] * s[j];
        s[j] = x[j] * s[j] + y[j] * c[j];
        c[j] = next;
      }
    }
    for (std::size_t j = 0; j < count; ++j) before[j] = 0, p[j] = static_cast<float>(start);
    for (int l = m; l < bands; ++l) {
      if (l > m) {
        const FactorPair factor = factors(l, m);
        const float a = static_cast<float>(factor.a), b = static_cast<float>(factor.b);
        for (std::size_t j = 0; j < count; ++j) {
          const float next = a * z[j] * p[j] - b * before[j];
          before[j] = p[j];
          p[j] = next;
        }
      }
      float* plus = values + static_cast<std::size_t>(coefficient_index(l, m)) * stride;
      float* minus = values + static_cast<std::size_t>(coefficient_index(l, -m)) * stride;
      for (std::size_t j = 0; j < count; ++j) minus[j] = p[j] * s[j];
      for (std::size_t j = 0; j < count; ++j) plus[j] = p[j] * c[j];
    }
  }
}

// As wide as the widest registers; on lesser processors the compiler makes several of one.
constexpr std::size_t kLanes = 16;
typedef float Lanes __attribute__((vector_size(kLanes * sizeof(float))));

template <int Bands>
SHLIGHT_CLONES void eval_many_unrolled(std::size_t count, const float* x, const float* y, const float* z,
                                       float* values) {
  // `lanes` of them exist; a compile-time number for all but the last few.
  const auto eval = [&](std::size_t j, auto lanes) SHLIGHT_ALWAYS_INLINE {
    Lanes vx = {}, vy = {}, vz = {};
    std::memcpy(&vx, x + j, lanes * sizeof(float));
    std::memcpy(&vy, y + j, lanes * sizeof(float));
    std::memcpy(&vz, z + j, lanes * sizeof(float));
    eval_unrolled<Bands, float>(vx, vy, vz, [&](int i, const Lanes& value) SHLIGHT_ALWAYS_INLINE {
      std::memcpy(values + static_cast<std::size_t>(i) * count + j, &value, lanes * sizeof(float));
    });
  };
  std::size_t j = 0;
  for (; j + kLanes <= count; j += kLanes) eval(j, std::integral_constant<std::size_t, kLanes>{});
  if (j < count) eval(j, count - j);
}

template <class T, class Sum>
Sum reconstruct_sum(const Coefficients<Sum>& coefficients, Vec3<T> direction) {
  std::vector<T> basis(coefficients.size());
  eval_basis(coefficients.bands(), direction, std::span<T>(basis));
  Sum sum{};
  for (std::size_t i = 0; i < basis.size(); ++i) sum = sum + basis[i] * coefficients[i];
  return sum;
}

}  // namespace

template <class T>
void eval_basis_recursive(int bands, Vec3<T> direction, std::span<T> values) {
  assert(static_cast<int>(values.size()) == num_coefficients(bands));
  const auto at = [&](int l, int m) -> T& { return values[static_cast<std::size_t>(coefficient_index(l, m))]; };
  T c = 1, s = 0, start = static_cast<T>(kY00);
  for (int m = 0; m < bands; ++m) {
    if (m > 0) {
      start *= static_cast<T>(start_ratio(m));
      const T next = direction.x * c - direction.y * s;
      s = direction.x * s + direction.y * c;
      c = next;
    }
    T before = 0, p = start;
    for (int l = m; l < bands; ++l) {
      if (l > m) {
        const FactorPair factor = factors(l, m);
        before = std::exchange(p, static_cast<T>(factor.a) * direction.z * p - static_cast<T>(factor.b) * before);
      }
      at(l, -m) = p * s;
      at(l, m) = p * c;
    }
  }
}

template <class T>
void eval_basis(int bands, Vec3<T> direction, std::span<T> values) {
  assert(static_cast<int>(values.size()) == num_coefficients(bands));
  const bool done = with_constant_bands(bands, [&](auto constant) SHLIGHT_ALWAYS_INLINE {
    eval_unrolled<constant, T>(direction.x, direction.y, direction.z, [&](int i, T value) SHLIGHT_ALWAYS_INLINE {
      values[static_cast<std::size_t>(i)] = value;
    });
  });
  if (!done) eval_basis_recursive(bands, direction, values);
}

template void eval_basis_recursive(int, Vec3<float>, std::span<float>);
template void eval_basis_recursive(int, Vec3<double>, std::span<double>);
template void eval_basis(int, Vec3<float>, std::span<float>);
template void eval_basis(int, Vec3<double>, std::span<double>);

void eval_basis(int bands, std::span<const float> x, std::span<const float> y, std::span<const float> z,
                std::span<float> values) {
  const std::size_t count = x.size();
  assert(y.size() == count && z.size() == count && values.size() == count * num_coefficients(bands));
  const bool done = with_constant_bands(
      bands, [&](auto constant) { eval_many_unrolled<constant>(count, x.data(), y.data(), z.data(), values.data()); });
  if (done) return;
  for (std::size_t j = 0; j < count; j += kBlock)
    eval_block_recursive(bands, std::min(kBlock, count - j), &x[j], &y[j], &z[j], &values[j], count);
}

NormalizedLegendre::NormalizedLegendre(int bands) : bands_(bands) {
  factors_.reserve(static_cast<std::size_t>(bands * (bands + 1) / 2));
  for (int l = 0; l < bands; ++l) {
    for (int m = 0; m < l; ++m) factors_.push_back({factor_a(l, m), factor_b(l, m)});
    factors_.push_back({l == 0 ? kY00 : start_ratio(l), 0});
  }
}

void NormalizedLegendre::eval(double z, double s, std::span<double> p) const {
  assert(p.size() == size());
  if (p.empty()) return;
  p[0] = kY00;
  // Rows l−2, l−1 and l of the triangle; the last two of a row have no p_{l−2} and no p_{l−1} above them.
  for (std::size_t l = 1; l < static_cast<std::size_t>(bands_); ++l) {
    const std::size_t row = l * (l + 1) / 2, above = row - l, above2 = above - (l - 1);
    for (std::size_t m = 0; m + 1 < l; ++m)
      p[row + m] = factors_[row + m].a * z * p[above + m] - factors_[row + m].b * p[above2 + m];
    p[row + l - 1] = factors_[row + l - 1].a * z * p[above + l - 1];
    p[row + l] = factors_[row + l].a * s * p[above + l - 1];
  }
}

void NormalizedLegendre::eval_with_derivative(double z, std::span<double> p, std::span<double> derivative) const {
  assert(derivative.size() == size());
  eval(z, 1, p);
  // Each step of the recursion p = a z p₁ − b p₂ differentiated: p' = a (p₁ + z p₁') − b p₂'.
  if (p.empty()) return;
  derivative[0] = 0;
  for (std::size_t l = 1; l < static_cast<std::size_t>(bands_); ++l) {
    const std::size_t row = l * (l + 1) / 2, above = row - l, above2 = above - (l - 1);
    for (std::size_t m = 0; m < l; ++m) {
      derivative[row + m] = factors_[row + m].a * (p[above + m] + z * derivative[above + m]);
      if (m + 1 < l) derivative[row + m] -= factors_[row + m].b * derivative[above2 + m];
    }
    derivative[row + l] = factors_[row + l].a * derivative[above + l - 1];
  }
}

double reconstruct(const Coefficients<double>& coefficients, Vec3d direction) {
  return reconstruct_sum(coefficients, direction);
}

Rgb reconstruct(const RgbCoefficients& coefficients, Vec3d direction) {
  return reconstruct_sum(coefficients, direction);
}

void add_delta(Vec3d direction, Rgb value, RgbCoefficients& coefficients) {
  std::vector<double> basis(coefficients.size());
  eval_basis(coefficients.bands(), direction, std::span<double>(basis));
  for (std::size_t i = 0; i < basis.size(); ++i) coefficients[i] += basis[i] * value;
}

}  // namespace shlight
