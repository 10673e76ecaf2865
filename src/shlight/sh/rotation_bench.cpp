#include "shlight/sh/rotation.h"

#include <vector>

#include "shlight/sh/floor_bench.h"

namespace shlight {
namespace {

// Read and written stay in the second-level cache at 5 bands.
constexpr std::size_t kVectors = 960;

// Many vectors of one channel, against a plain copy of them.
void rotate_many(benchmark::State& state) {
  const int bands = static_cast<int>(state.range(0));
  const RotationMatrix matrix(bands, rotation_zyz(0.3, 1.1, -0.7));
  std::vector<float> values(kVectors * static_cast<std::size_t>(num_coefficients(bands)), 0.5f), result(values.size());
  run_against_floor(
      state, kVectors,
      [&] {
        std::copy(values.begin(), values.end(), result.begin());
        benchmark::DoNotOptimize(result.data());
        benchmark::ClobberMemory();
      },
      [&] {
        rotate(matrix, values, result, kVectors);
        benchmark::DoNotOptimize(result.data());
        benchmark::ClobberMemory();
      });
}

void make_rotation_matrix(benchmark::State& state) {
  for (auto _ : state)
    benchmark::DoNotOptimize(RotationMatrix(static_cast<int>(state.range(0)), rotation_zyz(0.3, 1.1, -0.7)));
}

BENCHMARK(rotate_many)->Arg(3)->Arg(5)->Arg(10)->UseManualTime()->ArgName("bands");
BENCHMARK(make_rotation_matrix)->Arg(3)->Arg(5)->Arg(10)->Arg(64)->ArgName("bands");

}  // namespace
}  // namespace shlight
