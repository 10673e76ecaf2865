#include "shlight/transfer/choose_density.h"

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
  // The rule for the error is trusted over a factor of four in density.
  constexpr double kTrusted = 4;
  DensityChoice choice;
  double tried = 4;
  const std::vector<SiteRange> groups = pilot_groups(sites);
  for (;;) {
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
    if (high > kTrusted * tried) {
      tried *= kTrusted;
      continue;
    }
    choice.density = high;
    choice.estimated_error = error_tried * error_ratio(high / tried);
    return choice;
  }
}

}  // namespace shlight
