#pragma once

#include <span>
#include <vector>

#include "shlight/sh/basis.h"
#include "shlight/sh/coefficients.h"
#include "shlight/sh/vec.h"

namespace shlight {

// The value of Σ c_i Y_i at a unit direction and its gradient along the sphere: tangent to it, the change per radian.
struct ValueAndGradient {
  double value = 0;
  Vec3d gradient;
};

// Evaluates one function with its gradient in many directions.
class GradientEvaluator {
 public:
  // `coefficients` are num_coefficients(bands) values, which must outlive this.
  GradientEvaluator(std::span<const double> coefficients, int bands);
  ValueAndGradient operator()(Vec3d direction);

 private:
  std::span<const double> coefficients_;
  NormalizedLegendre legendre_;
  std::vector<double> polynomials_, derivatives_;
};

// What is known about the smallest value of a function on the sphere.
struct CertifiedMinimum {
  double lower_bound = 0;  // the function is nowhere smaller: proved, not sampled
  double value = 0;        // its value at `direction`; the true minimum lies between the two
  Vec3d direction;
};

// Finds the minimum of Σ c_i Y_i over all directions to within `tolerance` · √(Σ c_i²), by branch and bound: a patch of
// the sphere is split until no direction in it can beat what has been found. The bound on a patch of angular radius r
// around d is f(d) − |∇f(d)| r − ½ M r², where no second derivative of f along any great circle exceeds M. It cannot
// miss a minimum between samples, for it takes none on trust.
CertifiedMinimum find_minimum(std::span<const double> coefficients, int bands, double tolerance = 1e-5);

// Stops as soon as it is known whether the function is anywhere negative: either `value` is below zero, or
// `lower_bound` is not, or zero lies between the two, not farther than the tolerance from either.
CertifiedMinimum find_sign_of_minimum(std::span<const double> coefficients, int bands, double tolerance = 1e-5);

}  // namespace shlight
