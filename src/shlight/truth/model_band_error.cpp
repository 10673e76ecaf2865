#include "shlight/truth/model_band_error.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "shlight/brdf/lambert.h"
#include "shlight/core/assert.h"
#include "shlight/core/parallel.h"
#include "shlight/transfer/sites.h"
#include "shlight/transfer/tracer.h"
#include "shlight/transfer/transfer.h"
#include "shlight/truth/band_samples.h"

namespace shlight {
namespace {

// A third of the area of the triangles about each vertex.
std::vector<double> vertex_areas(const WorldMesh& world) {
  std::vector<double> areas(world.positions.size());
  for (std::size_t i = 0; i < world.indices.size(); i += 3) {
    const auto corner = [&](std::size_t k) { return vec_cast<double>(world.positions[world.indices[i + k]]); };
    const Vec3d normal = cross(corner(1) - corner(0), corner(2) - corner(0));
    for (std::size_t k = 0; k < 3; ++k) areas[world.indices[i + k]] += std::sqrt(dot(normal, normal)) / 6;
  }
  return areas;
}

// What the points of a light add to the radiance of each vertex, where nothing stands in their way.
std::vector<Rgb> light_by_points(const WorldMesh& world, const Sites& sites, const std::vector<LightPoint>& points,
                                 int threads) {
  const auto tracer = make_embree_tracer(world.positions, world.indices);
  std::vector<Rgb> radiance(sites.size());
  parallel_for(sites.size(), threads, [&](std::size_t site) {
    const Vec3d normal = vec_cast<double>(sites.normals[site]);
    std::vector<Ray> rays;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (dot(normal, points[i].direction) <= 0) continue;
      Ray ray;
      ray.origin = sites.origins[site];
      ray.direction = vec_cast<float>(points[i].direction);
      ray.far = INFINITY;
      ray.id = static_cast<std::uint32_t>(i);
      rays.push_back(ray);
    }
    tracer->find_occluded(rays);
    for (const Ray& ray : rays)
      if (ray.far >= 0) {
        const LightPoint& point = points[ray.id];
        radiance[site] += dot(normal, point.direction) / std::numbers::pi * point.irradiance;
      }
  });
  return radiance;
}

Rgb scalar_product(const float* transfer, const RgbCoefficients& light, std::size_t begin, std::size_t end) {
  Rgb sum;
  for (std::size_t i = begin; i < end; ++i) sum += double{transfer[i]} * light[i];
  return sum;
}

}  // namespace

std::optional<BandErrors> measure_model_band_errors(const Light& light, const Scene& scene,
                                                    const ModelBandErrorParams& params, const Progress& progress) {
  SHLIGHT_ASSERT_LE(params.errors.max_bands, kMaxTransferBands);
  const WorldMesh world = make_world_mesh(scene);
  const std::vector<double> areas = vertex_areas(world);
  if (!params.shadowed) {
    BandErrorParams open = params.errors;
    for (std::size_t v = 0; v < areas.size(); ++v)
      if (areas[v] > 0) open.normals.push_back({vec_cast<double>(world.normals[v]), areas[v]});
    if (open.normals.empty()) return {};
    return measure_band_errors(light, *make_lambert({1, 1, 1}), open);
  }

  BakeParams bake;
  bake.kind = TransferKind::kShadowed;
  bake.bands = kMaxTransferBands;
  bake.samples = params.samples;
  bake.threads = params.errors.threads;
  const Transfer transfer = bake_transfer(scene, bake, watch(progress));
  const Sites sites = make_sites(world, params.errors.threads);
  const ReferenceLight reference = make_reference_light(light, kMaxTransferBands, params.errors.threads);
  const std::vector<Rgb> by_points = light_by_points(world, sites, reference.points, params.errors.threads);
  const std::vector<RgbCoefficients> approximations = make_approximations(reference, params.errors);

  const std::size_t all = reference.rest.size();
  const auto half = static_cast<std::size_t>(num_coefficients(kMaxTransferBands / 2));
  std::vector<BandSample> samples;
  std::vector<double> energy(kMaxTransferBands);
  double total_area = 0;
  for (std::size_t v = 0; v < areas.size(); ++v) {
    if (!(areas[v] > 0)) continue;
    const float* a = transfer.coefficients.data() + v * all;
    const Vec3d normal = vec_cast<double>(world.normals[v]);
    BandSample sample = {normal, normal, areas[v], {}, {}, {}};
    sample.upper_half = scalar_product(a, reference.rest, half, all);
    sample.truth = scalar_product(a, reference.rest, 0, half) + sample.upper_half + by_points[sites.of_vertex[v]];
    for (const RgbCoefficients& radiance : approximations)
      sample.approximations.push_back(scalar_product(a, radiance, 0, radiance.size()));
    samples.push_back(std::move(sample));
    total_area += areas[v];
    for (int l = 0; l < kMaxTransferBands; ++l)
      for (int m = -l; m <= l; ++m) {
        const double c = a[coefficient_index(l, m)];
        energy[static_cast<std::size_t>(l)] += 3 * areas[v] * c * c;
      }
  }
  if (samples.empty()) return {};
  for (double& e : energy) e /= total_area;
  BandErrors result;
  summarise_energy(reference, std::move(energy), params.errors.max_bands, result);
  if (!summarise_samples(samples, params.errors.max_bands, result)) return {};
  return result;
}

}  // namespace shlight
