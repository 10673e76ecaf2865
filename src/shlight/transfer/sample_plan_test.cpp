#include "shlight/transfer/sample_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "shlight/sh/zonal.h"
#include "shlight/transfer/sobol.h"

namespace shlight {
namespace {

SiteOcclusion make_random_occlusion(const SamplePlan& plan, std::uint64_t seed) {
  SiteOcclusion occlusion;
  occlusion.is_occluded.resize(plan.samples.set_size);
  for (std::size_t j = 0; j < occlusion.is_occluded.size(); ++j) occlusion.is_occluded[j] = mix_bits(seed + j) & 1;
  for (std::size_t c = 0; c < kCells; ++c)
    occlusion.levels[c] = static_cast<std::uint8_t>(mix_bits(~seed + c) % kCellLevels);
  return occlusion;
}

TEST(SamplePlan, PackingKeepsWhatCounts) {
  const SamplePlan plans[] = {make_fixed_plan(2, 100, 1, 0), make_adaptive_plan(2, 12, 1, 0)};
  for (const SamplePlan& plan : plans) {
    std::vector<std::uint8_t> bytes;
    for (const std::uint64_t seed : {1, 2}) pack_occlusion(plan, make_random_occlusion(plan, seed), bytes);
    std::span<const std::uint8_t> rest = bytes;
    for (const std::uint64_t seed : {1, 2}) {
      const SiteOcclusion before = make_random_occlusion(plan, seed);
      SiteOcclusion after;
      unpack_occlusion(plan, rest, after);
      if (plan.is_adaptive) {
        EXPECT_EQ(after.levels, before.levels);
      }
      EXPECT_EQ(occluded_samples(plan, after).samples, occluded_samples(plan, before).samples);
      EXPECT_EQ(occluded_samples(plan, after).weights, occluded_samples(plan, before).weights);
    }
    EXPECT_TRUE(rest.empty());
  }
}

// Each cell is as large as another, however many rays it got.
TEST(SamplePlan, WhatIsAllOccludedWeighsOne) {
  const SamplePlan plans[] = {make_fixed_plan(2, 100, 1, 0), make_adaptive_plan(2, 12, 1, 0)};
  for (const SamplePlan& plan : plans) {
    SiteOcclusion occlusion = make_random_occlusion(plan, 7);
    std::ranges::fill(occlusion.is_occluded, std::uint8_t{1});
    const OccludedSamples occluded = occluded_samples(plan, occlusion);
    EXPECT_NEAR(std::accumulate(occluded.weights.begin(), occluded.weights.end(), 0.0), 1, 1e-6);
    EXPECT_EQ(occluded.samples.size(), num_rays(plan, occlusion));
  }
}

// What is all occluded is missing wholly: of the adaptive plan to the closed form, cell by cell.
TEST(SamplePlan, AllOccludedMissesTheCosineTransfer) {
  constexpr int kBands = 10;
  const SamplePlan plan = make_adaptive_plan(kBands, 3, 1, 0);
  SiteOcclusion occlusion = make_random_occlusion(plan, 7);
  std::ranges::fill(occlusion.is_occluded, std::uint8_t{1});
  std::vector<double> missing(100);
  ASSERT_TRUE(sum_occluded(plan, {}, occlusion, missing));
  for (int l = 0; l < kBands; ++l)
    for (int m = -l; m <= l; ++m)
      EXPECT_NEAR(missing[static_cast<std::size_t>(coefficient_index(l, m))],
                  m == 0 ? cosine_lobe(l) / std::numbers::pi : 0, 1e-4)
          << "degree " << l << ", " << m;
  std::ranges::fill(occlusion.is_occluded, std::uint8_t{0});
  EXPECT_FALSE(sum_occluded(plan, {}, occlusion, missing));
}

// A half-space of directions through the normal hides half; the mean over sets and turns is right to their noise.
TEST(SamplePlan, HalfOccludedMissesHalfWhateverTheLevels) {
  const SamplePlan plan = make_adaptive_plan(2, 6, 1, 0);
  double mean = 0;
  constexpr std::size_t kSites = 1024;
  for (std::size_t site = 0; site < kSites; ++site) {
    const SiteSamples samples = make_site_samples(plan, site, {0, 0, 1}, 1);
    SiteOcclusion occlusion = make_random_occlusion(plan, site);
    for (std::size_t j = 0; j < plan.samples.set_size; ++j)
      occlusion.is_occluded[j] = plan.samples.x[samples.set * plan.samples.set_size + j] > 0.1f;
    std::vector<double> missing(4);
    sum_occluded(plan, samples, occlusion, missing);
    mean += std::sqrt(4 * std::numbers::pi) * missing[0] / kSites;
  }
  // The disc beyond x = 0.1.
  const double expected = (std::acos(0.1) - 0.1 * std::sqrt(1 - 0.01)) / std::numbers::pi;
  EXPECT_NEAR(mean, expected, 1e-3);  // five standard deviations
}

TEST(SamplePlan, DensitiesBetweenPowersOfTwoAreMixed) {
  EXPECT_EQ(make_adaptive_plan(2, 8, 1, 0).dense_share, 0);
  const SamplePlan plan = make_adaptive_plan(2, 11, 1, 0);
  EXPECT_EQ(plan.samples_per_cell, (std::array<std::uint32_t, kCellLevels>{1, 2, 8, 2, 4, 16}));
  const double share = plan.dense_share;
  EXPECT_NEAR((1 - share) + share * std::pow(error_ratio(2), 2), std::pow(error_ratio(11.0 / 8), 2), 1e-12);
  std::size_t dense = 0;
  for (std::size_t site = 0; site < 4000; ++site) dense += make_site_samples(plan, site, {0, 0, 1}, 1).first_level > 0;
  EXPECT_NEAR(static_cast<double>(dense) / 4000, share, 0.04);  // five standard deviations
}

TEST(SamplePlan, NeighboursTakeDifferentSamples) {
  const SamplePlan plan = make_fixed_plan(2, 16, 1, 0);
  std::vector<std::size_t> uses(plan.samples.num_sets);
  constexpr std::size_t kSites = 1600;
  for (std::size_t site = 0; site < kSites; ++site) ++uses[make_site_samples(plan, site, {0, 0, 1}, 1).set];
  // Each set a hundred times but for chance: six standard deviations.
  for (const std::size_t count : uses) EXPECT_NEAR(static_cast<double>(count), 100, 60);
}

}  // namespace
}  // namespace shlight
