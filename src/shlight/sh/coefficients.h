#pragma once

#include <cassert>
#include <cstddef>
#include <span>
#include <vector>

#include "shlight/sh/vec.h"

namespace shlight {

// n bands are the degrees l = 0 … n-1, with n² coefficients in all.
constexpr int num_coefficients(int bands) {
  return bands * bands;
}

// Where the coefficient of degree l and -l <= m <= l stands.
constexpr int coefficient_index(int l, int m) {
  return l * (l + 1) + m;
}

// The coefficients of one function on the sphere, n² values of T in index order. T is double, or Rgb for a light.
template <class T>
class Coefficients {
 public:
  Coefficients() = default;
  explicit Coefficients(int bands) : bands_(bands), values_(static_cast<std::size_t>(num_coefficients(bands))) {
    assert(bands >= 0);
  }

  int bands() const { return bands_; }
  std::size_t size() const { return values_.size(); }
  T& operator[](std::size_t i) { return values_[i]; }
  const T& operator[](std::size_t i) const { return values_[i]; }
  T& at(int l, int m) { return values_[static_cast<std::size_t>(coefficient_index(l, m))]; }
  const T& at(int l, int m) const { return values_[static_cast<std::size_t>(coefficient_index(l, m))]; }
  std::span<T> values() { return values_; }
  std::span<const T> values() const { return values_; }
  bool operator==(const Coefficients&) const = default;

 private:
  int bands_ = 0;
  std::vector<T> values_;
};
using RgbCoefficients = Coefficients<Rgb>;

// The first `bands` bands; zero in those that `coefficients` does not have.
template <class T>
Coefficients<T> resize_bands(const Coefficients<T>& coefficients, int bands) {
  Coefficients<T> result(bands);
  for (std::size_t i = 0; i < result.size() && i < coefficients.size(); ++i) result[i] = coefficients[i];
  return result;
}

template <class T>
Coefficients<T>& operator+=(Coefficients<T>& a, const Coefficients<T>& b) {
  assert(a.bands() == b.bands());
  for (std::size_t i = 0; i < a.size(); ++i) a[i] = a[i] + b[i];
  return a;
}

}  // namespace shlight
