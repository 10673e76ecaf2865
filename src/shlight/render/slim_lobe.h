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

// Where light comes from that a model of slim lobes reflects to an eye right above, as a kernel around the mirrored
// direction. Of an anisotropic model it is as slim both ways as the slimmer of the two, and what makes it wide the
// other way are copies of it: around the directions mirrored at half vectors of these slopes along x or y.
struct LobeFromAbove {
  std::vector<LobeSample> samples;
  std::vector<float> profile;  // the kernel against sin(θ/2), θ from 0 to 90° in equal steps of that, of any scale
  double width = 1;            // the smaller BrdfLobe::width_x or _y
  std::vector<float> slopes = {0};  // kLobeTaps where the widths differ, all of the same weight
  bool wide_along_x = false;

  // How many half vectors have a slope, per unit of area of slopes, which are (h_x/h_z, h_y/h_z) with the wide one
  // shrunk by slim_over_wide: against r/(r + width) of their length r, in kDensitySteps equal steps from 0 to 1. The
  // integral over slopes as they are is 1.
  std::vector<float> slope_density;
  double slim_over_wide = 1;
};
inline constexpr int kDensitySteps = 511;
inline constexpr int kLobeTaps = 16;

// Deterministic; `count` samples.
LobeFromAbove sample_lobe_from_above(const Brdf& brdf, int count);

}  // namespace shlight
