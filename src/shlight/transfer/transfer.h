#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "shlight/core/progress.h"
#include "shlight/scene/scene.h"
#include "shlight/sh/vec.h"
#include "shlight/transfer/tracer.h"

// Transfer: how a surface answers to any distant light. The transfer function A(s) of a vertex says how much of the
// radiance from direction s leaves a white Lambertian surface there; its coefficients A_i = ∫ A Y_i are baked once, and
// from then on the vertex's radiance is
//
//     ρ Σ L_i A_i          with L_i the light's coefficients of radiance, ρ the vertex's own reflectance
//
// for every light. ρ is not in A, so that it may come from a texture at each pixel. Under uniform light of radiance 1
// an open white surface has Σ L_i A_i = √4π A_0 = 1. With n the normal, V(s) whether nothing stands in direction s, and
// y the point that stands there otherwise, the kinds are
//
//     cosine           A_0(s) = max(0, n·s) / π                                            no shadows
//     shadowed         A_0(s) = V(s) max(0, n·s) / π                                       [1, section 4.1]
//     interreflected   A_b(x) = ∫ (1 − V(ω)) max(0, n·ω)/π ρ(y) A_{b−1}(y) dω,   A = Σ_b A_b: the radiosity equation,
//                      one bounce of light after the other                                 [1, section 4.2]
//
// Coefficients are of the world's directions, as the light's are.
//
// [1] Sloan, Kautz, Snyder 2002, Precomputed Radiance Transfer for Real-Time Rendering in Dynamic, Low-Frequency
//     Lighting Environments, SIGGRAPH.

namespace shlight {

enum class TransferKind { kCosine, kShadowed, kInterreflected };

// How directions are chosen. kBest: the closed form of what has one, and low-discrepancy points for the rest.
// kMonteCarlo is the thesis's method, cosine and shadowed transfer only: the same √N × √N jittered points, uniform on
// the sphere, for every vertex. It converges to the other, with many more samples.
enum class TransferMethod { kBest, kMonteCarlo };

inline constexpr int kMaxTransferBands = 16;
inline constexpr int kMaxTransferSamples = 65536;

struct BakeParams {
  TransferKind kind = TransferKind::kShadowed;
  TransferMethod method = TransferMethod::kBest;
  int bands = 5;           // 1 … kMaxTransferBands
  int samples = 0;         // rays a vertex, 1 … kMaxTransferSamples; 0: as many as each vertex needs for `error`
  float error = 0.0038f;   // wanted where samples is 0: root mean square over all vertices of the coefficients' error,
                           // relative to the coefficients' own; 1e-5 … 1, as far as kMaxTransferSamples can
  int bounces = 3;         // of light between surfaces, kInterreflected only, 0 … 64
  std::uint64_t seed = 1;  // other seeds give other errors of the same size
  int threads = 0;         // at most; 0: all there are. The result has the same bits with any number
  MakeTracer make_tracer;  // empty: make_embree_tracer
  std::filesystem::path checkpoint;  // where to note down what is done, to go on from there; empty: nowhere
  double checkpoint_seconds = 60;    // how often; also when stopped
};

// How far a bake is.
struct BakeStatus {
  double fraction_done = 0;    // in [0, 1], never decreasing
  double seconds = 0;          // since the call
  std::uint64_t rays = 0;      // traced by this call: without what a checkpoint brought
  double rays_per_second = 0;  // 0 while unknown
  double seconds_left = -1;    // negative while unknown
};
// "43 %, 18.2 million rays/s, 12 s left".
std::string to_text(const BakeStatus& status);

// Called from one thread at a time, about once a second, and in the end with fraction_done 1, all rays and all seconds;
// returning false stops the bake.
using BakeWatcher = std::function<bool(const BakeStatus&)>;
// For who only has a Progress.
BakeWatcher watch(Progress progress);

// The transfer of every vertex of every instance of a scene, instance after instance, each in its mesh's sequence.
// The vertices that were never part of a triangle have theirs too.
struct Transfer {
  TransferKind kind = TransferKind::kCosine;
  int bands = 0;
  int channels = 1;                      // 3 (red, green, blue) where light has met coloured surfaces
  std::vector<float> coefficients;       // coefficient i of channel c of vertex v: [(v · channels + c) · bands² + i]
  std::vector<float> ambient_occlusion;  // eval_ambient_occlusion of each vertex's shadowed transfer
  std::vector<Vec3f> bent_normals;       // eval_bent_normal of it
  std::vector<std::size_t> first_vertex;  // of each instance, and at the end the number of all vertices
  std::uint64_t hash = 0;                 // hash_bake of what it was made from
  std::uint64_t rays = 0;                 // all that it took, over all calls where it went on from a checkpoint
  double seconds = 0;                     // this call's
  double estimated_error = 0;  // of shadowed transfer, or the shadowed part of interreflected: root mean square over
                               // all vertices and coefficients, relative to the coefficients' own. Measured on some of
                               // the vertices with other samples, good to about a fifth; 0 for cosine transfer. Where
                               // samples is 0, without openings that are missed with any: up to a tenth of it
                               // (docs/transfer.md)

  std::size_t num_vertices() const { return ambient_occlusion.size(); }
};

// Bakes. Every instance shades every other and itself, and light bounces between all of them. Needs of meshes and
// instances what scene.h promises, except that triangles may be without area; throws Error where they do not keep it
// (NaN, indices out of range, normals without length), where `params` are out of range, and Cancelled where the watcher
// stops it. Vertices of equal position and normal are traced once.
//
// Surfaces stop light from both sides; only their front, where the normals point, reflects any, unless their triangles
// come in pairs that face away from each other. Reflectances are clamped to [0, 1].
//
// Memory, beside the scene and the result: about 200 bytes a triangle for the tracer, 100 a vertex, 4 bands² a vertex
// for shadowed transfer, 36 bands² for interreflected, and up to 100 MB for samples: for a scene of a million triangles
// and 5 bands less than 2 GB.
//
// The checkpoint: where the file exists, the bake goes on from it, and ends with the same bits as if it had never been
// stopped; where it was made for another scene or other params, throws Error. It is left there when the bake is done,
// to be deleted when the result is safe.
Transfer bake_transfer(const Scene& scene, const BakeParams& params, const BakeWatcher& watcher = {});

// Of all that a bake's result depends on: meshes, matrices, materials, textures and params, but not names, threads,
// checkpoints and tracers. A file keeps it to know later whether it still fits. The same on every machine of the same
// byte order.
std::uint64_t hash_bake(const Scene& scene, const BakeParams& params);

}  // namespace shlight
