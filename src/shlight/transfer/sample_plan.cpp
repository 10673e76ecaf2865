#include "shlight/transfer/sample_plan.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <numbers>

#include "shlight/core/assert.h"
#include "shlight/core/parallel.h"
#include "shlight/sh/basis.h"
#include "shlight/sh/coefficients.h"
#include "shlight/transfer/sobol.h"

namespace shlight {
namespace {

// As many sets as fit into some megabytes, at least 4.
std::size_t num_sets(int bands, std::size_t set_size) {
  constexpr std::size_t kMemory = 64 << 20;
  const std::size_t bytes = set_size * (sizeof(float) * static_cast<std::size_t>(num_coefficients(bands)) + 64);
  std::size_t sets = 16;
  while (sets > 4 && sets * bytes > kMemory) sets /= 2;
  return sets;
}

// Uniform in [0, 1).
double unit_interval(std::uint64_t random) {
  return static_cast<double>(random >> 11) * 0x1p-53;
}

void set_row(std::span<const double> values, Lanes* row) {
  constexpr std::size_t kWidth = std::size(Lanes{}.values);
  for (std::size_t i = 0; i < values.size(); ++i) row[i / kWidth].values[i % kWidth] = static_cast<float>(values[i]);
}

// By the midpoint rule, good to 5e-5 at 10 bands; with more points at the horizon, where height is a square root.
std::vector<Lanes> integrate_cells(int bands, int threads) {
  const std::size_t n = static_cast<std::size_t>(num_coefficients(bands)), row_size = row_size_of(bands);
  std::vector<Lanes> rows(kCells * row_size);
  parallel_for(kCellSide, threads, [&](std::size_t y) {
    std::vector<double> basis(n), sums(n);
    for (std::size_t x = 0; x < kCellSide; ++x) {
      std::ranges::fill(sums, 0.0);
      const bool is_at_horizon = x == 0 || x == kCellSide - 1 || y == 0 || y == kCellSide - 1;
      const std::size_t steps = is_at_horizon ? 64 : 16;
      const double step = 1 / static_cast<double>(steps * kCellSide);
      for (std::size_t j = y * steps; j < (y + 1) * steps; ++j)
        for (std::size_t k = x * steps; k < (x + 1) * steps; ++k) {
          const double u = (static_cast<double>(k) + 0.5) * step, v = (static_cast<double>(j) + 0.5) * step;
          eval_basis(bands, lift_to_hemisphere(u, v), std::span<double>(basis));
          for (std::size_t i = 0; i < n; ++i) sums[i] += step * step * basis[i];
        }
      set_row(sums, rows.data() + (y * kCellSide + x) * row_size);
    }
  });
  return rows;
}

std::vector<Lanes> make_cell_corrections(const SamplePlan& plan, int threads) {
  const HemisphereSamples& samples = plan.samples;
  const std::size_t row_size = samples.row_size, levels = kCellLevels;
  constexpr std::size_t kWidth = std::size(Lanes{}.values);
  std::vector<Lanes> rows(samples.num_sets * levels * kCells * row_size);
  parallel_for(samples.num_sets * levels, threads, [&](std::size_t task) {
    const std::size_t set = task / levels;
    // A level that no site uses has no samples.
    const std::size_t count = std::min<std::size_t>(plan.samples_per_cell[task % levels], samples.set_size / kCells);
    std::vector<double> sums(row_size * kWidth);
    for (std::size_t c = 0; c < kCells; ++c) {
      for (std::size_t i = 0; i < sums.size(); ++i)
        sums[i] = double{plan.cell_integrals[c * row_size + i / kWidth].values[i % kWidth]};
      for (std::size_t k = 0; k < count; ++k) {
        const Lanes* row = samples.row(set, k * kCells + c);
        for (std::size_t i = 0; i < sums.size(); ++i)
          sums[i] -= double{row[i / kWidth].values[i % kWidth]} / static_cast<double>(kCells * count);
      }
      set_row(sums, rows.data() + (task * kCells + c) * row_size);
    }
  });
  return rows;
}

// Calls f(sample) for each sample that was asked about, in the sequence in which they are packed.
template <class F>
void for_each_sample(const SamplePlan& plan, const SiteOcclusion& occlusion, const F& f) {
  if (!plan.is_adaptive) {
    for (std::size_t j = 0; j < plan.samples.set_size; ++j) f(j);
    return;
  }
  for (std::size_t k = 0; k < plan.samples.set_size / kCells; ++k)
    for (std::size_t c = 0; c < kCells; ++c)
      if (k < plan.samples_per_cell[occlusion.levels[c]]) f(k * kCells + c);
}

}  // namespace

SamplePlan make_fixed_plan(int bands, std::size_t samples, std::uint64_t seed, int threads) {
  SamplePlan plan;
  plan.samples = make_hemisphere_samples(bands, samples, false, num_sets(bands, samples), seed, threads);
  return plan;
}

double error_ratio(double density_ratio) {
  return std::pow(density_ratio, -0.75);
}

SamplePlan make_adaptive_plan(int bands, double density, std::uint64_t seed, int threads) {
  SHLIGHT_ASSERT_GE(density, 1.0);
  SamplePlan plan;
  plan.is_adaptive = true;
  const std::uint32_t low = std::bit_floor(static_cast<std::uint32_t>(density)), high = 2 * low;
  // Squares of errors add up over sites: between the densities' own they mix in proportion.
  const auto square = [](double d) { return std::pow(error_ratio(d), 2); };
  plan.dense_share = (square(low) - square(density)) / (square(low) - square(high));
  // An eighth everywhere, and a quarter of the hardly open, are enough to find edges at all densities.
  std::size_t level = 0;
  for (const std::uint32_t d : {low, high})
    for (const std::uint32_t count : {std::max(1u, d / 8), std::max(std::min(2u, d), d / 4), d})
      plan.samples_per_cell[level++] = count;
  const std::size_t set_size = kCells * (plan.dense_share > 0 ? high : low);
  plan.samples = make_hemisphere_samples(bands, set_size, true, num_sets(bands, set_size), seed, threads);
  plan.cell_integrals = integrate_cells(bands, threads);
  plan.cell_corrections = make_cell_corrections(plan, threads);
  return plan;
}

SiteSamples make_site_samples(const SamplePlan& plan, std::size_t site, Vec3f normal, std::uint64_t seed) {
  const std::uint64_t random = mix_bits(mix_bits(seed) ^ site), other = mix_bits(random);
  SiteSamples samples;
  samples.frame = make_local_frame(vec_cast<double>(normal), 2 * std::numbers::pi * unit_interval(random));
  samples.set = random % plan.samples.num_sets;
  samples.first_level = unit_interval(other) < plan.dense_share ? kSiteLevels : 0;
  return samples;
}

std::size_t num_rays(const SamplePlan& plan, const SiteOcclusion& occlusion) {
  if (!plan.is_adaptive) return plan.samples.set_size;
  std::size_t rays = 0;
  for (const std::uint8_t level : occlusion.levels) rays += plan.samples_per_cell[level];
  return rays;
}

OccludedSamples occluded_samples(const SamplePlan& plan, const SiteOcclusion& occlusion) {
  OccludedSamples result;
  const float weight = 1 / static_cast<float>(plan.samples.set_size);
  std::array<float, kCellLevels> level_weights = {};
  for (std::size_t level = 0; level < level_weights.size(); ++level)
    level_weights[level] = 1 / static_cast<float>(kCells * plan.samples_per_cell[level]);
  for_each_sample(plan, occlusion, [&](std::size_t j) {
    if (!occlusion.is_occluded[j]) return;
    result.samples.push_back(static_cast<std::uint32_t>(j));
    result.weights.push_back(plan.is_adaptive ? level_weights[occlusion.levels[j % kCells]] : weight);
  });
  return result;
}

bool sum_occluded(const SamplePlan& plan, const SiteSamples& site, const SiteOcclusion& occlusion,
                  std::span<double> coefficients) {
  std::ranges::fill(coefficients, 0.0);
  OccludedSamples occluded = occluded_samples(plan, occlusion);
  if (occluded.samples.empty()) return false;
  const std::size_t row_size = plan.samples.row_size;
  if (!plan.is_adaptive) {
    add_rows(plan.samples.row(site.set, 0), row_size, occluded.samples, occluded.weights, coefficients);
    return true;
  }

  // A cell of which the share o is occluded misses ∫ (1 − V) Y = o ∫ Y + ∫ ((1 − V) − o) Y. The first part is known,
  // the second, sampled, is small where the cell is small and nothing where it is all occluded.
  std::array<std::uint32_t, kCells> counts = {};
  for (const std::uint32_t j : occluded.samples) ++counts[j % kCells];
  const auto count_of_all = [&](std::size_t c) { return plan.samples_per_cell[occlusion.levels[c]]; };
  OccludedSamples whole, corrections;
  for (std::size_t c = 0; c < kCells; ++c) {
    if (counts[c] == 0) continue;
    OccludedSamples& list = counts[c] == count_of_all(c) ? whole : corrections;
    const std::size_t row = (site.set * kCellLevels + occlusion.levels[c]) * kCells + c;
    list.samples.push_back(static_cast<std::uint32_t>(&list == &whole ? c : row));
    list.weights.push_back(static_cast<float>(counts[c]) / static_cast<float>(count_of_all(c)));
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < occluded.samples.size(); ++i) {
    const std::size_t c = occluded.samples[i] % kCells;
    if (counts[c] == count_of_all(c)) continue;
    occluded.samples[kept] = occluded.samples[i];
    occluded.weights[kept++] = occluded.weights[i];
  }
  occluded.samples.resize(kept), occluded.weights.resize(kept);
  add_rows(plan.cell_integrals.data(), row_size, whole.samples, whole.weights, coefficients);
  add_rows(plan.cell_corrections.data(), row_size, corrections.samples, corrections.weights, coefficients);
  add_rows(plan.samples.row(site.set, 0), row_size, occluded.samples, occluded.weights, coefficients);
  return true;
}

void pack_occlusion(const SamplePlan& plan, const SiteOcclusion& occlusion, std::vector<std::uint8_t>& bytes) {
  unsigned pending = 0;
  int used = 0;
  const auto put = [&](unsigned value, int bits) {
    pending |= value << used;
    used += bits;
    if (used < 8) return;
    bytes.push_back(static_cast<std::uint8_t>(pending));
    pending >>= 8, used -= 8;
  };
  if (plan.is_adaptive)
    for (const std::uint8_t level : occlusion.levels) put(level, 3);
  for_each_sample(plan, occlusion, [&](std::size_t j) { put(occlusion.is_occluded[j], 1); });
  if (used > 0) bytes.push_back(static_cast<std::uint8_t>(pending));
}

void unpack_occlusion(const SamplePlan& plan, std::span<const std::uint8_t>& bytes, SiteOcclusion& occlusion) {
  occlusion.is_occluded.assign(plan.samples.set_size, 0);
  std::size_t next = 0;
  const auto get = [&](unsigned bits) {
    // They may reach into the next byte.
    const unsigned more = next / 8 + 1 < bytes.size() ? bytes[next / 8 + 1] : 0u;
    const unsigned value = (bytes[next / 8] | more << 8) >> (next % 8) & ((1u << bits) - 1);
    next += bits;
    return static_cast<std::uint8_t>(value);
  };
  if (plan.is_adaptive)
    for (std::uint8_t& level : occlusion.levels) level = get(3);
  for_each_sample(plan, occlusion, [&](std::size_t j) { occlusion.is_occluded[j] = get(1); });
  bytes = bytes.subspan((next + 7) / 8);
}

}  // namespace shlight
