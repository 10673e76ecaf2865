#include "shlight/truth/accumulate_paths.h"

#include <gtest/gtest.h>

#include <cmath>

#include "shlight/light/builtin_light.h"
#include "shlight/scene/builtin_scene.h"

namespace shlight {
namespace {

double rms_difference(const Image& a, const Image& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.values.size(); ++i) sum += std::pow(double{a.values[i]} - double{b.values[i]}, 2);
  return std::sqrt(sum / static_cast<double>(a.values.size()));
}

double rms_deviation(const PathTraceResult& result) {
  double sum = 0;
  for (const float v : result.variance.values) sum += double{v};
  return std::sqrt(sum / static_cast<double>(result.variance.values.size()));
}

// Eight passes of 32 paths are as near to the truth as 256 in one are, and say so.
TEST(AccumulatePaths, PassesConvergeAndKnowTheirNoise) {
  const Scene scene = make_sphere_scene();
  const auto light = make_studio_light();
  PathTraceParams params;
  params.width = 40, params.height = 30, params.transfer = TransferKind::kCosine;
  params.samples = 1024, params.seed = 1000;
  const PathTraceResult truth = trace_paths(scene, *light, params);

  params.samples = 32;
  PathTraceResult sum;
  double first = 0;
  for (params.seed = 1; params.seed <= 8; ++params.seed) {
    accumulate_paths(trace_paths(scene, *light, params), sum);
    if (params.seed == 1) first = rms_difference(sum.radiance, truth.radiance);
  }
  EXPECT_EQ(sum.samples, 256);
  const double error = rms_difference(sum.radiance, truth.radiance);
  EXPECT_LT(error, 0.6 * first) << "eight times the paths: a third, and not less than what noise does to that";
  EXPECT_NEAR(error / std::hypot(rms_deviation(sum), rms_deviation(truth)), 1, 0.25) << "the deviation it states";
}

}  // namespace
}  // namespace shlight
