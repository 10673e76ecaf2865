#include "shlight/truth/path_tracer.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <numbers>
#include <optional>
#include <vector>

#include "shlight/brdf/metallic_roughness.h"
#include "shlight/core/assert.h"
#include "shlight/core/error.h"
#include "shlight/core/parallel.h"
#include "shlight/scene/tangents.h"
#include "shlight/scene/transform.h"
#include "shlight/transfer/contacts.h"
#include "shlight/transfer/hemisphere_samples.h"
#include "shlight/transfer/local_frame.h"
#include "shlight/transfer/sites.h"
#include "shlight/transfer/surfaces.h"
#include "shlight/transfer/tracer.h"
#include "shlight/transfer/world_mesh.h"
#include "shlight/truth/light_sampler.h"
#include "shlight/truth/path_samples.h"

namespace shlight {
namespace {

// Pixels of a tile, which one thread draws, and how many paths it follows at once: enough for long streams of rays.
constexpr int kTile = 16;
constexpr std::size_t kPathsAtOnce = 8192;

constexpr float kFar = std::numeric_limits<float>::infinity();

Vec3d unit(Vec3d v) {
  const double length = std::sqrt(dot(v, v));
  return length > 0 ? (1 / length) * v : Vec3d{};
}

Rgb operator*(Rgb a, Rgb b) {
  return {a.r * b.r, a.g * b.g, a.b * b.b};
}

// --- the camera

// Rays of a picture's points, in the frame of WorldMesh, whose origin is the middle of the scene.
class CameraRays {
 public:
  CameraRays(const Scene& scene, const PathTraceParams& params) : width_(params.width), height_(params.height) {
    const Extent extent = scene_extent(scene);
    const View view = make_view(params.camera, extent, static_cast<double>(params.width) / params.height);
    const auto& m = view.world_to_view;
    // The rows of the view's matrix are the camera's axes over the radius; what it adds is where it puts the middle.
    Vec3d middle;
    for (std::size_t row = 0; row < 3; ++row) {
      const Vec3d axis = {m[row], m[4 + row], m[8 + row]};
      axes_[row] = extent.radius * axis;
      const double shift = m[12 + row] + dot(axis, extent.center);
      middle = middle + shift * extent.radius * axes_[row];
    }
    eye_ = -middle;
    tan_x_ = 1 / view.view_to_clip[0];
    tan_y_ = 1 / view.view_to_clip[5];
    near_ = extent.radius * view.view_to_clip[14] / (view.view_to_clip[10] - 1);
  }

  Ray ray(double x, double y) const {
    const double right = (2 * x / width_ - 1) * tan_x_, up = (1 - 2 * y / height_) * tan_y_;
    const Vec3d way = right * axes_[0] + up * axes_[1] - axes_[2];
    const double length = std::sqrt(dot(way, way));
    Ray ray;
    ray.origin = vec_cast<float>(eye_);
    ray.direction = vec_cast<float>(1 / length * way);
    ray.near = static_cast<float>(near_ * length);
    ray.far = kFar;
    return ray;
  }

 private:
  int width_, height_;
  std::array<Vec3d, 3> axes_;  // right, up, toward the viewer
  Vec3d eye_;
  double tan_x_, tan_y_, near_;
};

// --- the light, turned

class TurnedLight {
 public:
  TurnedLight(const Light& light, const Rotation& to_world, int threads)
      : light_(light), to_world_(to_world), to_light_(inverse(to_world)), sampler_(light, threads) {}

  Rgb radiance(Vec3d direction) const { return light_.radiance(unit(to_light_(direction))); }
  double pdf(Vec3d direction) const { return sampler_.pdf(unit(to_light_(direction))); }
  LightSampler::Sample sample(PathSamples::Point point) const {
    LightSampler::Sample sample = sampler_.sample(point.x, point.y);
    sample.direction = to_world_(sample.direction);
    return sample;
  }

 private:
  const Light& light_;
  Rotation to_world_, to_light_;
  LightSampler sampler_;
};

// --- the scene

// A material that is glossy: linear in its base colour, and so known from what black and white do.
struct Gloss {
  std::unique_ptr<Brdf> black, white;

  Rgb eval(Rgb base_color, Vec3d s, Vec3d v) const {
    const Rgb of_black = black->eval(s, v);
    return of_black + base_color * (white->eval(s, v) - of_black);
  }
};

// Where a path is reflected.
struct Reflection {
  Vec3f origin;   // of the rays that leave it
  Vec3d normal;   // unit, on the side that reflects; zero where vertices' normals cancel each other
  Vec3d tangent;  // zero where nobody asks for one
  Rgb reflectance;
  Vec3d to_eye;                  // unit, back along the path
  const Gloss* gloss = nullptr;  // of the material; none: Lambertian
};

class TracedScene {
 public:
  TracedScene(const Scene& scene, const PathTraceParams& params)
      : world_(make_world_mesh(scene)),
        surfaces_(scene, world_),
        tracer_((params.make_tracer ? params.make_tracer : make_embree_tracer)(world_.positions, world_.indices)),
        sites_(make_sites(world_, params.threads)) {
    place_origins(world_, params.threads, sites_);
    if (params.brdf)
      add_tangents(scene);
    else if (params.gloss)
      add_gloss(scene);
  }

  const Tracer& tracer() const { return *tracer_; }

  // What a ray meets, if that reflects; `from_camera`: backs do, too.
  std::optional<Reflection> meet(const Hit& hit, Vec3f direction, bool from_camera) const {
    if (const auto point = surfaces_.meet(hit, direction)) return reflection(*point, direction, false);
    if (!from_camera) return {};
    // Its front is what a ray from the other side would meet.
    const auto point = surfaces_.meet(hit, -direction);
    return point ? std::optional(reflection(*point, direction, true)) : std::nullopt;
  }

 private:
  Reflection reflection(const SurfacePoint& point, Vec3f direction, bool is_back) const {
    Vec3f position, origin, normal, tangent;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t v = point.vertices[k];
      position = position + point.weights[k] * world_.positions[v];
      origin = origin + point.weights[k] * sites_.origins[sites_.of_vertex[v]];
      normal = normal + point.weights[k] * world_.normals[v];
      if (!tangents_.empty()) tangent = tangent + point.weights[k] * tangents_[v];
    }
    const Vec3f& r = point.reflectance;
    const Vec3d n = unit(vec_cast<double>(normal));
    return {is_back ? position - (origin - position) : origin,
            is_back ? -n : n,
            vec_cast<double>(tangent),
            {r.x, r.y, r.z},
            -unit(vec_cast<double>(direction)),
            gloss_at(point.vertices[0])};
  }

  void add_gloss(const Scene& scene) {
    std::vector<const Gloss*> of_material;
    for (const Material& material : scene.materials) {
      of_material.push_back(nullptr);
      if (!material.gloss) continue;
      const auto make = [&](double base) {
        return make_metallic_roughness({base, base, base}, material.gloss->metallic, material.gloss->roughness);
      };
      of_material.back() = glosses_.emplace_back(std::make_unique<Gloss>(Gloss{make(0), make(1)})).get();
    }
    if (glosses_.empty()) return;
    for (const Instance& instance : scene.instances)
      gloss_of_instance_.push_back(of_material[scene.meshes[instance.mesh].material]);
  }

  const Gloss* gloss_at(std::uint32_t vertex) const {
    if (gloss_of_instance_.empty()) return nullptr;
    const auto next = std::ranges::upper_bound(world_.first_vertex, std::size_t{vertex});
    return gloss_of_instance_[static_cast<std::size_t>(next - world_.first_vertex.begin()) - 1];
  }

  void add_tangents(const Scene& scene) {
    for (const Instance& instance : scene.instances)
      for (const Vec3f& tangent : make_tangents(scene.meshes[instance.mesh]))
        tangents_.push_back(transform_vector(instance.to_world, tangent));
  }

  WorldMesh world_;
  Surfaces surfaces_;
  std::unique_ptr<Tracer> tracer_;
  Sites sites_;
  std::vector<Vec3f> tangents_;  // of the world's vertices, of any length; empty where nobody asks for them
  std::vector<std::unique_ptr<Gloss>> glosses_;
  std::vector<const Gloss*> gloss_of_instance_;  // empty where nothing is glossy
};

// --- paths

struct Path {
  std::uint32_t pixel = 0;   // of the tile
  std::uint32_t sample = 0;  // of the replicate
  Rgb throughput = {1, 1, 1};
  Reflection at;
  // What the light that was drawn adds where nothing is in its way, and what the next ray adds where it meets nothing.
  Rgb if_light_open, if_next_open;
  bool has_light = false, has_next = false;
};

// Everything that a tile's thread needs, and uses again and again.
struct Workspace {
  std::vector<Path> paths;
  std::vector<Ray> light_rays, next_rays;
  std::vector<Hit> hits;
  std::vector<Rgb> sums;               // of the pixels, over one replicate
  std::vector<Rgb> mean, mean_square;  // over replicates
  std::uint64_t rays = 0;
};

struct Frame {
  const PathTraceParams& params;
  const TracedScene& scene;
  const TurnedLight& light;
  const CameraRays& camera;
  const PathSamples& samples;
};

struct Tile {
  int left = 0, top = 0, width = 0, height = 0;
  std::size_t size() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
};

Pixel pixel_of(const Tile& tile, std::size_t i) {
  return {tile.left + static_cast<int>(i) % tile.width, tile.top + static_cast<int>(i) / tile.width};
}

Ray make_ray(Vec3f origin, Vec3d direction) {
  Ray ray;
  ray.origin = origin;
  ray.direction = vec_cast<float>(direction);
  ray.far = kFar;
  return ray;
}

// How a surface reflects at a point: Lambert's way, f = ρ/π, by its gloss, or by a model of all surfaces.
class Reflector {
 public:
  Reflector(const Reflection& at, const Brdf* brdf)
      : at_(at),
        brdf_(brdf),
        sampled_(brdf       ? brdf
                 : at.gloss ? at.gloss->white.get()
                            : nullptr) {
    if (!sampled_) return;
    to_eye_ = to_local(at.to_eye);
    // What an interpolated normal turns away from the eye is seen from the horizon, nearly.
    constexpr double kLeastHeight = 1e-3;
    if (to_eye_.z < kLeastHeight) to_eye_ = unit({to_eye_.x, to_eye_.y, kLeastHeight});
  }

  // f cos of a direction to the light, and the density with which `sample` draws it, per steradian.
  struct Value {
    Rgb f_cos;
    double pdf = 0;
  };
  Value eval(Vec3d direction) const {
    const double cosine = dot(at_.normal, direction);
    if (!(cosine > 0)) return {};
    if (!sampled_) return {cosine / std::numbers::pi * at_.reflectance, cosine / std::numbers::pi};
    const Vec3d s = to_local(direction);
    const Rgb f = brdf_ ? brdf_->eval(s, to_eye_) : at_.gloss->eval(at_.reflectance, s, to_eye_);
    return {cosine * f, sample_brdf_pdf(*sampled_, s, to_eye_)};
  }

  // A unit direction, which may lie below the horizon.
  Vec3d sample(PathSamples::Point point, double lobe) const {
    const Vec3d s =
        sampled_ ? sample_brdf(*sampled_, to_eye_, lobe, point.x, point.y) : lift_to_hemisphere(point.x, point.y);
    return unit(s.x * frame_[0] + s.y * frame_[1] + s.z * frame_[2]);
  }

 private:
  using Axes = std::array<Vec3d, 3>;

  // Along the tangent, as far as it lies in the surface; any way where it does not.
  static Axes make_frame(const Reflection& at) {
    const Vec3d n = at.normal, x = unit(at.tangent - dot(at.tangent, n) * n);
    if (x != Vec3d{}) return {x, cross(n, x), n};
    const LocalFrame frame = make_local_frame(n, 0);
    return {frame.x, frame.y, frame.z};
  }
  Vec3d to_local(Vec3d v) const { return {dot(frame_[0], v), dot(frame_[1], v), dot(frame_[2], v)}; }

  const Reflection& at_;
  const Brdf* brdf_;     // of all surfaces
  const Brdf* sampled_;  // whose density directions have; none: the cosine's
  Axes frame_ = make_frame(at_);
  Vec3d to_eye_;
};

// Three pairs of random numbers of one reflection.
struct ReflectionSamples {
  PathSamples::Point light, surface, lobe;
};

// Draws a direction of the light and one of the surface. With their densities p and q, both together estimate ∫ f L cos
// as the sum of f L cos / (p + q) of either (the balance heuristic).
void reflect(const Frame& frame, const ReflectionSamples& samples, Path& path, Ray& light_ray, Ray& next_ray) {
  path.has_light = path.has_next = false;
  light_ray = next_ray = Ray{};
  light_ray.far = next_ray.far = -1;  // meets nothing
  if (path.at.normal == Vec3d{}) return;
  const Reflector reflector(path.at, frame.params.brdf);

  const LightSampler::Sample drawn = frame.light.sample(samples.light);
  if (const auto [f_cos, q] = reflector.eval(drawn.direction); f_cos != Rgb{}) {
    path.if_light_open = 1 / (drawn.pdf + q) * path.throughput * f_cos * frame.light.radiance(drawn.direction);
    light_ray = make_ray(path.at.origin, drawn.direction);
    path.has_light = true;
  }

  const Vec3d direction = reflector.sample(samples.surface, samples.lobe.x);
  if (const auto [f_cos, q] = reflector.eval(direction); q > 0 && f_cos != Rgb{}) {
    path.if_next_open =
        1 / (frame.light.pdf(direction) + q) * path.throughput * f_cos * frame.light.radiance(direction);
    path.throughput = 1 / q * path.throughput * f_cos;
    next_ray = make_ray(path.at.origin, direction);
    path.has_next = true;
  }
}

// Follows the paths of some samples of one replicate from the camera to their end.
void follow_paths(const Frame& frame, const Tile& tile, std::uint64_t replicate, std::size_t begin, std::size_t end,
                  Workspace& w) {
  const PathTraceParams& params = frame.params;
  const Tracer& tracer = frame.scene.tracer();
  const auto point = [&](const Path& path, std::uint64_t pair) {
    const Pixel p = pixel_of(tile, path.pixel);
    const std::uint64_t pixel =
        static_cast<std::uint64_t>(p.y) * static_cast<std::uint64_t>(params.width) + static_cast<std::uint64_t>(p.x);
    return frame.samples.at(pixel, replicate, pair, path.sample);
  };

  w.paths.clear(), w.next_rays.clear();
  for (std::size_t i = 0; i < tile.size(); ++i)
    for (std::size_t sample = begin; sample < end; ++sample) {
      Path path;
      path.pixel = static_cast<std::uint32_t>(i), path.sample = static_cast<std::uint32_t>(sample);
      const Pixel p = pixel_of(tile, i);
      const PathSamples::Point in_pixel = point(path, 0);
      w.paths.push_back(path);
      w.next_rays.push_back(frame.camera.ray(p.x + in_pixel.x, p.y + in_pixel.y));
    }

  const int bounces = params.transfer == TransferKind::kInterreflected ? params.bounces : 0;
  for (int bounce = 0; !w.paths.empty(); ++bounce) {
    // Where the paths have come to. Those that meet nothing that reflects end.
    w.hits.resize(w.paths.size());
    tracer.find_hits(w.next_rays, w.hits);
    w.rays += w.paths.size();
    std::size_t kept = 0;
    for (std::size_t j = 0; j < w.paths.size(); ++j) {
      Path& path = w.paths[j];
      const Vec3f direction = w.next_rays[j].direction;
      if (w.hits[j].triangle == Hit::kNone) {
        if (bounce > 0)
          w.sums[path.pixel] += path.if_next_open;
        else if (params.show_background)
          w.sums[path.pixel] += frame.light.radiance(unit(vec_cast<double>(direction)));
        continue;
      }
      if (bounce > bounces) continue;
      const auto at = frame.scene.meet(w.hits[j], direction, bounce == 0);
      if (!at) continue;
      path.at = *at;
      w.paths[kept++] = path;
    }
    w.paths.resize(kept);

    w.light_rays.resize(kept), w.next_rays.resize(kept);
    const auto pair = 1 + 3 * static_cast<std::uint64_t>(bounce);
    for (std::size_t j = 0; j < kept; ++j) {
      Path& path = w.paths[j];
      const ReflectionSamples drawn = {point(path, pair), point(path, pair + 1), point(path, pair + 2)};
      reflect(frame, drawn, path, w.light_rays[j], w.next_rays[j]);
    }
    if (params.transfer == TransferKind::kCosine) {
      for (const Path& path : w.paths) {
        if (path.has_light) w.sums[path.pixel] += path.if_light_open;
        if (path.has_next) w.sums[path.pixel] += path.if_next_open;
      }
      return;
    }
    tracer.find_occluded(w.light_rays);
    w.rays += kept;
    kept = 0;
    for (std::size_t j = 0; j < w.paths.size(); ++j) {
      if (w.paths[j].has_light && !(w.light_rays[j].far < 0)) w.sums[w.paths[j].pixel] += w.paths[j].if_light_open;
      if (!w.paths[j].has_next) continue;
      w.next_rays[kept] = w.next_rays[j];
      w.paths[kept++] = w.paths[j];
    }
    w.paths.resize(kept), w.next_rays.resize(kept);
  }
}

void draw_tile(const Frame& frame, const Tile& tile, Workspace& w, PathTraceResult& result) {
  const std::size_t pixels = tile.size(), samples = frame.samples.size();
  const std::size_t at_once = std::max<std::size_t>(1, kPathsAtOnce / pixels);
  std::vector<std::vector<Rgb>> means(kReplicates);
  for (int replicate = 0; replicate < kReplicates; ++replicate) {
    w.sums.assign(pixels, {});
    for (std::size_t begin = 0; begin < samples; begin += at_once)
      follow_paths(frame, tile, static_cast<std::uint64_t>(replicate), begin, std::min(samples, begin + at_once), w);
    for (Rgb& sum : w.sums) sum = 1 / static_cast<double>(samples) * sum;
    means[static_cast<std::size_t>(replicate)] = w.sums;
  }
  for (std::size_t i = 0; i < pixels; ++i) {
    Rgb mean, squares;
    for (const auto& of_replicate : means) mean += 1.0 / kReplicates * of_replicate[i];
    for (const auto& of_replicate : means) {
      const Rgb off = of_replicate[i] - mean;
      squares += off * off;
    }
    const Pixel p = pixel_of(tile, i);
    result.radiance.set_rgb(p.x, p.y, mean);
    result.variance.set_rgb(p.x, p.y, 1.0 / (kReplicates * (kReplicates - 1)) * squares);
  }
}

}  // namespace

PathTraceResult trace_paths(const Scene& scene, const Light& light, const PathTraceParams& params,
                            const Progress& progress) {
  SHLIGHT_ASSERT_LE(1, params.width);
  SHLIGHT_ASSERT_LE(1, params.height);
  SHLIGHT_ASSERT_LE(1, params.samples);
  SHLIGHT_ASSERT_LE(params.samples, kMaxPathSamples);
  SHLIGHT_ASSERT_LE(0, params.bounces);
  SHLIGHT_ASSERT_LE(params.bounces, 64);
  const auto start = std::chrono::steady_clock::now();
  report_progress(progress, 0);
  const TracedScene traced(scene, params);
  const TurnedLight turned(light, params.rotate_light, params.threads);
  const CameraRays camera(scene, params);
  const std::size_t samples = (static_cast<std::size_t>(params.samples) + kReplicates - 1) / kReplicates;
  const PathSamples path_samples(samples, params.seed, params.threads);
  const Frame frame{params, traced, turned, camera, path_samples};

  PathTraceResult result;
  result.radiance = result.variance = Image(params.width, params.height);
  result.samples = static_cast<int>(samples) * kReplicates;
  const int columns = (params.width + kTile - 1) / kTile, rows = (params.height + kTile - 1) / kTile;
  const std::size_t tiles = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  std::mutex mutex;  // of what is counted
  std::size_t done = 0;
  bool is_stopped = false;
  parallel_for(tiles, params.threads, [&](std::size_t i) {
    const int left = static_cast<int>(i) % columns * kTile, top = static_cast<int>(i) / columns * kTile;
    Workspace workspace;
    draw_tile(frame, {left, top, std::min(kTile, params.width - left), std::min(kTile, params.height - top)}, workspace,
              result);
    const std::lock_guard lock(mutex);
    result.rays += workspace.rays;
    // Who has asked to stop is not asked again by the tiles that were already begun.
    if (is_stopped) throw Cancelled();
    is_stopped = progress && !progress(static_cast<double>(++done) / static_cast<double>(tiles));
    if (is_stopped) throw Cancelled();
  });
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace shlight
