#pragma once

#include <functional>

#include "shlight/brdf/brdf.h"
#include "shlight/light/light.h"
#include "shlight/sh/rotation.h"

// Integrals over all directions of an unoccluded point, without spherical harmonics: slow, and easy to believe.

namespace shlight {

struct BruteForceParams {
  // Wanted: the error over the integral of the absolute value, 1e-9 … 1.
  double tolerance = 1e-5;
  int threads = 0;  // 0: all there are; the result has the same bits with any number
};

struct BruteForceResult {
  Rgb value;
  double error = 0;  // estimated, absolute, of the channel that has the most
};

// ∫ L(s) w(s) ds over the sphere, by quadrature that is refined cell by cell until two rules, one with twice the nodes
// a side of the other, agree. The cells are the pixels of a light that is a picture, in each of which L is constant,
// and 1024 x 512 cells of a lat-long grid for other lights, whose features should not be smaller than a third of a
// degree. At an edge within a cell, rules stop at 64 x 64 nodes: `error` says what that leaves. Costs five evaluations
// a cell where nothing needs refining. `weight` is called from several threads at once.
BruteForceResult integrate_light(const Light& light, const std::function<Rgb(Vec3d direction)>& weight,
                                 const BruteForceParams& params = {});

// ∫ L(s) max(0, n·s) ds, the irradiance on a surface with the unit normal n.
BruteForceResult reference_irradiance(const Light& light, Vec3d normal, const BruteForceParams& params = {});

// ∫ L(s) f_r(s, v) max(0, n·s) ds, the radiance that a surface reflects toward the unit direction `view`. The rows of
// `to_local` are the axes of the BRDF's frame in the world: tangent, bitangent, normal. Slim highlights should not be
// slimmer than a cell.
BruteForceResult reference_radiance(const Light& light, const Brdf& brdf, const Rotation& to_local, Vec3d view,
                                    const BruteForceParams& params = {});

}  // namespace shlight
