#pragma once

#include <string>

#include "shlight/scene/scene.h"
#include "shlight/sh/sphere_samples.h"

// The thesis's pictures of the basis and of the samples. Not installed.

namespace shlight {

// The associated Legendre polynomial P_l^m(x), x in [-1, 1], with the phase (-1)^m as the thesis has it.
double eval_associated_legendre(int l, int m, double x);

// Y_lm as a surface at the distance |Y_lm| from the origin, scaled so that its furthest point is at `radius`, where it
// is positive of one colour and where it is negative of another. z points up.
Mesh make_balloon(int l, int m, float radius);

// A row of balloons for each of so many bands, m from left to right.
Scene make_balloon_scene(int bands);

// How far samples are from orthonormal: the largest |4π/N Σ Y_i Y_j − δ_ij|.
double orthonormality_error(const SphereSamples& samples);

// As many directions as `samples` has, each drawn by itself instead of one from each cell of a grid.
SphereSamples make_independent_samples(int bands, int count);

// Samples as points, azimuth and polar angle on a chart and the half of the sphere that faces the reader: SVG.
std::string make_sample_plot(const SphereSamples& samples);

}  // namespace shlight
