#include "shlight/transfer/choose_density.h"

#include <algorithm>
#include <vector>

#include "shlight/transfer/pilot.h"
#include "shlight/transfer/transfer.h"

namespace shlight {
namespace {

// Densities above the highest power of two would need samples of the next.
constexpr double kMaxDensity = kMaxTransferSamples / kCells / 2;

}  // namespace

DensityChoice choose_density(const Tracer& tracer, const Sites& sites, int bands, double error, std::uint64_t seed,
                             int threads) {
  // The rule for the error is trusted over so small a factor in density, and the steps to there are no larger than
  // four.
  constexpr double kTrusted = 1.5, kStep = 4;
  constexpr int kMaxRounds = 5;
  constexpr std::size_t kPilotSites = 512;
  DensityChoice choice;
  double tried = 4;
  const std::vector<SiteRange> groups = pilot_groups(sites, kPilotSites);
  for (int round = 1;; ++round) {
    const SamplePlan plan = make_adaptive_plan(bands, tried, seed, threads);
    // Other sets and other turns than the bake's own.
    const PilotTransfer first = trace_pilot(tracer, sites, groups, plan, ~seed + 1, threads),
                        second = trace_pilot(tracer, sites, groups, plan, ~seed + 2, threads);
    const double error_tried = error_of_independent(first.shadowed, second.shadowed);
    choice.rays += first.rays + second.rays;
    // error_ratio's inverse, by bisection.
    double low = 1, high = kMaxDensity;
    for (int step = 0; step < 50; ++step) {
      const double middle = (low + high) / 2;
      (error_tried * error_ratio(middle / tried) > error ? low : high) = middle;
    }
    choice.density = high;
    if (round == kMaxRounds || std::max(high / tried, tried / high) <= kTrusted) return choice;
    tried = std::clamp(high, tried / kStep, tried * kStep);
  }
}

}  // namespace shlight
