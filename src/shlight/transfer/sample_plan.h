#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shlight/transfer/hemisphere_samples.h"
#include "shlight/transfer/local_frame.h"

namespace shlight {

// How densely a cell of the hemisphere is sampled; see SamplePlan. A site takes the first three levels, or the last
// three, which are twice as dense each.
enum CellLevel : std::uint8_t { kBaseLevel, kSecondLookLevel, kEdgeLevel, kSiteLevels };
inline constexpr std::size_t kCellLevels = 2 * kSiteLevels;

// Which directions every site asks about: either a fixed number, or as many as the site needs.
//
// What makes visibility hard to integrate is its edges: a cell of the hemisphere that is all open or all occluded is
// known from one ray, and then its integral is known exactly. For the same rays, the error over all sites together is
// least where every edge is sampled equally densely, whichever site's it is. So an adaptive plan has one density for
// edges, and a site gets rays as it has edges:
//
//   1. a base density everywhere; if nothing is occluded, that is all;
//   2. a second look everywhere, of sites of which much is occluded but not all: what little light such a site gets
//      comes through openings, which are often smaller than a cell. Found by nobody, they would make the site too dark,
//      in every bake alike, so that no comparison of two would tell;
//   3. the full density in cells among which, their eight neighbours included, some is open and some occluded. Beyond
//      the horizon all counts as occluded, since occluders rise from it;
//   4. the same again, as long as the rays of the last turn find more such cells: along an edge from where it was
//      found.
//
// Whether a cell with an edge is found depends on its neighbours too, not just on its own rays, which keeps the result
// nearly free of bias.
struct SamplePlan {
  HemisphereSamples samples;
  bool is_adaptive = false;
  // The rest is for adaptive plans only. Of cells at each level: powers of two, for which the samples are best. A share
  // of the sites takes the higher levels, which makes densities between the two.
  std::array<std::uint32_t, kCellLevels> samples_per_cell = {};
  double dense_share = 0;
  // ∫ Y_i over each cell, with the density of the samples; and by how much that is more than what a set's samples of a
  // level make of it: row (set · kCellLevels + level) · kCells + cell.
  std::vector<Lanes> cell_integrals, cell_corrections;
};

SamplePlan make_fixed_plan(int bands, std::size_t samples, std::uint64_t seed, int threads);
// `density` >= 1 is the number of samples in a cell near an edge, as a mean over sites.
SamplePlan make_adaptive_plan(int bands, double density, std::uint64_t seed, int threads);

// The error at one density over that at another, `density_ratio` times less dense: the power −3/4 of it, as edges have
// it that are sampled with one point in each of many boxes.
double error_ratio(double density_ratio);

// How a site uses a plan.
struct SiteSamples {
  LocalFrame frame;
  std::size_t set = 0;
  std::uint8_t first_level = 0;  // 0 or kSiteLevels
};
SiteSamples make_site_samples(const SamplePlan& plan, std::size_t site, Vec3f normal, std::uint64_t seed);

// What a site's rays met. Kept for as long as light bounces, in as little memory as it takes (pack_occlusion).
struct SiteOcclusion {
  std::vector<std::uint8_t> is_occluded;         // of each sample of a set; only those asked about mean anything
  std::array<std::uint8_t, kCells> levels = {};  // of each cell, where the plan is adaptive
};

std::size_t num_rays(const SamplePlan& plan, const SiteOcclusion& occlusion);

// The samples that are occluded, and for how much of the integral each of them stands.
struct OccludedSamples {
  std::vector<std::uint32_t> samples;
  std::vector<float> weights;
};
OccludedSamples occluded_samples(const SamplePlan& plan, const SiteOcclusion& occlusion);

// What is missing from a site's cosine transfer, ∫ (1 − V) max(0, n·s)/π Y_i ds in its frame: bands² values. Only what
// is occluded is sampled, the rest of the transfer is known in closed form. Returns whether anything is missing.
bool sum_occluded(const SamplePlan& plan, const SiteSamples& site, const SiteOcclusion& occlusion,
                  std::span<double> coefficients);

// A bit for each ray, and three for each cell where the plan is adaptive.
void pack_occlusion(const SamplePlan& plan, const SiteOcclusion& occlusion, std::vector<std::uint8_t>& bytes);
// Reads what pack_occlusion appended, and takes it off the front of `bytes`.
void unpack_occlusion(const SamplePlan& plan, std::span<const std::uint8_t>& bytes, SiteOcclusion& occlusion);

}  // namespace shlight
