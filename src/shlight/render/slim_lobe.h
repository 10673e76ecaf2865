#pragma once

#include <memory>
#include <vector>

#include "shlight/brdf/brdf.h"
#include "shlight/sh/vec.h"

namespace shlight {

// A direction of a lobe around +z, how much of the lobe it stands for, and for how much of the sphere.
struct LobeSample {
  Vec3d direction;
  double weight;       // all sum to 1
  double solid_angle;  // sr
};

// The slim lobes of a model: its highlights, without what it reflects all over the hemisphere. They are those in slopes
// of the half vector that are slimmer than 1, as BrdfLobe::width_x says. Refers to `brdf`, which must outlive it;
// nullptr where the model has none.
std::unique_ptr<Brdf> make_slim_lobes(const Brdf& brdf);

// The smaller of a model's widths.
double slimmest_width(const Brdf& brdf);

// Where light comes from that `brdf` reflects to an eye right above, as a kernel around the mirrored direction: the lobe
// is then symmetric about the normal; of an anisotropic model, the mean over all tangents. Deterministic.
std::vector<LobeSample> sample_lobe_from_above(const Brdf& brdf, int count);

}  // namespace shlight
