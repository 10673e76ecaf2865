#include "shlight/truth/band_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "shlight/brdf/project_brdf.h"
#include "shlight/core/assert.h"
#include "shlight/core/parallel.h"
#include "shlight/sh/basis.h"
#include "shlight/sh/energy.h"
#include "shlight/sh/rotation.h"
#include "shlight/sh/zonal.h"
#include "shlight/truth/band_samples.h"

namespace shlight {
namespace {

using std::numbers::pi;

constexpr int kCosineBands = 64;       // of the reference for Lambertian models
constexpr int kReflectanceBands = 32;  // for others
constexpr int kCosineNormals = 4096;
constexpr int kReflectanceNormals = 192;
constexpr int kPolarViews = 6, kAzimuthViews = 8;
// Reflectance coefficients, relative to their largest: far below what is measured.
constexpr ProjectBrdfParams kReflectanceParams = {1e-4, 48};

// Fibonacci's spiral: equal areas, no two of the same height.
std::vector<WeightedNormal> make_even_normals(int count) {
  std::vector<WeightedNormal> normals;
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (2 * i + 1.0) / count, s = std::sqrt(1 - z * z);
    const double phi = 2 * pi * std::fmod(i / std::numbers::phi, 1.0);
    normals.push_back({{s * std::cos(phi), s * std::sin(phi), z}});
  }
  return normals;
}

// Lambertian: one sample a normal, irradiance times ρ/π.
std::vector<BandSample> sample_cosine(const ReferenceLight& light, Rgb reflectance,
                                      const std::vector<WeightedNormal>& normals,
                                      const std::vector<RgbCoefficients>& approximations, int threads) {
  const int bands = light.rest.bands();
  const RgbCoefficients rest = irradiance_from_radiance(light.rest);
  std::vector<RgbCoefficients> irradiances;
  for (const RgbCoefficients& radiance : approximations) irradiances.push_back(irradiance_from_radiance(radiance));
  std::vector<BandSample> samples(normals.size());
  constexpr std::size_t kChunk = 64;
  parallel_for((normals.size() + kChunk - 1) / kChunk, threads, [&](std::size_t chunk) {
    std::vector<double> basis(static_cast<std::size_t>(num_coefficients(bands)));
    for (std::size_t k = chunk * kChunk; k < std::min((chunk + 1) * kChunk, normals.size()); ++k) {
      const Vec3d n = normals[k].normal;
      BandSample& sample = samples[k] = {n, n, normals[k].weight, {}, {}, {}};
      eval_basis(bands, n, std::span<double>(basis));
      const std::size_t half = static_cast<std::size_t>(num_coefficients(bands / 2));
      for (std::size_t i = 0; i < rest.size(); ++i) (i < half ? sample.truth : sample.upper_half) += basis[i] * rest[i];
      sample.truth += sample.upper_half;
      for (const LightPoint& point : light.points)
        sample.truth += std::max(0.0, dot(n, point.direction)) * point.irradiance;
      sample.truth = times(reflectance, sample.truth);
      sample.upper_half = times(reflectance, sample.upper_half);
      for (const RgbCoefficients& irradiance : irradiances) {
        Rgb sum;
        for (std::size_t i = 0; i < irradiance.size(); ++i) sum += basis[i] * irradiance[i];
        sample.approximations.push_back(times(reflectance, sum));
      }
    }
  });
  return samples;
}

// A side that surfaces are seen from, in their local frame, and F* of it.
struct View {
  Vec3d v;
  RgbCoefficients reflectance;
};

// The function with x -> −x or y -> −y: cos mφ and sin mφ keep their values or change their signs.
RgbCoefficients mirror(const RgbCoefficients& coefficients, bool x, bool y) {
  RgbCoefficients result = coefficients;
  for (int l = 0; l < result.bands(); ++l)
    for (int m = -l; m <= l; ++m) {
      const bool odd = m % 2 != 0, flipped_by_x = m > 0 ? odd : m < 0 && !odd, flipped_by_y = m < 0;
      if ((x && flipped_by_x) != (y && flipped_by_y)) result.at(l, m) = -1 * result.at(l, m);
    }
  return result;
}

std::vector<View> make_views(const Brdf& brdf, int threads) {
  std::vector<View> views(kPolarViews * kAzimuthViews);
  const auto view_at = [](int polar, int azimuth) {
    const double sine = std::sqrt((polar + 0.5) / kPolarViews), phi = 2 * pi * (azimuth + 0.5) / kAzimuthViews;
    return Vec3d{sine * std::cos(phi), sine * std::sin(phi), std::sqrt(1 - sine * sine)};
  };
  const auto slot = [&](int polar, int azimuth) -> View& {
    return views[static_cast<std::size_t>(polar * kAzimuthViews + azimuth)];
  };
  const BrdfSymmetry symmetry = brdf.traits().symmetry;
  // What is projected: the first azimuth, the first quarter or all.
  constexpr int kQuarter = kAzimuthViews / 4;
  const int projected = symmetry == BrdfSymmetry::kIsotropic  ? 1
                        : symmetry == BrdfSymmetry::kMirrored ? kQuarter
                                                              : kAzimuthViews;
  parallel_for(static_cast<std::size_t>(kPolarViews * projected), threads, [&](std::size_t i) {
    const int polar = static_cast<int>(i) / projected, azimuth = static_cast<int>(i) % projected;
    const Vec3d v = view_at(polar, azimuth);
    slot(polar, azimuth) = {v, project_brdf(brdf, v, kReflectanceBands, kReflectanceParams).coefficients};
  });
  // Turning the view about the normal, or mirroring it, does the same to what the surface reflects.
  for (int polar = 0; polar < kPolarViews; ++polar)
    for (int azimuth = projected; azimuth < kAzimuthViews; ++azimuth) {
      const int quarter = azimuth / kQuarter, within = azimuth % kQuarter;
      const RgbCoefficients& twin = slot(polar, quarter % 2 == 0 ? within : kQuarter - 1 - within).reflectance;
      slot(polar, azimuth) = {view_at(polar, azimuth),
                              projected == 1
                                  ? rotate_about_z(2 * pi * azimuth / kAzimuthViews, slot(polar, 0).reflectance)
                                  : mirror(twin, quarter == 1 || quarter == 2, quarter >= 2)};
    }
  return views;
}

// From the world to the frame of a normal whose tangent runs along the circle of latitude about +Y.
Rotation make_local_frame(Vec3d normal) {
  const double sine = std::sqrt(normal.x * normal.x + normal.z * normal.z);
  const Vec3d tangent = sine > 1e-9 ? 1 / sine * Vec3d{normal.z, 0, -normal.x} : Vec3d{1, 0, 0};
  return {{tangent, cross(normal, tangent), normal}};
}

Rgb scalar_product(const RgbCoefficients& a, const RgbCoefficients& b, std::size_t begin, std::size_t end) {
  Rgb sum;
  for (std::size_t i = begin; i < end; ++i) sum += times(a[i], b[i]);
  return sum;
}

// Others: all views of a normal, one after the other.
std::vector<BandSample> sample_reflectance(const ReferenceLight& light, const Brdf& brdf,
                                           const std::vector<View>& views, const std::vector<WeightedNormal>& normals,
                                           const std::vector<RgbCoefficients>& approximations, int threads) {
  const int bands = light.rest.bands();
  const auto half = static_cast<std::size_t>(num_coefficients(bands / 2));
  std::vector<BandSample> samples(normals.size() * views.size());
  parallel_for(normals.size(), threads, [&](std::size_t k) {
    const Rotation to_local = make_local_frame(normals[k].normal), to_world = inverse(to_local);
    const RotationMatrix matrix(bands, to_local);
    const RgbCoefficients rest = rotate(matrix, light.rest);
    std::vector<RgbCoefficients> local;
    for (const RgbCoefficients& radiance : approximations) local.push_back(rotate(matrix, radiance));
    std::vector<LightPoint> points;
    for (const LightPoint& point : light.points)
      if (const Vec3d s = to_local(point.direction); s.z > 0) points.push_back({s, s.z * point.irradiance});

    for (std::size_t j = 0; j < views.size(); ++j) {
      const auto& [v, reflectance] = views[j];
      BandSample& sample =
          samples[k * views.size() + j] = {normals[k].normal, to_world(v), normals[k].weight, {}, {}, {}};
      sample.upper_half = scalar_product(reflectance, rest, half, rest.size());
      sample.truth = scalar_product(reflectance, rest, 0, half) + sample.upper_half;
      for (const LightPoint& point : points) sample.truth += times(brdf.eval(point.direction, v), point.irradiance);
      for (const RgbCoefficients& radiance : local)
        sample.approximations.push_back(scalar_product(reflectance, radiance, 0, radiance.size()));
    }
  });
  return samples;
}

// ρ/π of a model that reflects the same whatever the directions; nothing for others.
std::optional<Rgb> find_constant_reflectance(const Brdf& brdf) {
  const bool lambert =
      std::ranges::all_of(brdf.lobes(), [](const BrdfLobe& l) { return l.shape == LobeShape::kLambert; });
  if (!lambert) return {};
  return brdf.eval({0, 0, 1}, {0, 0, 1});
}

}  // namespace

std::optional<BandErrors> measure_band_errors(const Light& light, const Brdf& brdf, const BandErrorParams& params) {
  SHLIGHT_ASSERT_LE(1, params.max_bands);
  SHLIGHT_ASSERT_LE(params.max_bands, kMaxErrorBands);
  const std::optional<Rgb> constant = find_constant_reflectance(brdf);
  const ReferenceLight reference =
      make_reference_light(light, constant ? kCosineBands : kReflectanceBands, params.threads);
  const auto normals =
      !params.normals.empty() ? params.normals : make_even_normals(constant ? kCosineNormals : kReflectanceNormals);

  const std::vector<RgbCoefficients> approximations = make_approximations(reference, params);

  BandErrors result;
  std::vector<BandSample> samples;
  std::vector<double> energy;
  if (constant) {
    samples = sample_cosine(reference, *constant, normals, approximations, params.threads);
    const double square = constant->r * constant->r + constant->g * constant->g + constant->b * constant->b;
    for (int l = 0; l < kCosineBands; ++l) energy.push_back(square * cosine_lobe(l) * cosine_lobe(l));
  } else {
    const std::vector<View> views = make_views(brdf, params.threads);
    samples = sample_reflectance(reference, brdf, views, normals, approximations, params.threads);
    energy.assign(kReflectanceBands, 0);
    for (const View& view : views) {
      const std::vector<double> of_view = energy_per_band(view.reflectance);
      for (std::size_t l = 0; l < energy.size(); ++l) energy[l] += of_view[l] / static_cast<double>(views.size());
    }
  }
  summarise_energy(reference, std::move(energy), params.max_bands, result);
  if (!summarise_samples(samples, params.max_bands, result)) return {};
  return result;
}

const std::vector<BandMeasure>& band_measures() {
  static const std::vector<BandMeasure> kMeasures = {
      {"rms", "root mean square, of the largest", &BandError::rms},
      {"p99", "99 % of directions, of the largest", &BandError::p99},
      {"max", "maximum, of the largest", &BandError::max},
      {"rms_local", "root mean square, of the local", &BandError::rms_local},
      {"p99_local", "99 % of directions, of the local", &BandError::p99_local},
      {"max_local", "maximum, of the local", &BandError::max_local},
  };
  return kMeasures;
}

const BandMeasure& band_measure(const std::string& name) {
  const auto measure = std::ranges::find(band_measures(), name, &BandMeasure::name);
  SHLIGHT_ASSERT_EQ(measure != band_measures().end(), true);
  return *measure;
}

std::optional<int> find_enough_bands(const std::vector<BandError>& errors, double BandError::*measure,
                                     double tolerance) {
  std::optional<int> enough;
  for (auto error = errors.rbegin(); error != errors.rend() && (*error).*measure <= tolerance; ++error)
    enough = error->bands;
  return enough;
}

}  // namespace shlight
