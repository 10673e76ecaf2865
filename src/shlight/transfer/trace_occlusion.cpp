#include "shlight/transfer/trace_occlusion.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace shlight {
namespace {

// Half a megabyte of rays and what makes them: long enough that rays of a stream go in similar directions, and in the
// second cache even where others use it too.
constexpr std::size_t kStreamRays = 1 << 13;

// The rays of `samples[k]` for each site k of a batch.
void trace_samples(const Tracer& tracer, const Sites& sites, std::size_t begin, const HemisphereSamples& samples,
                   std::span<const std::span<const std::uint32_t>> samples_of_site, OcclusionWorkspace& w) {
  // Some samples of each site, then some more, so that a stream holds neighbours.
  constexpr std::size_t kRun = 512;
  std::vector<RaySegment> segments;
  std::vector<std::size_t> owners;
  std::vector<std::uint8_t> is_occluded;
  std::size_t rays = 0;
  const auto flush = [&] {
    w.stream.fill(samples, segments);
    tracer.find_occluded(w.stream.rays());
    is_occluded.resize(rays);
    for (const Ray& ray : w.stream.rays()) is_occluded[ray.id] = ray.far < 0;
    const std::uint8_t* answer = is_occluded.data();
    for (std::size_t s = 0; s < segments.size(); ++s)
      for (const std::uint32_t j : segments[s].samples) w.occlusion[owners[s]].is_occluded[j] = *answer++;
    segments.clear(), owners.clear();
    rays = 0;
  };
  std::size_t longest = 0;
  for (const auto& list : samples_of_site) longest = std::max(longest, list.size());
  for (std::size_t first = 0; first < longest; first += kRun)
    for (std::size_t k = 0; k < samples_of_site.size(); ++k) {
      if (first >= samples_of_site[k].size()) continue;
      const auto run = samples_of_site[k].subspan(first, std::min(kRun, samples_of_site[k].size() - first));
      segments.push_back({sites.origins[begin + k], w.site_samples[k].frame, w.site_samples[k].set, run});
      owners.push_back(k);
      rays += run.size();
      if (rays >= kStreamRays) flush();
    }
  if (rays > 0) flush();
}

using CellMask = std::array<bool, kCells>;

// Whether so many rays tell that much of a site is occluded, but not all: light comes through openings.
bool is_hardly_open(std::size_t occluded, std::size_t rays) {
  constexpr double kMuch = 0.25;
  return static_cast<double>(occluded) > kMuch * static_cast<double>(rays) && occluded < rays;
}

// Cells among which, their neighbours included, some ray is open and some occluded.
CellMask find_edge_cells(const SamplePlan& plan, const SiteOcclusion& occlusion) {
  enum : std::uint8_t { kOpen = 1, kOccluded = 2, kBoth = 3 };
  constexpr std::size_t kPadded = kCellSide + 2;
  // With what is beyond the horizon around them.
  std::array<std::uint8_t, kPadded * kPadded> found;
  found.fill(kOccluded);
  for (std::size_t c = 0; c < kCells; ++c) {
    std::uint8_t all = 0;
    for (std::size_t k = 0; k < plan.samples_per_cell[occlusion.levels[c]]; ++k)
      all |= occlusion.is_occluded[k * kCells + c] ? kOccluded : kOpen;
    found[(c / kCellSide + 1) * kPadded + c % kCellSide + 1] = all;
  }
  CellMask edges = {};
  for (std::size_t c = 0; c < kCells; ++c) {
    const std::uint8_t* corner = found.data() + c / kCellSide * kPadded + c % kCellSide;
    std::uint8_t all = 0;
    for (std::size_t v = 0; v < 3; ++v)
      for (std::size_t u = 0; u < 3; ++u) all |= corner[v * kPadded + u];
    edges[c] = all == kBoth;
  }
  return edges;
}

// Raises the cells to a level; appends the samples that they need for it.
void raise_levels(const SamplePlan& plan, const CellMask& cells, std::uint8_t level, SiteOcclusion& occlusion,
                  std::vector<std::uint32_t>& samples) {
  const std::uint32_t count = plan.samples_per_cell[level];
  for (std::size_t c = 0; c < kCells; ++c) {
    if (!cells[c] || occlusion.levels[c] == level) continue;
    for (std::uint32_t k = plan.samples_per_cell[occlusion.levels[c]]; k < count; ++k)
      samples.push_back(static_cast<std::uint32_t>(k * kCells + c));
    occlusion.levels[c] = level;
  }
}

}  // namespace

std::size_t fixed_batch_size(std::size_t samples) {
  return std::clamp(kStreamRays / samples, std::size_t{64}, std::size_t{1024});
}

void trace_occlusion(const Tracer& tracer, const Sites& sites, std::size_t begin, std::size_t end,
                     const SamplePlan& plan, std::uint64_t seed, OcclusionWorkspace& w) {
  const std::size_t count = end - begin;
  w.site_samples.resize(count);
  w.occlusion.resize(count);
  for (std::size_t k = 0; k < count; ++k) {
    w.site_samples[k] = make_site_samples(plan, begin + k, sites.normals[begin + k], seed);
    w.occlusion[k].is_occluded.resize(plan.samples.set_size);
    w.occlusion[k].levels.fill(w.site_samples[k].first_level);
  }

  std::vector<std::uint32_t> numbers(plan.samples.set_size);
  std::iota(numbers.begin(), numbers.end(), 0u);
  std::vector<std::span<const std::uint32_t>> samples(count, numbers);
  if (plan.is_adaptive)
    for (std::size_t k = 0; k < count; ++k)
      samples[k] = samples[k].first(kCells * plan.samples_per_cell[w.site_samples[k].first_level]);
  trace_samples(tracer, sites, begin, plan.samples, samples, w);
  if (!plan.is_adaptive) return;

  std::vector<std::vector<std::uint32_t>> added(count);
  const auto raise = [&](std::size_t k, const CellMask& cells, CellLevel level) {
    raise_levels(plan, cells, static_cast<std::uint8_t>(w.site_samples[k].first_level + level), w.occlusion[k],
                 added[k]);
  };
  const auto trace_added = [&] {
    std::ranges::copy(added, samples.begin());
    trace_samples(tracer, sites, begin, plan.samples, samples, w);
    for (std::vector<std::uint32_t>& list : added) list.clear();
  };
  // Of sites of which nothing is occluded, all is known.
  std::vector<std::size_t> left;
  CellMask all;
  all.fill(true);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t rays = samples[k].size();
    const auto occluded =
        static_cast<std::size_t>(std::ranges::count(std::span(w.occlusion[k].is_occluded).first(rays), 1));
    if (occluded > 0) left.push_back(k);
    if (is_hardly_open(occluded, rays)) raise(k, all, kSecondLookLevel);
  }
  trace_added();
  while (!left.empty()) {
    for (const std::size_t k : left) raise(k, find_edge_cells(plan, w.occlusion[k]), kEdgeLevel);
    std::erase_if(left, [&](std::size_t k) { return added[k].empty(); });
    trace_added();
  }
}

}  // namespace shlight
