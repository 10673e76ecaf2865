#include "shlight/light/sun.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "shlight/core/parallel.h"
#include "shlight/image/pixels.h"
#include "shlight/light/project_image.h"
#include "shlight/sh/basis.h"
#include "shlight/sh/minimum.h"

namespace shlight {
namespace {

using std::numbers::pi;

constexpr double kDegree = pi / 180;

// Around the sun, from its middle: what is all sun, what fades into the sky, and the sky that it is measured against.
// The sun itself is 0.27°; a pixel of a 512-pixel map is 0.7° wide, and lenses and filters spread the sun over several.
constexpr double kCore = kSunMaxHalfAngle;
constexpr double kAperture = 3 * kDegree;
constexpr double kSkyInner = 3.5 * kDegree;
constexpr double kSkyOuter = 5.5 * kDegree;

// What makes a sun of it; real maps are far from either side of each (a cloud has a contrast of 3, a low red sun 25; a
// studio's lamp has a third of its light in the core, a sun nine tenths).
constexpr double kMinContrast = 6;       // mean luminance of the core over that of the sky
constexpr double kMinInCore = 0.7;       // share of its light from the core
constexpr double kMinExplained = 0.875;  // of coefficients: share of degrees 1 … n−1 in ∫ (luminance)²

Vec3d normalized(Vec3d v) {
  return 1 / std::sqrt(dot(v, v)) * v;
}

double angle_between(Vec3d a, Vec3d b) {
  const Vec3d c = cross(a, b);
  return std::atan2(std::sqrt(dot(c, c)), dot(a, b));
}

// Directions cut into cells of about half a degree, rows of equal height about the vertical.
class Cells {
 public:
  static constexpr int kRows = 360;
  Cells() : first_(kRows + 1) {
    for (int row = 0; row < kRows; ++row) first_[at(row) + 1] = first_[at(row)] + columns_of(row);
    flux_.resize(static_cast<std::size_t>(first_.back()));
  }

  void add(Vec3d d, double flux) { flux_[cell_of(d)] += flux; }

  // The middle of the cell around which most flux falls into a disc of the core's size.
  Vec3d brightest() const {
    Vec3d best = {0, 1, 0};
    double most = 0;
    for (int row = 0; row < kRows; ++row)
      for (int column = 0; column < columns_of(row); ++column) {
        if (flux_[at(first_[at(row)] + column)] <= 0) continue;
        const Vec3d centre = middle_of(row, column);
        const double around = flux_around(centre, row);
        if (around > most) most = around, best = centre;
      }
    return best;
  }

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  static int columns_of(int row) {
    return std::max(4, static_cast<int>(2 * kRows * std::sin((row + 0.5) * pi / kRows)));
  }
  static Vec3d middle_of(int row, int column) {
    const double theta = (row + 0.5) * pi / kRows, phi = 2 * pi * (column + 0.5) / columns_of(row);
    return {std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)};
  }
  std::size_t cell_of(Vec3d d) const {
    const double turns = std::atan2(d.z, d.x) / (2 * pi);
    const int row = std::clamp(static_cast<int>(std::acos(std::clamp(d.y, -1.0, 1.0)) / pi * kRows), 0, kRows - 1);
    const int columns = columns_of(row);
    return at(first_[at(row)] + std::clamp(static_cast<int>((turns - std::floor(turns)) * columns), 0, columns - 1));
  }
  double flux_around(Vec3d centre, int middle) const {
    constexpr int kReach = static_cast<int>(kCore / (pi / kRows));
    double sum = 0;
    for (int row = std::max(0, middle - kReach); row <= std::min(kRows - 1, middle + kReach); ++row)
      for (int column = 0; column < columns_of(row); ++column) {
        const double flux = flux_[at(first_[at(row)] + column)];
        if (flux > 0 && dot(middle_of(row, column), centre) > std::cos(kCore)) sum += flux;
      }
    return sum;
  }

  std::vector<int> first_;
  std::vector<double> flux_;
};

struct SeenPixel {
  Pixel pixel;
  WeightedDirection at;  // its centre, all of its solid angle
};

std::optional<Vec3d> centre_of(const Environment& environment, Pixel pixel) {
  return direction_at(environment.layout, pixel_centre(environment.layout, environment.size(), pixel));
}

// The pixels whose centre is within `reach` of a direction, row by row.
std::vector<SeenPixel> pixels_around(const Environment& environment, const PixelQuadrature& quadrature, Vec3d centre,
                                     double reach, int threads) {
  const auto [width, height] = environment.size();
  std::vector<std::vector<SeenPixel>> rows(static_cast<std::size_t>(height));
  parallel_for(rows.size(), threads, [&](std::size_t row) {
    const int y = static_cast<int>(row);
    // A row of a lat-long map has one height: most need no look at their pixels.
    if (is_lat_long(environment.layout)) {
      const Vec3d first = centre_of(environment, {0, y}).value_or(centre);
      if (std::abs(std::asin(std::clamp(first.y, -1.0, 1.0)) - std::asin(std::clamp(centre.y, -1.0, 1.0))) > reach)
        return;
    }
    for (int x = 0; x < width; ++x) {
      const auto d = centre_of(environment, {x, y});
      if (d && dot(*d, centre) >= std::cos(reach)) rows[row].push_back({{x, y}, {*d, quadrature.solid_angle({x, y})}});
    }
  });
  std::vector<SeenPixel> pixels;
  for (const auto& row : rows) pixels.insert(pixels.end(), row.begin(), row.end());
  return pixels;
}

// Of a pixel's excess over the sky, what counts as sun.
double aperture_at(double angle) {
  const double t = std::clamp((kAperture - angle) / (kAperture - kCore), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

// What is found within the angles above of one direction.
struct Surroundings {
  Rgb sky;             // mean radiance of the ring
  Rgb sun;             // flux above it, with the aperture's weights
  double in_core = 0;  // luminance of that from the core
  double core = 0;     // mean luminance of the core, sky and all
  Vec3d centroid;      // of the luminance above the sky
};

Surroundings look_around(const Image& image, const std::vector<SeenPixel>& pixels, Vec3d centre) {
  Surroundings result;
  double ring = 0, core = 0;
  for (const auto& [pixel, at] : pixels) {
    const double angle = angle_between(at.direction, centre);
    if (angle < kSkyInner || angle > kSkyOuter) continue;
    result.sky += at.solid_angle * image.rgb(pixel.x, pixel.y);
    ring += at.solid_angle;
  }
  if (ring > 0) result.sky = 1 / ring * result.sky;
  for (const auto& [pixel, at] : pixels) {
    const double angle = angle_between(at.direction, centre);
    if (angle > kAperture) continue;
    const Rgb radiance = image.rgb(pixel.x, pixel.y);
    const Rgb above = aperture_at(angle) * at.solid_angle * (radiance - result.sky);
    result.sun += above;
    result.centroid = result.centroid + std::max(0.0, luminance(above)) * at.direction;
    if (angle > kCore) continue;
    result.in_core += luminance(above);
    result.core += at.solid_angle * luminance(radiance);
    core += at.solid_angle;
  }
  if (core > 0) result.core /= core;
  return result;
}

}  // namespace

void add_sun(const Sun& sun, RgbCoefficients& coefficients) {
  add_delta(sun.direction, sun.irradiance, coefficients);
}

std::optional<Sun> split_sun(Environment& environment, int threads) {
  Image& image = environment.image;
  const double all = std::sqrt(4 * pi) * luminance(project_image(environment, 1, threads)[0]);
  if (!(all > 0)) return {};

  // Only what is brighter than a few times the mean can belong to a sun.
  const double bright = 4 * all / (4 * pi);
  constexpr int kBands = 6;  // of solid angles, as pixel_solid_angle has it
  const PixelQuadrature quadrature(environment.layout, environment.size(),
                                   nodes_a_side_for(environment.layout, environment.size(), kBands));
  Cells cells;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const double value = luminance(image.rgb(x, y));
      if (value <= bright) continue;
      if (const auto d = centre_of(environment, {x, y})) cells.add(*d, value * quadrature.solid_angle({x, y}));
    }

  // From the brightest cell to the centre of the light above the sky, until it stays; that moves by a core at most.
  Vec3d centre = cells.brightest();
  const auto pixels = pixels_around(environment, quadrature, centre, kSkyOuter + 2 * kCore, threads);
  Surroundings around;
  for (int i = 0; i < 20; ++i) {
    around = look_around(image, pixels, centre);
    if (!(dot(around.centroid, around.centroid) > 0)) return {};
    const Vec3d next = normalized(around.centroid);
    const double step = angle_between(next, centre);
    centre = next;
    if (step < 1e-4 * kDegree) break;
  }
  around = look_around(image, pixels, centre);
  const double sun = luminance(around.sun);
  if (!(sun >= kSunMinShare * all && around.in_core >= kMinInCore * sun &&
        around.core >= kMinContrast * luminance(around.sky)))
    return {};

  // Each channel in which it shines goes over to the sky's value. What is taken away is summed as it is stored.
  Sun result{centre, {}};
  for (const auto& [pixel, at] : pixels) {
    const double share = aperture_at(angle_between(at.direction, centre));
    if (share == 0) continue;
    const Rgb before = image.rgb(pixel.x, pixel.y), over = before - around.sky;
    image.set_rgb(pixel.x, pixel.y,
                  before - share * Rgb{around.sun.r > 0 ? over.r : 0, around.sun.g > 0 ? over.g : 0,
                                       around.sun.b > 0 ? over.b : 0});
    result.irradiance += at.solid_angle * (before - image.rgb(pixel.x, pixel.y));
  }
  return result;
}

namespace {

// The direction of the largest Σ c_i Y_i: certified to lie near, then climbed.
Vec3d brightest_direction(const std::vector<double>& coefficients, int bands) {
  std::vector<double> negated;
  for (const double c : coefficients) negated.push_back(-c);
  Vec3d best = find_minimum(negated, bands, 1e-3).direction;
  GradientEvaluator evaluate(coefficients, bands);
  ValueAndGradient here = evaluate(best);
  // A delta light's bands bend by Σ (2l+1)/4π l(l+1)/2 of their strength at the top: Newton's step for it. Shortened
  // where it overshoots; steps of less than a double's half have no effect that can be told.
  double peak = 0, bend = 0;
  for (int l = 1; l < bands; ++l) {
    peak += (2 * l + 1) / (4 * pi);
    bend += (2 * l + 1) / (4 * pi) * l * (l + 1) / 2;
  }
  double step = here.value > 0 ? peak / (bend * here.value) : 0;
  for (int i = 0; i < 100 && step * std::sqrt(dot(here.gradient, here.gradient)) > 1e-10; ++i) {
    const Vec3d next = normalized(best + step * here.gradient);
    const ValueAndGradient there = evaluate(next);
    if (there.value > here.value)
      best = next, here = there;
    else
      step /= 2;
  }
  return best;
}

}  // namespace

// With the constant free, only degrees from 1 on count. Along a given direction the best strength is Σ c_i Y_i(d) /
// Σ Y_i(d)² [1], Σ Y_i² = Σ (2l+1)/4π wherever d is, and what it explains grows with the numerator: d is where that is
// largest.
std::optional<Sun> split_sun(RgbCoefficients& coefficients) {
  const int bands = coefficients.bands();
  // Two bands are a delta light's whatever the light is.
  if (bands < 3) return {};
  std::vector<double> values;
  double variation = 0;
  for (const Rgb c : coefficients.values()) values.push_back(luminance(c));
  values[0] = 0;
  for (const double v : values) variation += v * v;
  const double all = std::sqrt(4 * pi) * luminance(coefficients[0]);
  if (!(all > 0 && variation > 1e-12 * all * all)) return {};

  Sun sun{brightest_direction(values, bands), {}};
  RgbCoefficients delta(bands);
  add_delta(sun.direction, {1, 1, 1}, delta);
  const double power = (num_coefficients(bands) - 1) / (4 * pi);
  for (std::size_t i = 1; i < delta.size(); ++i) sun.irradiance += delta[i].g / power * coefficients[i];
  if (luminance(sun.irradiance) * luminance(sun.irradiance) * power < kMinExplained * variation) return {};
  // No channel gives more than it has, or takes.
  const Rgb most = std::sqrt(4 * pi) * coefficients[0];
  const auto limited = [](double v, double limit) { return std::clamp(v, 0.0, std::max(0.0, limit)); };
  sun.irradiance = {limited(sun.irradiance.r, most.r), limited(sun.irradiance.g, most.g),
                    limited(sun.irradiance.b, most.b)};
  if (!(luminance(sun.irradiance) >= kSunMinShare * all)) return {};
  add_sun({sun.direction, -1 * sun.irradiance}, coefficients);
  return sun;
}

}  // namespace shlight
