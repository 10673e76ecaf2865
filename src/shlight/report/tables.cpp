#include "shlight/report/tables.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

#include "shlight/brdf/project_brdf.h"
#include "shlight/brdf/reflectance_table.h"
#include "shlight/core/parallel.h"
#include "shlight/core/quantile.h"
#include "shlight/light/project_image.h"
#include "shlight/scene/shapes.h"
#include "shlight/sh/basis.h"
#include "shlight/sh/zonal.h"
#include "shlight/transfer/cosine_transfer.h"
#include "shlight/transfer/local_frame.h"
#include "shlight/transfer/transfer.h"

namespace shlight {
namespace {

constexpr int kRuns = 5;
constexpr int kLightBands = 3, kBrdfBands = 5;

double time_once(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// The median of `runs` runs.
double time_of(int runs, const std::function<void(int run)>& work) {
  std::vector<double> seconds;
  for (int run = 0; run < runs; ++run) seconds.push_back(time_once([&] { work(run); }));
  return median(std::move(seconds));
}

double largest_channel(Rgb c) {
  return std::max({std::abs(c.r), std::abs(c.g), std::abs(c.b)});
}

double largest_error(const RgbCoefficients& test, const RgbCoefficients& truth) {
  double difference = 0, largest = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    difference = std::max(difference, largest_channel(test[i] - truth[i]));
    largest = std::max(largest, largest_channel(truth[i]));
  }
  return largest > 0 ? difference / largest : 0;
}

// Root mean square of differences, relative to that of what is true.
struct RelativeError {
  double difference = 0, square = 0;
  void add(double test, double truth) {
    difference += (test - truth) * (test - truth);
    square += truth * truth;
  }
  double value() const { return square > 0 ? std::sqrt(difference / square) : 0; }
};

MethodCost measure_exact(const Environment& environment) {
  MethodCost cost;
  RgbCoefficients result;
  cost.seconds = time_of(kRuns, [&](int) { result = project_image(environment, kLightBands); });
  cost.error = largest_error(result, project_image_by_pixels(environment, kLightBands));
  return cost;
}

double transfer_error(std::span<const Vec3f> normals, std::span<const float> coefficients) {
  constexpr std::size_t n = num_coefficients(kLightBands);
  RelativeError error;
  std::array<double, n> basis;
  for (std::size_t v = 0; v < normals.size(); ++v) {
    eval_basis_recursive<double>(kLightBands, vec_cast<double>(normals[v]), basis);
    for (int l = 0; l < kLightBands; ++l)
      for (int m = -l; m <= l; ++m) {
        const auto i = static_cast<std::size_t>(coefficient_index(l, m));
        error.add(double{coefficients[v * n + i]}, cosine_lobe_hat(l) / std::numbers::pi * basis[i]);
      }
  }
  return error.value();
}

// One vertex of table 3: its frame and the eye's direction in it.
struct Seen {
  LocalFrame frame;
  Vec3d view;
};

std::vector<Seen> make_seen() {
  const Scene scene = make_table_knot(64, 16);
  const Mesh& mesh = scene.meshes[0];
  constexpr Vec3d kEye = {1, 1, 3};
  // Nothing is seen from the horizon itself.
  constexpr double kLeastCosine = 0.02;
  std::vector<Seen> all;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    Seen seen = {make_local_frame(vec_cast<double>(mesh.normals[i]), 0), {}};
    const Vec3d d = kEye - vec_cast<double>(mesh.positions[i]);
    Vec3d v = (1 / std::sqrt(dot(d, d))) * Vec3d{dot(d, seen.frame.x), dot(d, seen.frame.y), dot(d, seen.frame.z)};
    v.z = std::max(std::abs(v.z), kLeastCosine);
    seen.view = (1 / std::sqrt(dot(v, v))) * v;
    all.push_back(seen);
  }
  return all;
}

RgbCoefficients to_world(const FrameRotation& rotation, const LocalFrame& frame, const RgbCoefficients& local) {
  RgbCoefficients result(local.bands());
  std::vector<double> channel(local.size());
  for (double Rgb::*c : {&Rgb::r, &Rgb::g, &Rgb::b}) {
    for (std::size_t i = 0; i < local.size(); ++i) channel[i] = local[i].*c;
    rotation.to_world(frame, channel);
    for (std::size_t i = 0; i < local.size(); ++i) result[i].*c = channel[i];
  }
  return result;
}

// F* of every vertex, from the table, in the world's frame.
std::vector<RgbCoefficients> look_up(const ReflectanceTable& table, const std::vector<Seen>& seen) {
  const FrameRotation rotation(table.bands);
  std::vector<RgbCoefficients> result(seen.size());
  parallel_for(seen.size(), 0, [&](std::size_t i) {
    result[i] = to_world(rotation, seen[i].frame, eval_reflectance_table(table, seen[i].view));
  });
  return result;
}

}  // namespace

Scene make_table_knot(int along, int around) {
  Scene scene;
  scene.materials.push_back({"white", {0.8f, 0.8f, 0.8f}, {}, {}});
  TorusKnotParams params;
  params.along = along, params.around = around;
  Mesh mesh = make_torus_knot(params);
  for (Vec3f& p : mesh.positions) p = 1 / (params.major + params.minor + params.tube) * p;
  scene.instances.push_back({0, kIdentity});
  scene.meshes.push_back(std::move(mesh));
  return scene;
}

LightRow measure_light_row(const Light& light, int size, int samples) {
  LightRow row;
  row.size = size;
  const Environment map = {light.picture({Layout::kAngularMap, size}), Layout::kAngularMap};
  const RgbCoefficients truth = project_image_by_pixels(map, kLightBands);
  std::vector<SphereSamples> made;
  for (int run = 0; run < kRuns; ++run)
    made.push_back(make_sphere_samples(kLightBands, strata_for(samples), static_cast<std::uint64_t>(run) + 1));
  std::vector<RgbCoefficients> classic(kRuns);
  row.classic.seconds = time_of(kRuns, [&](int run) {
    classic[run] = project_monte_carlo([&](Vec3d d) { return eval_nearest(map, d); }, made[run]).coefficients;
  });
  for (const RgbCoefficients& c : classic) row.classic.error += std::pow(largest_error(c, truth), 2) / kRuns;
  row.classic.error = std::sqrt(row.classic.error);
  row.exact = measure_exact(map);
  // A map of twice as many columns as rows.
  const int width = 2 * static_cast<int>(std::lround(size / std::numbers::sqrt2));
  row.lat_long = measure_lat_long(light, width);
  return row;
}

MethodCost measure_lat_long(const Light& light, int width) {
  return measure_exact({light.picture({Layout::kLatLong, width}), Layout::kLatLong});
}

TransferRow measure_transfer_row(const Scene& scene, int samples) {
  TransferRow row;
  row.vertices = num_vertices(scene), row.triangles = num_triangles(scene);
  std::vector<Vec3f> normals;
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    normals.insert(normals.end(), mesh.normals.begin(), mesh.normals.end());
  }
  std::vector<float> coefficients(normals.size() * num_coefficients(kLightBands));
  row.classic.seconds = time_once([&] { sample_cosine_transfer(kLightBands, normals, samples, 1, coefficients); });
  row.classic.error = transfer_error(normals, coefficients);
  row.own.seconds = time_of(kRuns, [&](int) { eval_cosine_transfer(kLightBands, normals, coefficients); });
  row.own.error = transfer_error(normals, coefficients);
  return row;
}

BrdfRow measure_brdf_row(const Brdf& brdf, int samples) {
  const std::vector<Seen> seen = make_seen();
  const SphereSamples made = make_sphere_samples(kBrdfBands, strata_for(samples), 1);
  const FrameRotation rotation(kBrdfBands);
  BrdfRow row;
  std::vector<RgbCoefficients> classic(seen.size()), own(seen.size());
  row.classic.seconds = time_once([&] {
    parallel_for(seen.size(), 0, [&](std::size_t i) {
      const auto& [frame, v] = seen[i];
      const Vec3d view = v.x * frame.x + v.y * frame.y + v.z * frame.z;
      classic[i] = project_brdf_monte_carlo(brdf, frame.z, frame.x, view, made);
    });
  });

  constexpr std::size_t kEach = 8;
  const auto error_of = [&](const std::vector<RgbCoefficients>& test, const std::vector<RgbCoefficients>& truth) {
    RelativeError error;
    for (std::size_t k = 0; k < truth.size(); ++k)
      for (std::size_t i = 0; i < truth[k].size(); ++i)
        error.add(luminance(test[k * kEach][i]), luminance(truth[k][i]));
    return error.value();
  };
  std::vector<RgbCoefficients> truth(seen.size() / kEach);
  parallel_for(truth.size(), 0, [&](std::size_t k) {
    const auto& [frame, v] = seen[k * kEach];
    truth[k] = to_world(rotation, frame, project_brdf(brdf, v, kBrdfBands, {1e-7, 192}).coefficients);
  });
  row.classic.error = error_of(classic, truth);

  std::vector<int> nodes;
  row.nodes_seconds = time_once([&] { nodes = choose_nodes(brdf, kBrdfBands, 0.1 * row.classic.error); });
  row.own.seconds = time_of(3, [&](int) {
    parallel_for(seen.size(), 0, [&](std::size_t i) {
      own[i] = to_world(rotation, seen[i].frame, project_brdf_fixed(brdf, seen[i].view, kBrdfBands, nodes));
    });
  });
  row.own.error = error_of(own, truth);
  ReflectanceTable table;
  row.table_seconds = time_once([&] { table = make_reflectance_table(brdf); });
  row.lookup.seconds = time_of(kRuns, [&](int) { own = look_up(table, seen); });
  row.lookup.error = error_of(own, truth);
  return row;
}

double measure_view_seconds(const Brdf& brdf) {
  const ReflectanceTable table = make_reflectance_table(brdf);
  const std::vector<Seen> seen = make_seen();
  return time_of(kRuns, [&](int) { look_up(table, seen); });
}

double measure_rotation_seconds(int vertices) {
  const std::vector<Seen> seen = make_seen();
  const FrameRotation rotation(kBrdfBands);
  RgbCoefficients light(kBrdfBands);
  for (std::size_t i = 0; i < light.size(); ++i) light[i] = {1, 1, 1};
  return time_of(kRuns, [&](int) {
    for (int i = 0; i < vertices; ++i)
      light = to_world(rotation, seen[static_cast<std::size_t>(i) % seen.size()].frame, light);
  });
}

namespace {

RenderParams frame_params(int frames, int bands) {
  RenderParams params;
  params.width = 1440, params.height = 900;
  params.frames = frames;
  params.bands = bands;
  params.show_background = false;
  return params;
}

}  // namespace

FrameRow measure_frame_row(const Scene& scene, const Light& light, int frames) {
  FrameRow row;
  row.vertices = num_vertices(scene), row.triangles = num_triangles(scene);
  const RenderParams params = frame_params(frames, kLightBands);
  const RenderLight render_light = {light.project(kLightBands), {}};
  const RenderResult nine = render_irradiance(scene, render_light, params);
  BakeParams bake;
  bake.kind = TransferKind::kCosine, bake.bands = kLightBands;
  const RenderResult classic = render_transfer(scene, bake_transfer(scene, bake), render_light, params);
  row.irradiance = 1000 / nine.frame_ms, row.transfer = 1000 / classic.frame_ms;
  row.gl_renderer = nine.gl_renderer;
  return row;
}

double measure_reflectance_frames(const Scene& scene, const Brdf& brdf, const Light& light, Shade shade, int frames) {
  RenderParams params = frame_params(frames, kBrdfBands);
  params.shade = shade;
  ReflectanceTableParams table;
  table.bands = kBrdfBands;
  const auto surfaces = make_surface_reflectances(scene, brdf, table);
  return 1000 / render_reflectance(scene, surfaces, {light.project(kBrdfBands), {}}, params).frame_ms;
}

}  // namespace shlight
