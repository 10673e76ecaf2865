// What a bake costs: against the rays alone, in closed form, with the size of scenes, in memory; and what error it
// leaves. On the Stanford bunny where SHLIGHT_TEST_DATA names the folder that has it, else on a knot of as many
// triangles. Most run on one thread and count processor time, so that whoever else uses the machine counts for little.

#include <benchmark/benchmark.h>
#include <embree3/rtcore.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <mutex>
#include <string>

#include "shlight/core/process.h"
#include "shlight/scene/load_scene.h"
#include "shlight/scene/shapes.h"
#include "shlight/sh/floor_bench.h"
#include "shlight/transfer/cosine_transfer.h"
#include "shlight/transfer/transfer.h"
#include "shlight/transfer/transfer_test_util.h"
#include "shlight/transfer/world_mesh.h"

namespace shlight {
namespace {

Scene make_knot(int along, int around) {
  TorusKnotParams params;
  params.along = along, params.around = around;
  return make_test_scene({make_torus_knot(params)});
}

struct Model {
  std::string name;
  Scene scene;
};
const Model& bench_model() {
  static const Model kModel = [] {
    const char* folder = std::getenv("SHLIGHT_TEST_DATA");
    if (folder == nullptr) return Model{"knot", make_knot(724, 48)};
    return Model{"bunny", make_scene((std::filesystem::path(folder) / "models/bun_zipper.ply").string())};
  }();
  return kModel;
}

BakeParams make_params(int samples, int threads) {
  BakeParams params;
  params.samples = samples;
  params.error = 0.0039f;
  params.threads = threads;
  return params;
}

// Of all threads together.
double processor_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

// Keeps one in `stride` of the streams of rays that a bake asks about, as they were asked.
struct Recording {
  std::size_t stride = 1;
  std::mutex mutex;
  std::size_t asked = 0;
  std::vector<std::vector<Ray>> streams;

  MakeTracer make_tracer() {
    return [this](std::span<const Vec3f> positions, std::span<const std::uint32_t> indices) {
      return std::make_unique<RecordingTracer>(*this, make_embree_tracer(positions, indices));
    };
  }

 private:
  class RecordingTracer final : public Tracer {
   public:
    RecordingTracer(Recording& recording, std::unique_ptr<Tracer> tracer)
        : recording_(recording), tracer_(std::move(tracer)) {}
    void find_occluded(std::span<Ray> rays) const override {
      {
        const std::lock_guard lock(recording_.mutex);
        if (recording_.asked++ % recording_.stride == 0) recording_.streams.emplace_back(rays.begin(), rays.end());
      }
      tracer_->find_occluded(rays);
    }
    void find_hits(std::span<const Ray> rays, std::span<Hit> hits) const override { tracer_->find_hits(rays, hits); }

   private:
    Recording& recording_;
    std::unique_ptr<Tracer> tracer_;
  };
};

// Embree as it comes, with nothing around it.
class BareEmbree {
 public:
  BareEmbree(const WorldMesh& world, RTCSceneFlags flags)
      : device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_)) {
    rtcSetSceneFlags(scene_, flags);
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(Vec3f),
                                             world.positions.size());
    std::copy(world.positions.begin(), world.positions.end(), static_cast<Vec3f*>(vertices));
    void* indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                            3 * sizeof(std::uint32_t), world.indices.size() / 3);
    std::copy(world.indices.begin(), world.indices.end(), static_cast<std::uint32_t*>(indices));
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
  }
  BareEmbree(const BareEmbree&) = delete;
  BareEmbree& operator=(const BareEmbree&) = delete;
  ~BareEmbree() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  // Seconds that it takes.
  double trace(const std::vector<std::vector<Ray>>& streams) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    double seconds = 0;
    std::vector<Ray> rays;
    for (const std::vector<Ray>& stream : streams) {
      // Embree writes to them; and in the cache, where a bake has them too.
      rays = stream;
      const double begin = processor_seconds();
      rtcOccluded1M(scene_, &context, reinterpret_cast<RTCRay*>(rays.data()), static_cast<unsigned>(rays.size()),
                    sizeof(Ray));
      seconds += processor_seconds() - begin;
    }
    return seconds;
  }

 private:
  RTCDevice device_;
  RTCScene scene_;
};

// Rays a second of a whole bake of shadowed transfer, from meshes to coefficients, and of Embree alone on the same
// rays: as robust as the bake has it, and without that flag. One run after the other, on one thread.
void bake_against_embree(benchmark::State& state) {
  const Model& model = bench_model();
  state.SetLabel(model.name);
  BakeParams params = make_params(static_cast<int>(state.range(0)), 1);
  Recording recording;
  recording.stride = 8;
  params.make_tracer = recording.make_tracer();
  bake_transfer(model.scene, params);
  params.make_tracer = {};
  std::size_t recorded = 0;
  for (const auto& stream : recording.streams) recorded += stream.size();

  const WorldMesh world = make_world_mesh(model.scene);
  const BareEmbree robust(world, RTC_SCENE_FLAG_ROBUST), fast(world, RTC_SCENE_FLAG_NONE);
  double bake_seconds = 0, robust_seconds = 0, fast_seconds = 0, rays = 0;
  for (auto _ : state) {
    robust_seconds += robust.trace(recording.streams);
    fast_seconds += fast.trace(recording.streams);
    const double begin = processor_seconds();
    const Transfer transfer = bake_transfer(model.scene, params);
    const double seconds = processor_seconds() - begin;
    state.SetIterationTime(seconds);
    bake_seconds += seconds;
    rays += static_cast<double>(transfer.rays);
  }
  const double again = static_cast<double>(recorded) * static_cast<double>(state.iterations());
  state.counters["bake_rays/s"] = rays / bake_seconds;
  state.counters["embree_rays/s"] = again / robust_seconds;
  state.counters["embree_not_robust_rays/s"] = again / fast_seconds;
  state.counters["of_embree"] = rays / bake_seconds / (again / robust_seconds);
}
BENCHMARK(bake_against_embree)
    ->Arg(512)
    ->Arg(1024)
    ->Arg(0)
    ->ArgName("samples")
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

// Closed form of a million normals, on all threads, against writing as many numbers.
void cosine_closed_form(benchmark::State& state) {
  constexpr std::size_t kNormals = 1'000'000;
  const int bands = static_cast<int>(state.range(0));
  std::vector<Vec3f> normals(kNormals);
  for (std::size_t j = 0; j < kNormals; ++j) {
    // A spiral from pole to pole.
    const double z = 1 - (2 * static_cast<double>(j) + 1) / kNormals, angle = 2.4 * static_cast<double>(j);
    const double r = std::sqrt(1 - z * z);
    normals[j] = vec_cast<float>(Vec3d{r * std::cos(angle), r * std::sin(angle), z});
  }
  std::vector<float> coefficients(kNormals * static_cast<std::size_t>(bands * bands));
  float value = 0;
  run_against_floor(
      state, kNormals,
      [&] {
        std::fill(coefficients.begin(), coefficients.end(), value += 1);
        benchmark::ClobberMemory();
      },
      [&] {
        eval_cosine_transfer(bands, normals, coefficients);
        benchmark::ClobberMemory();
      });
}
BENCHMARK(cosine_closed_form)
    ->Arg(3)
    ->Arg(5)
    ->Arg(10)
    ->ArgName("bands")
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

// A ball in the middle of a knot, whose vertices are baked; the knot, not baked, is all that rays can meet. So vertices
// and triangles can be counted up apart.
void bake_ball_in_knot(benchmark::State& state, int rings, int knot_side) {
  const Scene ball = make_test_scene({make_sphere(0.4f, rings)});
  const Scene knot = make_knot(8 * knot_side, knot_side);
  BakeParams params = make_params(256, 1);
  params.make_tracer = [&](std::span<const Vec3f>, std::span<const std::uint32_t>) {
    return make_embree_tracer(knot.meshes[0].positions, knot.meshes[0].indices);
  };
  for (auto _ : state) {
    const double begin = processor_seconds();
    benchmark::DoNotOptimize(bake_transfer(ball, params));
    state.SetIterationTime(processor_seconds() - begin);
  }
  state.counters["vertices"] = static_cast<double>(num_vertices(ball));
  state.counters["triangles"] = static_cast<double>(num_triangles(knot));
}
void bake_more_vertices(benchmark::State& state) {
  bake_ball_in_knot(state, static_cast<int>(state.range(0)), 64);
  state.SetComplexityN(state.range(0) * state.range(0));
}
void bake_more_triangles(benchmark::State& state) {
  bake_ball_in_knot(state, 96, static_cast<int>(state.range(0)));
  state.SetComplexityN(16 * state.range(0) * state.range(0));
}
BENCHMARK(bake_more_vertices)
    ->RangeMultiplier(2)
    ->Range(32, 256)
    ->ArgName("rings")
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond)
    ->Complexity();
BENCHMARK(bake_more_triangles)
    ->RangeMultiplier(2)
    ->Range(16, 256)
    ->ArgName("side")
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond)
    ->Complexity();

// A scene of a million triangles, on all threads.
void bake_a_million_triangles(benchmark::State& state) {
  const Scene scene = make_knot(2048, 245);
  BakeParams params = make_params(16, 0);
  params.kind = static_cast<TransferKind>(state.range(0));
  reset_peak_memory();
  for (auto _ : state) benchmark::DoNotOptimize(bake_transfer(scene, params));
  state.counters["peak_bytes"] = static_cast<double>(peak_memory());
  state.counters["triangles"] = static_cast<double>(num_triangles(scene));
}
BENCHMARK(bake_a_million_triangles)
    ->Arg(static_cast<int>(TransferKind::kCosine))
    ->Arg(static_cast<int>(TransferKind::kShadowed))
    ->Arg(static_cast<int>(TransferKind::kInterreflected))
    ->ArgName("kind")
    ->UseRealTime()
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

// The error of shadowed transfer over all coefficients, relative to their own root mean square, against a bake with the
// most samples and another seed. That reference takes minutes.
void shadowed_error(benchmark::State& state) {
  const Model& model = bench_model();
  state.SetLabel(model.name);
  static const Transfer kReference = [&] {
    BakeParams params = make_params(kMaxTransferSamples, 0);
    params.seed = 99;
    return bake_transfer(model.scene, params);
  }();
  Transfer transfer;
  for (auto _ : state) transfer = bake_transfer(model.scene, make_params(static_cast<int>(state.range(0)), 0));
  state.counters["error"] = relative_difference(transfer, kReference);
  state.counters["estimated"] = transfer.estimated_error;
  state.counters["rays/vertex"] = static_cast<double>(transfer.rays) / static_cast<double>(transfer.num_vertices());
}
BENCHMARK(shadowed_error)
    ->Arg(512)
    ->Arg(1024)
    ->Arg(2048)
    ->Arg(4096)
    ->Arg(0)
    ->ArgName("samples")
    ->UseRealTime()
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

// The thesis's three models, where SHLIGHT_TEST_DATA names the folder that has them, baked to 3 bands: by its method
// with as many samples as it took, and by ours. `error` is over all coefficients, relative to their own root mean
// square: against the closed form, and of shadowed transfer against many more samples with another seed.
constexpr std::array kThesisModels = {"dx_cube_on_plane.x", "dx_Head_Sad.x", "dx_skullocc.x"};
struct ThesisBake {
  const char* name;
  TransferKind kind;
  TransferMethod method;
  int samples;
};
constexpr std::array kThesisBakes = {
    ThesisBake{"cosine, monte-carlo", TransferKind::kCosine, TransferMethod::kMonteCarlo, 10'000},
    ThesisBake{"cosine, closed form", TransferKind::kCosine, TransferMethod::kBest, 0},
    ThesisBake{"shadowed, monte-carlo", TransferKind::kShadowed, TransferMethod::kMonteCarlo, 10'000},
    ThesisBake{"shadowed, auto", TransferKind::kShadowed, TransferMethod::kBest, 0},
    ThesisBake{"interreflected, auto", TransferKind::kInterreflected, TransferMethod::kBest, 0}};

void bake_thesis_model(benchmark::State& state) {
  const char* folder = std::getenv("SHLIGHT_TEST_DATA");
  const std::string model = kThesisModels[static_cast<std::size_t>(state.range(0))];
  const ThesisBake& bake = kThesisBakes[static_cast<std::size_t>(state.range(1))];
  state.SetLabel(model + ", " + bake.name);
  if (folder == nullptr) return state.SkipWithError("SHLIGHT_TEST_DATA names no folder");
  const Scene scene = make_scene((std::filesystem::path(folder) / "models" / model).string());
  BakeParams params;
  params.kind = bake.kind, params.method = bake.method, params.samples = bake.samples, params.bands = 3;
  Transfer transfer;
  double seconds = 0;
  for (auto _ : state) {
    const double begin = processor_seconds();
    transfer = bake_transfer(scene, params);
    seconds += processor_seconds() - begin;
  }
  state.counters["vertices"] = static_cast<double>(transfer.num_vertices());
  state.counters["processor_s"] = seconds / static_cast<double>(state.iterations());
  state.counters["rays"] = static_cast<double>(transfer.rays);
  state.counters["estimated"] = transfer.estimated_error;
  if (bake.kind == TransferKind::kInterreflected) return;
  params.method = TransferMethod::kBest, params.seed = 99;
  params.samples = bake.kind == TransferKind::kCosine ? 0 : 8192;
  state.counters["error"] = relative_difference(transfer, bake_transfer(scene, params));
}
BENCHMARK(bake_thesis_model)
    ->ArgsProduct({benchmark::CreateDenseRange(0, kThesisModels.size() - 1, 1),
                   benchmark::CreateDenseRange(0, kThesisBakes.size() - 1, 1)})
    ->ArgNames({"model", "bake"})
    ->UseRealTime()
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace shlight
