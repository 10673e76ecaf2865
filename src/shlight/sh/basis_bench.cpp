#include "shlight/sh/basis.h"

#include <benchmark/benchmark.h>

#include <vector>

#include "shlight/sh/sphere_samples.h"

namespace shlight {
namespace {

struct Directions {
  std::vector<float> x, y, z;
};

Directions some_directions(int strata) {
  Directions result;
  for (const Vec3d d : make_sphere_samples(0, strata, 1).directions) {
    result.x.push_back(static_cast<float>(d.x));
    result.y.push_back(static_cast<float>(d.y));
    result.z.push_back(static_cast<float>(d.z));
  }
  return result;
}

// 961 directions: what is written stays in the second-level cache up to 10 bands, and the rows do not start at
// multiples of 4 096 bytes, which would all fall into one set of the first.
constexpr int kStrata = 31;

// Seconds a direction.
void count_directions(benchmark::State& state) {
  state.counters["s/direction"] = benchmark::Counter(
      kStrata * kStrata, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

// The floor: writing as many floats as the basis has values.
void floor_write(benchmark::State& state) {
  std::vector<float> values(static_cast<std::size_t>(kStrata * kStrata * num_coefficients(int(state.range(0)))));
  float v = 0;
  for (auto _ : state) {
    v += 1;
    for (float& value : values) value = v;
    benchmark::DoNotOptimize(values.data());
    benchmark::ClobberMemory();
  }
  count_directions(state);
}

void eval_basis_many(benchmark::State& state) {
  const int bands = static_cast<int>(state.range(0));
  const Directions d = some_directions(kStrata);
  std::vector<float> values(d.x.size() * num_coefficients(bands));
  for (auto _ : state) {
    eval_basis(bands, d.x, d.y, d.z, values);
    benchmark::DoNotOptimize(values.data());
    benchmark::ClobberMemory();
  }
  count_directions(state);
}

void eval_basis_one(benchmark::State& state) {
  const int bands = static_cast<int>(state.range(0));
  const Directions d = some_directions(kStrata);
  std::vector<float> values(static_cast<std::size_t>(num_coefficients(bands)));
  for (auto _ : state)
    for (std::size_t j = 0; j < d.x.size(); ++j) {
      eval_basis(bands, Vec3f{d.x[j], d.y[j], d.z[j]}, std::span<float>(values));
      benchmark::DoNotOptimize(values.data());
      benchmark::ClobberMemory();
    }
  count_directions(state);
}

BENCHMARK(floor_write)->Arg(3)->Arg(5)->Arg(10);
BENCHMARK(eval_basis_many)->Arg(3)->Arg(5)->Arg(10);
BENCHMARK(eval_basis_one)->Arg(3)->Arg(5)->Arg(10);

}  // namespace
}  // namespace shlight
