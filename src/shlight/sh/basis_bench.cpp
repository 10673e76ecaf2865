#include "shlight/sh/basis.h"

#include <algorithm>
#include <vector>

#include "shlight/sh/floor_bench.h"
#include "shlight/sh/sphere_samples.h"

namespace shlight {
namespace {

// 961 directions: what is written stays in the second-level cache up to 10 bands, and the rows do not start at
// multiples of 4 096 bytes, which would all fall into one set of the first.
constexpr int kStrata = 31;
constexpr int kDirections = kStrata * kStrata;

struct Directions {
  std::vector<float> x, y, z;
};

Directions some_directions() {
  Directions result;
  for (const Vec3d d : make_sphere_samples(0, kStrata, 1).directions) {
    result.x.push_back(static_cast<float>(d.x));
    result.y.push_back(static_cast<float>(d.y));
    result.z.push_back(static_cast<float>(d.z));
  }
  return result;
}

// The floor of both: writing as many floats as the basis has values, one after the other.
struct PlainWrite {
  std::vector<float> values;
  float value = 0;
  explicit PlainWrite(int bands) : values(static_cast<std::size_t>(kDirections * num_coefficients(bands))) {}
  void operator()() {
    std::fill(values.begin(), values.end(), value += 1);
    benchmark::DoNotOptimize(values.data());
    benchmark::ClobberMemory();
  }
};

void eval_basis_many(benchmark::State& state) {
  const int bands = static_cast<int>(state.range(0));
  const Directions d = some_directions();
  std::vector<float> values(d.x.size() * static_cast<std::size_t>(num_coefficients(bands)));
  run_against_floor(state, kDirections, PlainWrite(bands), [&] {
    eval_basis(bands, d.x, d.y, d.z, values);
    benchmark::DoNotOptimize(values.data());
    benchmark::ClobberMemory();
  });
}

void eval_basis_one_by_one(benchmark::State& state) {
  const int bands = static_cast<int>(state.range(0));
  const Directions d = some_directions();
  const auto stride = static_cast<std::size_t>(num_coefficients(bands));
  std::vector<float> values(d.x.size() * stride);
  run_against_floor(state, kDirections, PlainWrite(bands), [&] {
    for (std::size_t j = 0; j < d.x.size(); ++j)
      eval_basis(bands, Vec3f{d.x[j], d.y[j], d.z[j]}, std::span(values).subspan(j * stride, stride));
    benchmark::DoNotOptimize(values.data());
    benchmark::ClobberMemory();
  });
}

BENCHMARK(eval_basis_many)->Arg(3)->Arg(5)->Arg(10)->UseManualTime()->ArgName("bands");
BENCHMARK(eval_basis_one_by_one)->Arg(3)->Arg(5)->Arg(10)->UseManualTime()->ArgName("bands");

}  // namespace
}  // namespace shlight
