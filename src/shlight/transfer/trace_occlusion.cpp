#include "shlight/transfer/trace_occlusion.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace shlight {
namespace {

// Two megabytes of rays: long enough that rays of a stream go in similar directions, and still in the second cache.
constexpr std::size_t kStreamRays = 1 << 15;

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

// What the base samples found in a cell: nothing occluded, something, all.
struct CellState {
  bool has_open = false, has_occluded = false;
};

// The samples that cells near edges still need; raises their levels.
void add_edge_samples(const SamplePlan& plan, std::uint8_t edge_level, SiteOcclusion& occlusion,
                      std::vector<std::uint32_t>& samples) {
  const std::uint32_t base = plan.samples_per_cell[0], count = plan.samples_per_cell[edge_level];
  std::array<CellState, kCells> states;
  for (std::uint32_t j = 0; j < base * kCells; ++j) {
    CellState& state = states[j % kCells];
    (occlusion.is_occluded[j] ? state.has_occluded : state.has_open) = true;
  }
  constexpr int kSide = static_cast<int>(kCellSide);
  const auto is_near_edge = [&](int x, int y) {
    CellState all;
    for (int v = y - 1; v <= y + 1; ++v)
      for (int u = x - 1; u <= x + 1; ++u) {
        const bool is_above_horizon = u >= 0 && u < kSide && v >= 0 && v < kSide;
        const CellState state =
            is_above_horizon ? states[static_cast<std::size_t>(v * kSide + u)] : CellState{false, true};
        all.has_open |= state.has_open, all.has_occluded |= state.has_occluded;
      }
    return all.has_open && all.has_occluded;
  };
  for (std::size_t c = 0; c < kCells; ++c)
    if (is_near_edge(static_cast<int>(c % kCellSide), static_cast<int>(c / kCellSide)))
      occlusion.levels[c] = edge_level;
  for (std::uint32_t k = base; k < count; ++k)
    for (std::uint32_t c = 0; c < kCells; ++c)
      if (occlusion.levels[c] == edge_level) samples.push_back(static_cast<std::uint32_t>(k * kCells + c));
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
    w.occlusion[k].levels = {};
  }

  const std::size_t num_first = plan.is_adaptive ? kCells * plan.samples_per_cell[0] : plan.samples.set_size;
  std::vector<std::uint32_t> first(num_first);
  std::iota(first.begin(), first.end(), 0u);
  std::vector<std::span<const std::uint32_t>> samples(count, first);
  trace_samples(tracer, sites, begin, plan.samples, samples, w);
  if (!plan.is_adaptive) return;

  std::vector<std::vector<std::uint32_t>> added(count);
  for (std::size_t k = 0; k < count; ++k) {
    const auto found = std::span(w.occlusion[k].is_occluded).first(num_first);
    if (std::ranges::find(found, 1) != found.end())
      add_edge_samples(plan, w.site_samples[k].edge_level, w.occlusion[k], added[k]);
    samples[k] = added[k];
  }
  trace_samples(tracer, sites, begin, plan.samples, samples, w);
}

}  // namespace shlight
