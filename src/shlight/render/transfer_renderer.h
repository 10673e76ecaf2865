#pragma once

#include <optional>
#include <vector>

#include "shlight/render/gl.h"
#include "shlight/render/gpu_scene.h"
#include "shlight/scene/camera.h"
#include "shlight/sh/coefficients.h"
#include "shlight/sh/rotation.h"
#include "shlight/transfer/clustered_pca.h"
#include "shlight/transfer/transfer.h"

namespace shlight {

// Draws scenes by the transfer method: radiance = base colour · Σ L_i A_i, summed at each vertex and interpolated
// between them, with the A_i of each vertex baked before (transfer/transfer.h). A triangle looks the same from both
// sides. Needs a current context.
//
// Transfer is kept as it is given: coefficients as floats, or in 16 or 8 bits, 4 or 2 or 1 bytes each, bands² rounded
// up to a multiple of 4 for each channel; or as clustered principal components, 2 bytes for the cluster and for each
// weight. Nothing is decoded before it is drawn: scales of numbers are multiplied into the light, and light is summed
// with each cluster's mean and components once for all vertices [2], so that drawing costs the same for any number of
// bands.
//
// [1] Sloan, Kautz, Snyder 2002, Precomputed Radiance Transfer for Real-Time Rendering in Dynamic, Low-Frequency
//     Lighting Environments, SIGGRAPH.
// [2] Sloan, Hall, Hart, Snyder 2003, Clustered Principal Components for Precomputed Radiance Transfer, SIGGRAPH.
class TransferRenderer {
 public:
  // Uses as many bands as both have, in so many bits: 32, 16 or 8 (transfer/quantise.h). Throws Error where there are
  // more vertices than the card's textures hold: 4 million on the least one of OpenGL ES 3.0, 33 million on most; or
  // where memory runs out.
  TransferRenderer(const Transfer& transfer, const RgbCoefficients& radiance, int bits = 32);
  TransferRenderer(const ClusteredPca& pca, const RgbCoefficients& radiance);

  // From now on, the light of the coefficients, of which as many bands are used as before.
  void set_radiance(const RgbCoefficients& radiance);

  // From now on, paints stripes of this radiance where a channel of Σ L_i A_i is negative; black: no more.
  void mark_negative(Vec3f radiance);

  // Draws into the framebuffer and viewport now bound: linear radiance, alpha 1. `scene` is of the scene that the
  // transfer was made for. Turning the light turns its coefficients, once for all vertices.
  void draw(const GpuScene& scene, const View& view, const Rotation& light_to_world = {}) const;

 private:
  std::size_t num_vertices_;
  RgbCoefficients radiance_;
  RgbCoefficients scales_;           // of what is in the texture: L is multiplied with them
  std::optional<ClusteredPca> pca_;  // without its codes, which are in the texture
  gl::Program program_;
  gl::Texture transfer_, rows_;
};

}  // namespace shlight
