#pragma once

#include <functional>

#include "shlight/sh/coefficients.h"
#include "shlight/sh/sphere_samples.h"
#include "shlight/sh/vec.h"

// From a function on the sphere to its coefficients, c_i = ∫ f Y_i.
//
// [1] Green 2003, Spherical Harmonic Lighting: The Gritty Details.

namespace shlight {

using SphereFunction = std::function<Rgb(Vec3d direction)>;

struct MonteCarloProjection {
  RgbCoefficients coefficients;
  // One standard deviation of each coefficient's error. From the second differences of neighbouring strata, so that it
  // knows what stratification gains; where the function bends from stratum to stratum it errs to the large side.
  RgbCoefficients standard_error;
};

// The thesis's method: c_i = 4π/N Σ f(s_j) Y_i(s_j) over stratified samples [1]; strata >= 3.
MonteCarloProjection project_monte_carlo(const SphereFunction& f, const SphereSamples& samples);

struct QuadratureParams {
  double tolerance = 1e-7;  // of the largest |coefficient|, between two refinements, at which to stop
  int first_rows = 256;     // Gauss nodes over the two hemispheres together; twice as many azimuths
  int last_rows = 1024;     // refinement stops here in any case
};

struct QuadratureProjection {
  RgbCoefficients coefficients;
  double change = 0;  // largest |difference| of a coefficient to the refinement before: an estimate of the error
};

// Projection by product quadrature about the world's vertical: Gauss-Legendre in height, the two hemispheres apart so
// that a jump at the horizon costs nothing, the trapezoid rule in azimuth; refined until it stands still. Exact to
// rounding for functions of up to first_rows/2 bands, second order in the node distance where f has kinks.
// Throws what f throws.
QuadratureProjection project_quadrature(const SphereFunction& f, int bands, const QuadratureParams& params = {});

// Nodes and weights of Gauss-Legendre quadrature on [−1, 1], ascending; exact for polynomials of degree 2·count − 1.
struct GaussLegendre {
  std::vector<double> nodes, weights;
};
GaussLegendre make_gauss_legendre(int count);

}  // namespace shlight
