#include "shlight/light/project_image.h"

#include <vector>

#include "shlight/sh/floor_bench.h"

namespace shlight {
namespace {

constexpr int kWidth = 1024, kHeight = 512;

// More than the caches of one core hold together: each run takes the next of them, so that every pixel comes from
// memory.
const std::vector<Environment>& environments() {
  static const auto kEnvironments = [] {
    std::vector<Environment> result(24);
    for (Environment& environment : result) {
      environment.image = Image(kWidth, kHeight);
      float value = 0.25f;
      for (float& v : environment.image.values) v = value = value < 1 ? value * 1.7f : value - 0.93f;
    }
    return result;
  }();
  return kEnvironments;
}

// One thread, against a plain read of the same bytes.
void project_lat_long(benchmark::State& state) {
  const auto& all = environments();
  std::size_t run = 0;
  const auto read = [&] {
    const auto& values = all[run++ % all.size()].image.values;
    float sums[64] = {};
    for (std::size_t i = 0; i < values.size(); i += 64)
      for (std::size_t j = 0; j < 64; ++j) sums[j] += values[i + j];
    benchmark::DoNotOptimize(sums);
  };
  const auto project = [&] {
    benchmark::DoNotOptimize(project_image(all[run++ % all.size()], static_cast<int>(state.range(0)), 1));
  };
  run_against_floor(state, kWidth * kHeight, read, project);
}

// Other layouts, of about as many pixels, against the same read.
void project_layout(benchmark::State& state, Layout layout) {
  const PictureSize size = picture_size(layout, size_from_horizon(layout, kWidth));
  Environment environment{Image(size.width, size.height), layout};
  for (float& v : environment.image.values) v = 0.5f;
  const auto read = [&] {
    float sums[64] = {};
    const auto& values = environment.image.values;
    for (std::size_t i = 0; i + 64 <= values.size(); i += 64)
      for (std::size_t j = 0; j < 64; ++j) sums[j] += values[i + j];
    benchmark::DoNotOptimize(sums);
  };
  const auto project = [&] {
    benchmark::DoNotOptimize(project_image(environment, static_cast<int>(state.range(0)), 1));
  };
  run_against_floor(state, static_cast<double>(environment.image.num_pixels()), read, project);
}

BENCHMARK_CAPTURE(project_layout, vertical_strip, Layout::kVerticalStrip)
    ->Arg(3)
    ->Arg(5)
    ->UseManualTime()
    ->ArgName("bands");
BENCHMARK_CAPTURE(project_layout, angular_map, Layout::kAngularMap)->Arg(3)->Arg(5)->UseManualTime()->ArgName("bands");
BENCHMARK_CAPTURE(project_layout, octahedral, Layout::kOctahedral)->Arg(3)->Arg(5)->UseManualTime()->ArgName("bands");

BENCHMARK(project_lat_long)->Arg(3)->Arg(5)->Arg(10)->Arg(32)->Arg(64)->UseManualTime()->ArgName("bands");

}  // namespace
}  // namespace shlight
