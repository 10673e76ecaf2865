#pragma once

#include <cstdint>

#include "shlight/brdf/brdf.h"
#include "shlight/core/progress.h"
#include "shlight/image/image.h"
#include "shlight/light/light.h"
#include "shlight/scene/camera.h"
#include "shlight/scene/scene.h"
#include "shlight/sh/rotation.h"
#include "shlight/transfer/transfer.h"

// Pictures in which nothing is approximated, for the pictures that approximate to be held against: the same scene,
// camera, materials and light as render/ draws, without spherical harmonics. What is left is noise, of which every
// pixel says how much it has.
//
// One for each kind of transfer (transfer.h), with L the light, n the interpolated normal, V whether a direction is
// open, ρ the base colour times the vertices' and the texture's:
//
//     cosine           ρ/π ∫ L max(0, n·s) ds         what irradiance and cosine transfer come to with enough bands
//     shadowed         ρ/π ∫ L V max(0, n·s) ds
//     interreflected   that and light that other surfaces reflect, up to so many bounces
//
// Directions of two kinds are drawn for each reflection, those of the light (light_sampler.h) and those of the surface,
// and weighted so that each counts where it is the better (multiple importance sampling, the balance heuristic [1,
// section 9.2]).
//
// Surfaces are what they are to the baker: the side where normals point is lit and reflects, both sides stop light, and
// of pairs of triangles that face away from each other each is its own side. Where the camera sees a surface from
// behind, it sees it lit from there, as the irradiance method draws it. An eye below the interpolated normal's
// horizon sees a BRDF as from the horizon.
//
// Lights that are coefficients may be negative in some directions, and so may then be a pixel: nothing is clamped.
//
// [1] Veach 1997, Robust Monte Carlo Methods for Light Transport Simulation, PhD thesis, Stanford.

namespace shlight {

// Independent estimates of a picture, whose mean is the result and whose scatter is its variance.
inline constexpr int kReplicates = 16;
inline constexpr int kMaxPathSamples = 1 << 20;

struct PathTraceParams {
  int width = 1280;
  int height = 720;
  Camera camera;
  Rotation rotate_light;  // of the light, before it falls on the scene
  TransferKind transfer = TransferKind::kInterreflected;
  int bounces = 3;    // of light between surfaces, kInterreflected only, 0 … 64
  int samples = 256;  // paths a pixel, 1 … kMaxPathSamples, rounded up to a multiple of kReplicates
  // How all surfaces reflect, instead of their own colours: ρ/π above becomes f_r(s, v). Its frame's x is
  // make_tangents' tangent. Outlives the call.
  const Brdf* brdf = nullptr;
  // Whether materials that have gloss show it; irradiance and transfer take only their colours. Without `brdf`.
  bool gloss = false;
  bool show_background = true;
  std::uint64_t seed = 1;  // other seeds give other errors of the same size
  int threads = 0;         // at most; 0: all there are. The result has the same bits with any number
  MakeTracer make_tracer;  // empty: make_embree_tracer
};

struct PathTraceResult {
  Image radiance;   // linear
  Image variance;   // of the mean that each channel of `radiance` is
  int samples = 0;  // paths a pixel
  std::uint64_t rays = 0;
  double seconds = 0;
};

// Needs of the scene what bake_transfer needs, and throws Error where it does not keep it; Cancelled. Memory beside the
// scene's: 200 bytes a triangle for the tracer, 24 a pixel, 4 a pixel of the light, about 10 MB a thread.
PathTraceResult trace_paths(const Scene& scene, const Light& light, const PathTraceParams& params,
                            const Progress& progress = {});

}  // namespace shlight
