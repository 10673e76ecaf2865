#include "shlight/light/project_image.h"

#include <benchmark/benchmark.h>

#include <vector>

namespace shlight {
namespace {

constexpr int kWidth = 1024, kHeight = 512;

// More than the caches of one core hold together: each run reads the next of them, so that every pixel comes from
// memory.
const std::vector<Environment>& environments() {
  static const auto kEnvironments = [] {
    std::vector<Environment> result(12);
    for (Environment& environment : result) {
      environment.image = Image(kWidth, kHeight);
      float value = 0.25f;
      for (float& v : environment.image.values) v = value = value < 1 ? value * 1.7f : value - 0.93f;
    }
    return result;
  }();
  return kEnvironments;
}

void count_pixels(benchmark::State& state) {
  state.counters["s/pixel"] =
      benchmark::Counter(kWidth * kHeight, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

// The floor: a plain read of the same bytes.
void floor_read(benchmark::State& state) {
  std::size_t run = 0;
  for (auto _ : state) {
    const auto& values = environments()[run++ % environments().size()].image.values;
    float sums[64] = {};
    for (std::size_t i = 0; i < values.size(); i += 64)
      for (std::size_t j = 0; j < 64; ++j) sums[j] += values[i + j];
    benchmark::DoNotOptimize(sums);
  }
  count_pixels(state);
}

void project_lat_long(benchmark::State& state) {
  std::size_t run = 0;
  for (auto _ : state) {
    const Environment& environment = environments()[run++ % environments().size()];
    benchmark::DoNotOptimize(project_image(environment, static_cast<int>(state.range(0)), 1));
  }
  count_pixels(state);
}

BENCHMARK(floor_read);
BENCHMARK(project_lat_long)->Arg(3)->Arg(5)->Arg(10)->Arg(32)->Arg(64);
BENCHMARK(floor_read)->Name("floor_read_again");

}  // namespace
}  // namespace shlight
