#pragma once

#include <cstdint>

#include "shlight/transfer/sample_plan.h"
#include "shlight/transfer/sites.h"
#include "shlight/transfer/tracer.h"

namespace shlight {

struct DensityChoice {
  double density = 1;      // for make_adaptive_plan
  std::uint64_t rays = 0;  // that it took to find out
};

// The density at which the root mean square error of shadowed transfer over all sites is at most `error`, relative to
// the transfer's own root mean square, as far as kMaxTransferSamples allow.
//
// Traces a pilot (pilot.h) twice, and again where the answer is far from what was tried. From density to density it is
// known how the error falls (error_ratio).
DensityChoice choose_density(const Tracer& tracer, const Sites& sites, int bands, double error, std::uint64_t seed,
                             int threads);

}  // namespace shlight
