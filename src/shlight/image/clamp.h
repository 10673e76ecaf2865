#pragma once

#include <cstdint>

#include "shlight/image/environment.h"

namespace shlight {

// What clamping took from a light.
struct ClampReport {
  double max = 0;
  std::uint64_t above = 0, negative = 0;  // pixels with such a channel
  Rgb total;   // integral of the radiance over all directions as it was, negative values and all
  Rgb lost;    // of it, what was above `max`
  Rgb gained;  // and what negative values took away, now 0: total − lost + gained is left

  // The lost part of the total's luminance, in [0, 1]; 0 for a light of none.
  double lost_share() const;
};

// Clamps each channel of each pixel to [0, max] by itself, which makes bright colours paler: what is left is at most
// `max` in any channel, and as much of the light as can be so. Values must be finite, `max` positive. Costs a solid
// angle a pixel. `threads`: 0 for all there are.
ClampReport clamp_radiance(Environment& environment, double max, int threads = 0);

}  // namespace shlight
