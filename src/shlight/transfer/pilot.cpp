#include "shlight/transfer/pilot.h"

#include <algorithm>
#include <cmath>

#include "shlight/core/assert.h"
#include "shlight/core/parallel.h"
#include "shlight/sh/coefficients.h"
#include "shlight/transfer/cosine_transfer.h"
#include "shlight/transfer/trace_occlusion.h"

namespace shlight {

std::vector<SiteRange> pilot_groups(const Sites& sites, std::size_t most) {
  constexpr std::size_t kGroupSize = 8;
  const std::size_t count = std::clamp(sites.size() / (16 * kGroupSize), std::size_t{8}, most / kGroupSize);
  std::vector<SiteRange> groups(count);
  for (std::size_t g = 0; g < count; ++g) {
    // Small scenes have fewer sites than pilots: each is taken once.
    const std::size_t begin = g * sites.size() / count, next = (g + 1) * sites.size() / count;
    groups[g] = {begin, std::min(next, begin + kGroupSize)};
  }
  return groups;
}

PilotTransfer trace_pilot(const Tracer& tracer, const Sites& sites, std::span<const SiteRange> groups,
                          const SamplePlan& plan, std::uint64_t seed, int threads) {
  const int bands = plan.samples.bands;
  const FrameRotation rotation(bands);
  const std::size_t n = static_cast<std::size_t>(num_coefficients(bands));
  std::vector<std::size_t> first(groups.size() + 1);
  for (std::size_t g = 0; g < groups.size(); ++g) first[g + 1] = first[g] + groups[g].end - groups[g].begin;
  PilotTransfer pilot;
  pilot.shadowed.resize(n * first.back());
  std::vector<std::uint64_t> rays(groups.size());
  parallel_for(groups.size(), threads, [&](std::size_t g) {
    const auto [begin, end] = groups[g];
    OcclusionWorkspace w;
    trace_occlusion(tracer, sites, begin, end, plan, seed, w);
    std::vector<float> cosine(n * (end - begin));
    eval_cosine_transfer(bands, std::span(sites.normals).subspan(begin, end - begin), cosine, 1);
    std::vector<double> missing(n);
    for (std::size_t k = 0; k < end - begin; ++k) {
      rays[g] += num_rays(plan, w.occlusion[k]);
      if (sum_occluded(plan, w.site_samples[k], w.occlusion[k], missing))
        rotation.to_world(w.site_samples[k].frame, missing);
      for (std::size_t i = 0; i < n; ++i)
        pilot.shadowed[n * (first[g] + k) + i] = double{cosine[n * k + i]} - missing[i];
    }
  });
  for (const std::uint64_t r : rays) pilot.rays += r;
  return pilot;
}

double error_of_independent(std::span<const double> a, std::span<const double> b) {
  SHLIGHT_ASSERT_EQ(a.size(), b.size());
  double difference = 0, norm = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    difference += std::pow(a[i] - b[i], 2) / 2;
    norm += std::pow((a[i] + b[i]) / 2, 2);
  }
  return norm > 0 ? std::sqrt(difference / norm) : 0;
}

}  // namespace shlight
