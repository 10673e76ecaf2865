#pragma once

#include <benchmark/benchmark.h>

#include <chrono>

namespace shlight {

// For benchmarks: runs `floor`, the least that the machine must do for the task, and `work` in turn, so that a machine
// whose speed drifts slows both, and reports nanoseconds an item of each and their ratio. The benchmark needs
// UseManualTime(); its own time is the work's.
template <class Floor, class Work>
void run_against_floor(benchmark::State& state, double items, Floor&& floor, Work&& work) {
  using Clock = std::chrono::steady_clock;
  double floor_seconds = 0, work_seconds = 0;
  for (auto _ : state) {
    const auto begin = Clock::now();
    floor();
    const auto middle = Clock::now();
    work();
    const auto end = Clock::now();
    floor_seconds += std::chrono::duration<double>(middle - begin).count();
    const double seconds = std::chrono::duration<double>(end - middle).count();
    work_seconds += seconds;
    state.SetIterationTime(seconds);
  }
  const double runs = items * static_cast<double>(state.iterations());
  state.counters["ns/item"] = 1e9 * work_seconds / runs;
  state.counters["floor_ns/item"] = 1e9 * floor_seconds / runs;
  state.counters["times_floor"] = work_seconds / floor_seconds;
}

}  // namespace shlight
