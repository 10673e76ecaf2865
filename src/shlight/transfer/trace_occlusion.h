#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shlight/transfer/ray_stream.h"
#include "shlight/transfer/sample_plan.h"
#include "shlight/transfer/sites.h"
#include "shlight/transfer/tracer.h"

namespace shlight {

// Memory that tracing one batch of sites after the other uses again and again.
struct OcclusionWorkspace {
  RayStream stream;
  std::vector<SiteSamples> site_samples;
  std::vector<SiteOcclusion> occlusion;  // the result: of each site of the batch
};

// Sites that are best traced together: enough for long streams, few enough for the cache.
inline constexpr std::size_t kAdaptiveBatch = 128;
std::size_t fixed_batch_size(std::size_t samples);

// Asks for sites begin … end − 1 what their rays meet.
void trace_occlusion(const Tracer& tracer, const Sites& sites, std::size_t begin, std::size_t end,
                     const SamplePlan& plan, std::uint64_t seed, OcclusionWorkspace& workspace);

}  // namespace shlight
