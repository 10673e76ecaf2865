#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shlight/transfer/ray_stream.h"
#include "shlight/transfer/sample_plan.h"
#include "shlight/transfer/sites.h"
#include "shlight/transfer/surfaces.h"
#include "shlight/transfer/tracer.h"

namespace shlight {

// All that one bounce of light is made from.
struct BounceSource {
  const Tracer& tracer;
  const Sites& sites;
  const Surfaces& surfaces;
  const SamplePlan& plan;
  std::uint64_t seed = 0;
  std::span<const float> transfer;  // A_{b−1} of each site: red, green, blue, bands² coefficients each
};

// Memory that one batch of sites after the other uses again and again.
struct BounceWorkspace {
  RayStream stream;
  std::vector<Hit> hits, sorted_hits;
  std::vector<Vec3f> directions;
  SiteOcclusion occlusion;
};

// One bounce for sites begin … end − 1: A_b(x) = ∫ (1 − V) max(0, n·ω)/π ρ(y) A_{b−1}(y) dω, where A_{b−1} at the point
// y is interpolated between its triangle's corners. The directions are those that were found occluded (`packed`, what
// pack_occlusion made of these sites), so that what is open and what reflects add up to one. Writes 3 bands² values a
// site to `result`; returns the number of rays.
std::size_t gather_bounce(const BounceSource& source, std::size_t begin, std::size_t end,
                          std::span<const std::uint8_t> packed, std::span<float> result, BounceWorkspace& workspace);

}  // namespace shlight
