#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "shlight/transfer/sample_plan.h"
#include "shlight/transfer/sites.h"
#include "shlight/transfer/tracer.h"

namespace shlight {

// A few sites, spread over the scene, of which shadowed transfer is traced once more with other samples: the difference
// of two independent results is √2 times the error of each, whatever the error comes from. One site in 16, and not more
// than `most` in all: a thousand give the error to about a fifteenth, half of them to a tenth.
//
// They come in small groups of neighbours, since rays of neighbours are cheaper.
struct SiteRange {
  std::size_t begin = 0, end = 0;
};
std::vector<SiteRange> pilot_groups(const Sites& sites, std::size_t most);

struct PilotTransfer {
  std::vector<double> shadowed;  // bands² of each site of each group
  std::uint64_t rays = 0;
};
// `seed` is other than those of the results that it is compared with.
PilotTransfer trace_pilot(const Tracer& tracer, const Sites& sites, std::span<const SiteRange> groups,
                          const SamplePlan& plan, std::uint64_t seed, int threads);

// The root mean square error of each of two independent results, relative to their mean's own root mean square; 0 where
// both are 0.
double error_of_independent(std::span<const double> a, std::span<const double> b);

}  // namespace shlight
