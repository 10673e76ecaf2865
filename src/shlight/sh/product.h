#pragma once

#include <cstdint>
#include <vector>

#include "shlight/sh/coefficients.h"

// The coefficients of the product of two functions from those of the factors.
//
// [1] Snyder 2006, Code Generation and Factoring for Fast Evaluation of Low-order Spherical Harmonic Products and
//     Squares, MSR-TR-2006-53.

namespace shlight {

// The triple products Γ_ijk = ∫ Y_i Y_j Y_k that are not zero, for factors i of `first_bands` and j of `second_bands`
// and a product k of `product_bands`. With product_bands = first_bands + second_bands − 1 the product is exact; with
// fewer it is the exact one's first bands. Few are not zero: m and parity must agree and l obey the triangle rule (83
// of 729 for three times 3 bands).
class TripleProducts {
 public:
  TripleProducts(int first_bands, int second_bands, int product_bands);

  struct Term {
    std::uint32_t i, j, k;
    double value;
  };
  // Sorted by k, then i, then j.
  const std::vector<Term>& terms() const { return terms_; }
  int first_bands() const { return first_bands_; }
  int second_bands() const { return second_bands_; }
  int product_bands() const { return product_bands_; }

 private:
  int first_bands_, second_bands_, product_bands_;
  std::vector<Term> terms_;
};

// The product, channel by channel, of factors with just the bands that `products` was made for.
RgbCoefficients multiply(const TripleProducts& products, const RgbCoefficients& first, const RgbCoefficients& second);

}  // namespace shlight
