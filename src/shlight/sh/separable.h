#pragma once

#include <span>
#include <vector>

#include "shlight/sh/coefficients.h"

namespace shlight {

// The second half of a separable projection. Where radiance is given on rows of constant height about the world's
// vertical (every lat-long picture, and product quadrature), ∫ L Y splits into moments along each row and Legendre
// functions across the rows: bands² · rows work instead of bands² · pixels.
//
// The local frame of the rows has the world's up as its polar axis: azimuth φ = 0 looks down −Z, the middle of a
// lat-long picture, and φ grows toward +X, to its right; d = (s sin φ, up, −s cos φ).
class SeparableSum {
 public:
  explicit SeparableSum(int bands) : local_(bands) {}

  // Adds one row: `legendre` as NormalizedLegendre evaluates it at (up, s), with the row's weight folded in, and
  // the row's moments Σ L cos(mφ), Σ L sin(mφ) at 2m and 2m + 1.
  void add_row(std::span<const double> legendre, std::span<const Rgb> moments);
  void add(const SeparableSum& other) { local_ += other.local_; }

  // The coefficients in the world's frame.
  RgbCoefficients to_world() const;

 private:
  RgbCoefficients local_;
};

}  // namespace shlight
