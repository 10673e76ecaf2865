#include "shlight/truth/band_samples.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "shlight/core/parallel.h"
#include "shlight/image/pixels.h"
#include "shlight/sh/basis.h"
#include "shlight/sh/energy.h"

namespace shlight {
namespace {

double channel(Rgb c, std::size_t i) {
  return i == 0 ? c.r : i == 1 ? c.g : c.b;
}

double largest_channel(Rgb c) {
  return std::max({std::abs(c.r), std::abs(c.g), std::abs(c.b)});
}

// The pixels that have more than a thousandth of the light each, in 2 x 2 points, so that there are at most 4000.
std::vector<LightPoint> find_bright_pixels(const Environment& environment) {
  constexpr double kShare = 1e-3;
  const auto [width, height] = environment.size();
  const PixelQuadrature quadrature(environment.layout, environment.size(), 2);
  std::vector<double> power;
  double sum = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const bool covers = quadrature.covers({x, y});
      power.push_back(covers ? largest_channel(environment.image.rgb(x, y)) * quadrature.solid_angle({x, y}) : 0);
      sum += power.back();
    }
  std::vector<LightPoint> points;
  std::vector<WeightedDirection> nodes;
  for (std::size_t i = 0; i < power.size(); ++i) {
    if (power[i] <= kShare * sum) continue;
    const int x = static_cast<int>(i) % width, y = static_cast<int>(i) / width;
    quadrature.nodes({x, y}, nodes);
    for (const WeightedDirection& node : nodes)
      points.push_back({node.direction, node.solid_angle * environment.image.rgb(x, y)});
  }
  return points;
}

// Takes the points' coefficients out of those of the whole light. Each chunk adds up its own points; chunks are added
// up in sequence.
void subtract_points(const std::vector<LightPoint>& points, RgbCoefficients& coefficients, int threads) {
  constexpr std::size_t kChunk = 64;
  std::vector<RgbCoefficients> sums((points.size() + kChunk - 1) / kChunk, RgbCoefficients(coefficients.bands()));
  parallel_for(sums.size(), threads, [&](std::size_t chunk) {
    for (std::size_t i = chunk * kChunk; i < std::min((chunk + 1) * kChunk, points.size()); ++i)
      add_delta(points[i].direction, -1 * points[i].irradiance, sums[chunk]);
  });
  for (const RgbCoefficients& sum : sums) coefficients += sum;
}

// The 99th percentile of errors that have weights: the smallest that all larger ones together weigh no more than 1 %.
double percentile_99(std::vector<std::pair<double, double>> errors) {
  std::ranges::sort(errors);
  double total = 0, below = 0;
  for (const auto& [error, weight] : errors) total += weight;
  for (const auto& [error, weight] : errors)
    if ((below += weight) >= 0.99 * total) return error;
  return errors.back().first;
}

BandError summarise(const std::vector<BandSample>& samples, Rgb largest, std::size_t approximation, int bands) {
  BandError result;
  result.bands = bands;
  std::vector<std::pair<double, double>> errors, local_errors;
  double weights = 0, sum = 0, squares = 0, local_sum = 0, local_squares = 0;
  for (const BandSample& sample : samples)
    for (std::size_t c = 0; c < 3; ++c) {
      const double top = channel(largest, c), truth = channel(sample.truth, c);
      if (!(top > 0)) continue;
      const double difference = std::abs(channel(sample.approximations[approximation], c) - truth);
      const double error = difference / top, local = difference / std::max(std::abs(truth), kDarkest * top);
      errors.emplace_back(error, sample.weight);
      local_errors.emplace_back(local, sample.weight);
      weights += sample.weight;
      sum += sample.weight * error, squares += sample.weight * error * error;
      local_sum += sample.weight * local, local_squares += sample.weight * local * local;
      if (error > result.max) result.max = error, result.worst_normal = sample.normal, result.worst_view = sample.view;
      if (local > result.max_local)
        result.max_local = local, result.worst_local_normal = sample.normal, result.worst_local_view = sample.view;
    }
  result.mean = sum / weights, result.rms = std::sqrt(squares / weights);
  result.mean_local = local_sum / weights, result.rms_local = std::sqrt(local_squares / weights);
  result.p99 = percentile_99(std::move(errors)), result.p99_local = percentile_99(std::move(local_errors));
  return result;
}

}  // namespace

ReferenceLight make_reference_light(const Light& light, int bands, int threads) {
  const auto* image = dynamic_cast<const ImageLight*>(&light);
  const auto* coefficients = dynamic_cast<const CoefficientLight*>(&light);
  if (image || coefficients) {
    ReferenceLight result = {light.project(bands, threads), {}, {}};
    if (image)
      result.points = find_bright_pixels(image->environment());
    else if (coefficients->sun())
      result.points = {{coefficients->sun()->direction, coefficients->sun()->irradiance}};
    result.rest = result.all;
    subtract_points(result.points, result.rest, threads);
    return result;
  }
  const auto split = light.split_sun(threads);
  ReferenceLight result = {(split ? *split->rest : light).project(bands, threads), {}, {}};
  result.rest = result.all;
  if (!split) return result;
  add_sun(split->sun, result.all);
  result.points = {{split->sun.direction, split->sun.irradiance}};
  return result;
}

std::vector<RgbCoefficients> make_approximations(const ReferenceLight& light, const BandErrorParams& params) {
  std::vector<RgbCoefficients> approximations;
  for (int n = 1; n <= params.max_bands; ++n) approximations.push_back(resize_bands(light.all, n));
  const std::size_t plain = approximations.size();
  for (std::size_t i = 0; params.shape && i < plain; ++i) approximations.push_back(params.shape(approximations[i]));
  return approximations;
}

bool summarise_samples(const std::vector<BandSample>& samples, int max_bands, BandErrors& errors) {
  for (const BandSample& sample : samples)
    errors.largest = {std::max(errors.largest.r, sample.truth.r), std::max(errors.largest.g, sample.truth.g),
                      std::max(errors.largest.b, sample.truth.b)};
  if (!(largest_channel(errors.largest) > 0)) return false;
  for (const BandSample& sample : samples)
    for (std::size_t c = 0; c < 3; ++c)
      if (const double top = channel(errors.largest, c); top > 0)
        errors.reference_error = std::max(errors.reference_error, std::abs(channel(sample.upper_half, c)) / top);
  const auto count = static_cast<std::size_t>(max_bands);
  for (std::size_t i = 0; i < count; ++i)
    errors.bands.push_back(summarise(samples, errors.largest, i, static_cast<int>(i) + 1));
  for (std::size_t i = count; !samples.empty() && i < samples[0].approximations.size(); ++i)
    errors.shaped.push_back(summarise(samples, errors.largest, i, static_cast<int>(i - count) + 1));
  return true;
}

void summarise_energy(const ReferenceLight& light, std::vector<double> reflectance, int max_bands, BandErrors& errors) {
  errors.light_energy = energy_per_band(light.all);
  errors.reflectance_energy = std::move(reflectance);
  errors.light_total = std::accumulate(errors.light_energy.begin(), errors.light_energy.end(), 0.0);
  errors.reflectance_total = std::accumulate(errors.reflectance_energy.begin(), errors.reflectance_energy.end(), 0.0);
  errors.light_energy.resize(static_cast<std::size_t>(max_bands));
  errors.reflectance_energy.resize(static_cast<std::size_t>(max_bands));
}

}  // namespace shlight
