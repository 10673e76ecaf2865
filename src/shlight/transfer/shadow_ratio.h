#pragma once

#include <vector>

#include "shlight/scene/scene.h"
#include "shlight/sh/coefficients.h"
#include "shlight/sh/vec.h"
#include "shlight/transfer/transfer.h"

namespace shlight {

// What baked shadows, and light that comes from other surfaces, make of the light of a vertex that has neither: for
// methods that light surfaces as if they were alone. The share is that of irradiance, in each channel, so that matte
// surfaces come out as their transfer says, and highlights are dimmed as the light of all directions together is:
// too much where the shadow is elsewhere, too little where it is in the mirrored direction.
class ShadowRatio {
 public:
  // `transfer` is of `scene`, of any kind.
  ShadowRatio(const Scene& scene, Transfer transfer);

  // Of each vertex, in the sequence of Transfer, under a light whose coefficients of radiance are in the world's frame:
  // Σ L_i A_i over the same sum for cosine transfer, over as many bands as light and transfer have, in [0, 4]. Where
  // even the open sum is next to nothing, as SH light may be on the far side of a lamp, it tends to 1.
  std::vector<Vec3f> under(const RgbCoefficients& light, int threads = 0) const;

 private:
  Transfer transfer_, open_;
};

}  // namespace shlight
