#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>

#include "shlight/core/error.h"
#include "shlight/core/parallel.h"
#include "shlight/sh/coefficients.h"
#include "shlight/transfer/ambient_occlusion.h"
#include "shlight/transfer/bake_state.h"
#include "shlight/transfer/bounce.h"
#include "shlight/transfer/choose_density.h"
#include "shlight/transfer/cosine_transfer.h"
#include "shlight/transfer/pilot.h"
#include "shlight/transfer/shadowed_monte_carlo.h"
#include "shlight/transfer/sites.h"
#include "shlight/transfer/trace_occlusion.h"
#include "shlight/transfer/transfer.h"
#include "shlight/transfer/world_mesh.h"

namespace shlight {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

void check_range(std::string_view what, double value, double least, double most) {
  if (!(value >= least && value <= most))
    throw Error(what, fmt::format("{}", value), fmt::format("from {} to {}", least, most));
}

void check_params(const BakeParams& params) {
  check_range("bands", params.bands, 1, kMaxTransferBands);
  check_range("samples", params.samples, 0, kMaxTransferSamples);
  check_range("bounces", params.bounces, 0, 64);
  check_range("threads", params.threads, 0, 1 << 16);
  if (params.samples == 0) check_range("error", double{params.error}, 1e-5, 1);
  if (params.method == TransferMethod::kMonteCarlo) {
    if (params.samples == 0) throw Error("samples", "automatic with Monte Carlo", "a number");
    if (params.kind == TransferKind::kInterreflected)
      throw Error("transfer", "interreflected by Monte Carlo", "cosine or shadowed");
  }
}

// Workspaces that batches borrow: as many as work at the same time.
template <class Workspace>
class Pool {
 public:
  template <class F>
  auto lend(const F& f) {
    std::unique_ptr<Workspace> workspace;
    {
      const std::lock_guard lock(mutex_);
      if (!free_.empty()) workspace = std::move(free_.back()), free_.pop_back();
    }
    if (!workspace) workspace = std::make_unique<Workspace>();
    const auto result = f(*workspace);
    const std::lock_guard lock(mutex_);
    free_.push_back(std::move(workspace));
    return result;
  }

 private:
  std::mutex mutex_;
  std::vector<std::unique_ptr<Workspace>> free_;
};

// One bake, from the scene to the transfer of its sites.
class Baker {
 public:
  Baker(const Scene& scene, const BakeParams& params, const BakeWatcher& watcher)
      : scene_(scene),
        params_(params),
        watcher_(watcher),
        world_(make_world_mesh(scene)),
        sites_(make_sites(world_, params.threads)) {
    tell(0);
    tracer_ = params.make_tracer ? params.make_tracer(world_.positions, world_.indices)
                                 : make_embree_tracer(world_.positions, world_.indices);
    start();
  }

  Transfer bake() {
    while (state_.pass < num_passes()) {
      if (state_.pass == 0) {
        run_pass([&](std::size_t b) { return shade(b); });
        estimate_error();
        if (bounces()) start_bounces();
      } else {
        run_bounce();
      }
      ++state_.pass;
      state_.batches_done = 0;
    }
    if (!params_.checkpoint.empty()) save_checkpoint(params_.checkpoint, state_);
    Transfer transfer = collect();
    transfer.seconds = tell(1);
    return transfer;
  }

 private:
  bool bounces() const { return params_.kind == TransferKind::kInterreflected; }
  bool is_monte_carlo() const { return params_.method == TransferMethod::kMonteCarlo; }
  std::uint64_t num_passes() const { return 1 + (bounces() ? static_cast<std::uint64_t>(params_.bounces) : 0); }
  // Bent normals take two bands.
  int bands() const { return std::max(2, params_.bands); }
  std::size_t num_values() const { return static_cast<std::size_t>(num_coefficients(bands())); }
  std::size_t batch_begin(std::size_t batch) const { return std::min(batch * batch_size_, sites_.size()); }
  std::size_t num_batches() const { return (sites_.size() + batch_size_ - 1) / batch_size_; }

  // Makes the state, or reads it where there is a checkpoint, and the samples.
  void start() {
    const bool has_checkpoint = !params_.checkpoint.empty() && std::filesystem::exists(params_.checkpoint);
    state_.hash = hash_bake(scene_, params_);
    if (params_.samples == 0 && !has_checkpoint) {
      const DensityChoice choice =
          choose_density(*tracer_, sites_, bands(), double{params_.error}, params_.seed, params_.threads);
      state_.density = choice.density;
      state_.rays = rays_here_ = choice.rays;
    }
    batch_size_ = params_.samples == 0 ? kAdaptiveBatch : fixed_batch_size(static_cast<std::size_t>(params_.samples));
    state_.packed.resize(num_batches());
    state_.direct.resize(num_values() * sites_.size());
    if (bounces()) {
      for (std::vector<float>* values : {&state_.total, &state_.previous, &state_.next})
        values->resize(3 * num_values() * sites_.size());
      surfaces_ = std::make_unique<Surfaces>(scene_, world_);
    }
    if (has_checkpoint) state_ = load_checkpoint(params_.checkpoint, state_);

    const std::size_t samples = static_cast<std::size_t>(params_.samples);
    if (is_monte_carlo())
      sphere_samples_ = make_sphere_samples(bands(), strata_for(params_.samples), params_.seed);
    else if (params_.samples == 0)
      plan_ = make_adaptive_plan(bands(), state_.density, params_.seed, params_.threads);
    else
      plan_ = make_fixed_plan(bands(), samples, params_.seed, params_.threads);
    fraction_at_start_ = fraction_done();
    last_checkpoint_ = Clock::now();
  }

  // Shadowed transfer of one batch; the number of rays.
  std::size_t shade(std::size_t batch) {
    const std::size_t begin = batch_begin(batch), end = batch_begin(batch + 1), n = num_values();
    const std::span<float> direct = std::span(state_.direct).subspan(n * begin, n * (end - begin));
    if (is_monte_carlo()) return sample_shadowed_transfer(*tracer_, sites_, begin, end, sphere_samples_, direct);
    eval_cosine_transfer(bands(), std::span(sites_.normals).subspan(begin, end - begin), direct, 1);
    return occlusion_workspaces_.lend([&](OcclusionWorkspace& w) {
      trace_occlusion(*tracer_, sites_, begin, end, plan_, params_.seed, w);
      std::vector<double> missing(n);
      std::size_t rays = 0;
      for (std::size_t k = 0; k < end - begin; ++k) {
        rays += num_rays(plan_, w.occlusion[k]);
        if (sum_occluded(plan_, w.site_samples[k], w.occlusion[k], missing))
          rotation_.to_world(w.site_samples[k].frame, missing);
        for (std::size_t i = 0; i < n; ++i) {
          float& value = direct[n * k + i];
          value = static_cast<float>(double{value} - missing[i]);
        }
        if (bounces()) pack_occlusion(plan_, w.occlusion[k], state_.packed[batch]);
      }
      state_.packed[batch].shrink_to_fit();
      return rays;
    });
  }

  // Some sites once more, with other samples.
  void estimate_error() {
    constexpr std::size_t kPilotSites = 1024;
    const std::vector<SiteRange> groups = pilot_groups(sites_, kPilotSites);
    const std::size_t n = num_values();
    std::vector<double> baked;
    for (const auto& [begin, end] : groups) {
      const auto values = std::span(state_.direct).subspan(n * begin, n * (end - begin));
      baked.insert(baked.end(), values.begin(), values.end());
    }
    PilotTransfer pilot;
    if (is_monte_carlo()) {
      const SphereSamples others = make_sphere_samples(bands(), strata_for(params_.samples), ~params_.seed);
      std::vector<std::vector<float>> values(groups.size());
      std::vector<std::size_t> rays(groups.size());
      parallel_for(groups.size(), params_.threads, [&](std::size_t g) {
        values[g].resize(n * (groups[g].end - groups[g].begin));
        rays[g] = sample_shadowed_transfer(*tracer_, sites_, groups[g].begin, groups[g].end, others, values[g]);
      });
      for (std::size_t g = 0; g < groups.size(); ++g) {
        pilot.shadowed.insert(pilot.shadowed.end(), values[g].begin(), values[g].end());
        pilot.rays += rays[g];
      }
    } else {
      pilot = trace_pilot(*tracer_, sites_, groups, plan_, ~params_.seed, params_.threads);
    }
    state_.estimated_error = error_of_independent(baked, pilot.shadowed);
    state_.rays += pilot.rays, rays_here_ += pilot.rays;
  }

  // Before light meets a surface it has no colour.
  void start_bounces() {
    const std::size_t n = num_values();
    for (std::size_t site = 0; site < sites_.size(); ++site)
      for (std::size_t c = 0; c < 3; ++c)
        std::copy_n(state_.direct.begin() + static_cast<std::ptrdiff_t>(n * site), n,
                    state_.previous.begin() + static_cast<std::ptrdiff_t>(n * (3 * site + c)));
    state_.total = state_.previous;
  }

  void run_bounce() {
    const std::size_t n = num_values();
    const BounceSource source = {*tracer_, sites_, *surfaces_, plan_, params_.seed, state_.previous};
    run_pass([&](std::size_t batch) {
      const std::size_t begin = batch_begin(batch), end = batch_begin(batch + 1);
      return bounce_workspaces_.lend([&](BounceWorkspace& w) {
        return gather_bounce(source, begin, end, state_.packed[batch],
                             std::span(state_.next).subspan(3 * n * begin, 3 * n * (end - begin)), w);
      });
    });
    for (std::size_t i = 0; i < state_.total.size(); ++i) state_.total[i] += state_.next[i];
    std::swap(state_.previous, state_.next);
  }

  // Works through the batches of a pass that are not done yet, some at a time; in between, nothing is in work: then the
  // watcher is told and the state may be saved.
  void run_pass(const std::function<std::size_t(std::size_t)>& work) {
    const std::size_t threads = params_.threads > 0 ? static_cast<std::size_t>(params_.threads)
                                                    : std::max(1u, std::thread::hardware_concurrency());
    // About a quarter of a second.
    constexpr std::size_t kRaysAtATime = 1 << 21;
    const std::size_t rays_of_batch =
        batch_size_ * (params_.samples > 0 ? static_cast<std::size_t>(params_.samples)
                                           : kCells * static_cast<std::size_t>(state_.density));
    const std::size_t at_a_time = threads * std::max(std::size_t{1}, kRaysAtATime / (1 + rays_of_batch));
    while (state_.batches_done < num_batches()) {
      const std::size_t first = state_.batches_done, count = std::min(at_a_time, num_batches() - first);
      std::vector<std::size_t> rays(count);
      parallel_for(count, params_.threads, [&](std::size_t k) { rays[k] = work(first + k); });
      for (const std::size_t r : rays) state_.rays += r, rays_here_ += r;
      state_.batches_done += count;
      if (!params_.checkpoint.empty() && seconds_since(last_checkpoint_) >= params_.checkpoint_seconds) {
        save_checkpoint(params_.checkpoint, state_);
        last_checkpoint_ = Clock::now();
      }
      try {
        tell(fraction_done());
      } catch (const Cancelled&) {
        if (!params_.checkpoint.empty()) save_checkpoint(params_.checkpoint, state_);
        throw;
      }
    }
  }

  // A bounce has only the rays that were found occluded, but each costs more.
  double fraction_done() const {
    constexpr double kBounce = 0.6;
    const auto work_before = [&](double pass) { return pass <= 1 ? pass : 1 + kBounce * (pass - 1); };
    const double batches = static_cast<double>(std::max(std::size_t{1}, num_batches()));
    const double pass = static_cast<double>(state_.pass);
    const double share = static_cast<double>(state_.batches_done) / batches;
    const double done = work_before(pass) + share * (work_before(pass + 1) - work_before(pass));
    return std::min(1.0, done / work_before(static_cast<double>(num_passes())));
  }

  // Returns the seconds that it told.
  double tell(double fraction) const {
    BakeStatus status;
    status.fraction_done = fraction;
    status.seconds = seconds_since(begin_);
    status.rays = rays_here_;
    if (rays_here_ > 0 && status.seconds > 0) status.rays_per_second = static_cast<double>(rays_here_) / status.seconds;
    if (fraction > fraction_at_start_)
      status.seconds_left = status.seconds * (1 - fraction) / (fraction - fraction_at_start_);
    if (watcher_ && !watcher_(status)) throw Cancelled();
    return status.seconds;
  }

  // From sites to vertices.
  Transfer collect() const {
    Transfer transfer;
    transfer.kind = params_.kind;
    transfer.bands = params_.bands;
    transfer.channels = bounces() ? 3 : 1;
    transfer.first_vertex = world_.first_vertex;
    transfer.hash = state_.hash;
    transfer.rays = state_.rays;
    transfer.estimated_error = state_.estimated_error;
    const std::size_t vertices = sites_.of_vertex.size(), n = num_values(),
                      channels = static_cast<std::size_t>(transfer.channels);
    const std::size_t kept = static_cast<std::size_t>(num_coefficients(params_.bands));
    const std::vector<float>& values = bounces() ? state_.total : state_.direct;
    transfer.coefficients.resize(vertices * channels * kept);
    transfer.ambient_occlusion.resize(vertices);
    transfer.bent_normals.resize(vertices);
    parallel_for((vertices + 4095) / 4096, params_.threads, [&](std::size_t block) {
      for (std::size_t v = 4096 * block; v < std::min(vertices, 4096 * (block + 1)); ++v) {
        const std::size_t site = sites_.of_vertex[v];
        for (std::size_t c = 0; c < channels; ++c)
          std::copy_n(values.data() + n * (channels * site + c), kept,
                      transfer.coefficients.data() + kept * (channels * v + c));
        const std::span<const float> direct = std::span(state_.direct).subspan(n * site, n);
        transfer.ambient_occlusion[v] = eval_ambient_occlusion(direct);
        transfer.bent_normals[v] = eval_bent_normal(direct, world_.normals[v]);
      }
    });
    return transfer;
  }

  const Clock::time_point begin_ = Clock::now();
  const Scene& scene_;
  const BakeParams& params_;
  const BakeWatcher& watcher_;
  const WorldMesh world_;
  const Sites sites_;
  const FrameRotation rotation_{bands()};
  std::unique_ptr<Tracer> tracer_;
  std::unique_ptr<Surfaces> surfaces_;
  SphereSamples sphere_samples_;
  SamplePlan plan_;
  std::size_t batch_size_ = 1;
  BakeState state_;
  std::uint64_t rays_here_ = 0;
  double fraction_at_start_ = 0;
  Clock::time_point last_checkpoint_;
  Pool<OcclusionWorkspace> occlusion_workspaces_;
  Pool<BounceWorkspace> bounce_workspaces_;
};

// No vertex looks at another: no sites, no rays.
Transfer bake_cosine(const Scene& scene, const BakeParams& params, const BakeWatcher& watcher) {
  const Clock::time_point begin = Clock::now();
  WorldMesh world = make_world_mesh(scene);
  Transfer transfer;
  transfer.bands = params.bands;
  transfer.hash = hash_bake(scene, params);
  transfer.first_vertex = world.first_vertex;
  const std::size_t vertices = world.positions.size();
  transfer.coefficients.resize(vertices * static_cast<std::size_t>(num_coefficients(params.bands)));
  if (params.method == TransferMethod::kMonteCarlo)
    sample_cosine_transfer(params.bands, world.normals, params.samples, params.seed, transfer.coefficients,
                           params.threads);
  else
    eval_cosine_transfer(params.bands, world.normals, transfer.coefficients, params.threads);
  transfer.ambient_occlusion.assign(vertices, 1);
  transfer.bent_normals = std::move(world.normals);
  transfer.seconds = seconds_since(begin);
  BakeStatus status;
  status.fraction_done = 1;
  status.seconds = transfer.seconds;
  status.seconds_left = 0;
  if (watcher && !watcher(status)) throw Cancelled();
  return transfer;
}

}  // namespace

Transfer bake_transfer(const Scene& scene, const BakeParams& params, const BakeWatcher& watcher) {
  check_params(params);
  if (params.kind == TransferKind::kCosine) return bake_cosine(scene, params, watcher);
  return Baker(scene, params, watcher).bake();
}

}  // namespace shlight
