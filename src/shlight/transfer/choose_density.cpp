#include "shlight/transfer/choose_density.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "shlight/core/parallel.h"
#include "shlight/sh/coefficients.h"
#include "shlight/transfer/cosine_transfer.h"
#include "shlight/transfer/trace_occlusion.h"
#include "shlight/transfer/transfer.h"

namespace shlight {
namespace {

// Densities above the highest power of two would need samples of the next.
constexpr double kMaxDensity = kMaxTransferSamples / kCells / 2;

// Pilot sites come in small groups of neighbours, since rays of neighbours are cheaper: one site in 16, and not more
// than a thousand in all, which give the error to about a fifteenth.
constexpr std::size_t kGroupSize = 8;
std::size_t num_groups(const Sites& sites) {
  return std::clamp(sites.size() / (16 * kGroupSize), std::size_t{8}, std::size_t{128});
}

struct Pilot {
  double error = 0;  // relative
  std::uint64_t rays = 0;
};

Pilot try_density(const Tracer& tracer, const Sites& sites, int bands, double density, std::uint64_t seed,
                  int threads) {
  const SamplePlan plan = make_adaptive_plan(bands, density, seed, threads);
  const FrameRotation rotation(bands);
  const std::size_t n = static_cast<std::size_t>(num_coefficients(bands));
  struct Group {
    double difference = 0, norm = 0;  // sums of squares
    std::uint64_t rays = 0;
  };
  std::vector<Group> groups(num_groups(sites));
  parallel_for(groups.size(), threads, [&](std::size_t g) {
    // Small scenes have fewer sites than pilots: each is taken once.
    const std::size_t begin = g * sites.size() / groups.size(), next = (g + 1) * sites.size() / groups.size();
    const std::size_t end = std::min(next, begin + kGroupSize);
    OcclusionWorkspace w;
    std::vector<double> first(n * (end - begin)), second(n);
    std::vector<float> cosine(n * (end - begin));
    eval_cosine_transfer(bands, std::span(sites.normals).subspan(begin, end - begin), cosine, 1);
    for (const std::uint64_t copy : {1, 2}) {
      // Other sets and other turns than the bake's own.
      trace_occlusion(tracer, sites, begin, end, plan, ~seed + copy, w);
      for (std::size_t k = 0; k < end - begin; ++k) {
        groups[g].rays += num_rays(plan, w.occlusion[k]);
        const std::span<double> missing = copy == 1 ? std::span(first).subspan(n * k, n) : std::span(second);
        if (sum_occluded(plan, w.site_samples[k], w.occlusion[k], missing))
          rotation.to_world(w.site_samples[k].frame, missing);
        if (copy == 1) continue;
        for (std::size_t i = 0; i < n; ++i) {
          groups[g].difference += std::pow(second[i] - first[n * k + i], 2) / 2;
          groups[g].norm += std::pow(double{cosine[n * k + i]} - (first[n * k + i] + second[i]) / 2, 2);
        }
      }
    }
  });
  Group sum;
  for (const Group& group : groups) {
    sum.difference += group.difference;
    sum.norm += group.norm;
    sum.rays += group.rays;
  }
  return {sum.norm > 0 ? std::sqrt(sum.difference / sum.norm) : 0, sum.rays};
}

}  // namespace

DensityChoice choose_density(const Tracer& tracer, const Sites& sites, int bands, double error, std::uint64_t seed,
                             int threads) {
  // The rule for the error is trusted over a factor of four in density.
  constexpr double kTrusted = 4;
  DensityChoice choice;
  double tried = 4;
  for (;;) {
    const Pilot pilot = try_density(tracer, sites, bands, tried, seed, threads);
    choice.rays += pilot.rays;
    // error_ratio's inverse, by bisection.
    double low = 1, high = kMaxDensity;
    for (int step = 0; step < 50; ++step) {
      const double middle = (low + high) / 2;
      (pilot.error * error_ratio(middle / tried) > error ? low : high) = middle;
    }
    if (high > kTrusted * tried) {
      tried *= kTrusted;
      continue;
    }
    choice.density = high;
    choice.estimated_error = pilot.error * error_ratio(high / tried);
    return choice;
  }
}

}  // namespace shlight
