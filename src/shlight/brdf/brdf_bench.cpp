#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <string>

#include "shlight/brdf/make_brdf.h"
#include "shlight/brdf/project_brdf.h"
#include "shlight/brdf/reflectance_table.h"

namespace shlight {
namespace {

// A table of 5 bands with default sizes, on all threads.
void make_table(benchmark::State& state, const std::string& material) {
  const auto brdf = make_brdf(material);
  for (auto _ : state) benchmark::DoNotOptimize(make_reflectance_table(*brdf));
}

// One view to a relative 1e-6, one thread.
void project_view(benchmark::State& state, const std::string& material) {
  const auto brdf = make_brdf(material);
  for (auto _ : state) benchmark::DoNotOptimize(project_brdf(*brdf, {0.8, 0, 0.6}, 5));
}

// The thesis's table 3: 1024 vertices, 5 bands, 10 000 samples, each with its own frame, one thread.
void thesis_table(benchmark::State& state, const std::string& material) {
  const auto brdf = make_brdf(material);
  const SphereSamples samples = make_sphere_samples(5, 100, 1);
  for (auto _ : state)
    for (int vertex = 0; vertex < 1024; ++vertex) {
      const double phi = 0.37 * vertex, z = (vertex + 0.5) / 512 - 1, s = std::sqrt(1 - z * z);
      const Vec3d normal = {s * std::cos(phi), s * std::sin(phi), z}, tangent = {-std::sin(phi), std::cos(phi), 0};
      // An eye 60° from each normal: cos 60° of it and sin 60° of the tangent.
      const Vec3d view = 0.5 * normal + std::sqrt(0.75) * tangent;
      benchmark::DoNotOptimize(project_brdf_monte_carlo(*brdf, normal, tangent, view, samples));
    }
}

const bool kRegistered = [] {
  for (const std::string material :
       {"lambert", "oren-nayar", "oren-nayar-full", "ward:sigma=0.2", "ward:sigma=0.05", "cook-torrance:m=0.05",
        "cook-torrance:m=0.3", "cook-torrance:m=1", "ggx:alpha=0.05", "ggx:alpha=0.3", "ggx:alpha=0.3,f0=0.9/0.5/0.1",
        "blinn-phong", "metallic-roughness", "ward-aniso", "ggx-aniso"})
    benchmark::RegisterBenchmark(("make_table/" + material).c_str(), make_table, material)
        ->UseRealTime()
        ->Unit(benchmark::kMillisecond);
  for (const std::string material : {"oren-nayar", "ward:sigma=0.2", "cook-torrance:m=0.3", "ggx:alpha=0.3"})
    benchmark::RegisterBenchmark(("project_view/" + material).c_str(), project_view, material)
        ->Unit(benchmark::kMicrosecond);
  for (const std::string material :
       {"cook-torrance:m=0.5,f0=0.9", "oren-nayar:sigma=0.3", "ward-aniso:sx=0.15,sy=0.5", "ward:sigma=0.15"})
    benchmark::RegisterBenchmark(("thesis_table/" + material).c_str(), thesis_table, material)
        ->Unit(benchmark::kMillisecond);
  return true;
}();

}  // namespace
}  // namespace shlight
