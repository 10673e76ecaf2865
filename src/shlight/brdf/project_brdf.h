#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "shlight/brdf/brdf.h"
#include "shlight/sh/coefficients.h"
#include "shlight/sh/sphere_samples.h"

// A reflection model seen from one side, as coefficients. In the local frame, what the surface reflects to v is
//
//     L_r(v) = ∫ f_r(s, v) max(0, s·n) L(s) ds = Σ_i F*_i(v) L_i,      F*_i(v) = ∫ f_r(s, v) max(0, s·n) Y_i(s) ds,
//
// a scalar product with the coefficients of the light, once that is turned into the local frame [1].
//
// Each lobe is integrated by Gauss's rule in coordinates in which it is smooth and at whose borders the horizon lies
// (project_brdf.cpp has them), so that there is no noise: neither of slim highlights nor at grazing angles.
//
// [1] Kautz, Sloan & Snyder 2002, Fast, Arbitrary BRDF Shading for Low-Frequency Lighting Using Spherical Harmonics.

namespace shlight {

struct ProjectBrdfParams {
  double tolerance = 1e-6;  // of the largest |coefficient|, between two refinements, at which to stop
  int max_nodes = 192;      // along a side of each piece of a lobe; refinement stops here in any case
};

struct BrdfProjection {
  RgbCoefficients coefficients;
  double change = 0;  // largest |difference| of a coefficient to the refinement before: an estimate of the error
};

// F*(v), refined until it stands still. v is of unit length and above the horizon; bands >= 1. Throws what a model of
// one's own throws.
BrdfProjection project_brdf(const Brdf& brdf, Vec3d v, int bands, const ProjectBrdfParams& params = {});

// The same with a fixed number of nodes for each lobe (0: leave it out): the piece that tables are made of.
RgbCoefficients project_brdf_fixed(const Brdf& brdf, Vec3d v, int bands, std::span<const int> nodes);

// The fewest nodes of each lobe with which all views come within `tolerance` of the largest |coefficient|.
std::vector<int> choose_nodes(const Brdf& brdf, int bands, double tolerance);

// The classic way, for one vertex and one view: 4π/N Σ f_r(s_j, v) max(0, n·s_j) Y_i(s_j) over stratified samples of
// the whole sphere, in world coordinates. Slow and noisy; kept as a reference. `normal` and `tangent` are orthogonal
// and, as `view`, of unit length.
//
// [2] Green 2003, Spherical Harmonic Lighting: The Gritty Details.
RgbCoefficients project_brdf_monte_carlo(const Brdf& brdf, Vec3d normal, Vec3d tangent, Vec3d view,
                                         const SphereSamples& samples);

}  // namespace shlight
