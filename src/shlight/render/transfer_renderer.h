#pragma once

#include "shlight/render/gl.h"
#include "shlight/render/gpu_scene.h"
#include "shlight/scene/camera.h"
#include "shlight/sh/coefficients.h"
#include "shlight/sh/rotation.h"
#include "shlight/transfer/transfer.h"

namespace shlight {

// Draws scenes by the transfer method: radiance = base colour · Σ L_i A_i, summed at each vertex and interpolated
// between them, with the A_i of each vertex baked before (transfer/transfer.h). A triangle looks the same from both
// sides. Needs a current context.
//
// Coefficients are kept as 32-bit floats: 16 bytes for every four of them, a channel and a vertex.
//
// [1] Sloan, Kautz, Snyder 2002, Precomputed Radiance Transfer for Real-Time Rendering in Dynamic, Low-Frequency
//     Lighting Environments, SIGGRAPH.
class TransferRenderer {
 public:
  // Uses as many bands as both have. Throws Error where there are more vertices than the card's textures hold: 4
  // million on the least one of OpenGL ES 3.0, 33 million on most; or where memory runs out.
  TransferRenderer(const Transfer& transfer, const RgbCoefficients& radiance);

  // From now on, paints stripes of this radiance where a channel of Σ L_i A_i is negative; black: no more.
  void mark_negative(Vec3f radiance);

  // Draws into the framebuffer and viewport now bound: linear radiance, alpha 1. `scene` is of the scene that the
  // transfer was made for. Turning the light turns its coefficients, once for all vertices.
  void draw(const GpuScene& scene, const View& view, const Rotation& light_to_world = {}) const;

 private:
  std::size_t num_vertices_;
  RgbCoefficients radiance_;
  gl::Program program_;
  gl::Texture transfer_;
};

}  // namespace shlight
