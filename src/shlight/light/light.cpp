#include "shlight/light/light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "shlight/light/project_image.h"
#include "shlight/sh/area_light.h"
#include "shlight/sh/basis.h"
#include "shlight/sh/zonal.h"

namespace shlight {

namespace {

constexpr int kSamples = 2;            // a side, of a pixel
constexpr int kEdgeSamples = 16;       // of a pixel on the edge of a disc or a polygon
constexpr int kSmallDiscSamples = 32;  // of a disc hardly larger than a pixel, as the sun is

double solid_angle_of(double half_angle) {
  return 4 * std::numbers::pi * std::pow(std::sin(0.5 * half_angle), 2);
}

// What a pixel with these 2 x 2 nodes needs where the edge of a disc may run through it.
int samples_for(const FunctionLight::Disc& disc, std::span<const WeightedDirection> nodes) {
  double widest = 0;  // squared chord
  for (const WeightedDirection& node : nodes)
    widest = std::max(widest, 2 - 2 * dot(node.direction, nodes[0].direction));
  const double angle = std::acos(std::clamp(dot(nodes[0].direction, disc.axis), -1.0, 1.0));
  // The nodes of a square pixel lie half of its width apart: none of it is farther from the first than 1.5 diagonals.
  const double reach = 1.6 * std::sqrt(widest);
  if (std::abs(angle - disc.half_angle) > reach) return kSamples;
  return disc.half_angle < 2 * reach ? kSmallDiscSamples : kEdgeSamples;
}

// The same for a polygon.
int samples_for(const FunctionLight::Polygon& polygon, std::span<const WeightedDirection> nodes) {
  const auto covers = [&](const WeightedDirection& node) {
    return polygon_covers(polygon.vertices, Sides::kBoth, node.direction);
  };
  const auto covered = std::ranges::count_if(nodes, covers);
  return covered == 0 || covered == std::ssize(nodes) ? kSamples : kEdgeSamples;
}

}  // namespace

std::optional<SunSplit> Light::split_sun(int) const {
  return {};
}

Image Light::picture(const MakePictureParams& params, const Progress& progress) const {
  return make_picture([this](Vec3d d) { return radiance(d); }, [](auto) { return kSamples; }, params, progress);
}

Image Light::lat_long(int width, int threads) const {
  return picture({Layout::kLatLong, width, threads});
}

RgbCoefficients ImageLight::project(int bands, int threads) const {
  return project_image(environment_, bands, threads);
}

Image ImageLight::picture(const MakePictureParams& params, const Progress& progress) const {
  return resample(environment_, params, progress);
}

Image ImageLight::lat_long(int width, int threads) const {
  return environment_.layout == Layout::kLatLong ? environment_.image : Light::lat_long(width, threads);
}

std::optional<SunSplit> ImageLight::split_sun(int threads) const {
  Environment rest = environment_;
  const auto sun = shlight::split_sun(rest, threads);
  if (!sun) return {};
  return SunSplit{*sun, std::make_unique<ImageLight>(std::move(rest))};
}

Rgb CoefficientLight::radiance(Vec3d direction) const {
  Rgb sum = reconstruct(coefficients_, direction);
  if (sun_ && dot(direction, sun_->direction) >= std::cos(kSunHalfAngle))
    sum += 1 / solid_angle_of(kSunHalfAngle) * sun_->irradiance;
  return sum;
}

RgbCoefficients CoefficientLight::project(int bands, int) const {
  RgbCoefficients coefficients = resize_bands(coefficients_, bands);
  if (sun_) add_sun(*sun_, coefficients);
  return coefficients;
}

std::optional<SunSplit> CoefficientLight::split_sun(int) const {
  if (sun_) return SunSplit{*sun_, std::make_unique<CoefficientLight>(coefficients_)};
  RgbCoefficients rest = coefficients_;
  const auto sun = shlight::split_sun(rest);
  if (!sun) return {};
  return SunSplit{*sun, std::make_unique<CoefficientLight>(std::move(rest))};
}

FunctionLight::FunctionLight(SphereFunction function, std::vector<Disc> discs, std::vector<Polygon> polygons)
    : function_(std::move(function)), discs_(std::move(discs)), polygons_(std::move(polygons)) {
  for (const Disc& disc : discs_) squared_chords_.push_back(4 * std::pow(std::sin(disc.half_angle / 2), 2));
}

Rgb FunctionLight::radiance(Vec3d direction) const {
  Rgb sum = function_(direction);
  for (std::size_t i = 0; i < discs_.size(); ++i) {
    const Vec3d chord = direction - discs_[i].axis;
    if (dot(chord, chord) <= squared_chords_[i]) sum += discs_[i].radiance;
  }
  for (const Polygon& polygon : polygons_)
    if (polygon_covers(polygon.vertices, Sides::kBoth, direction)) sum += polygon.radiance;
  return sum;
}

Image FunctionLight::picture(const MakePictureParams& params, const Progress& progress) const {
  const auto samples = [this](std::span<const WeightedDirection> nodes) {
    int most = kSamples;
    for (const Disc& disc : discs_) most = std::max(most, samples_for(disc, nodes));
    for (const Polygon& polygon : polygons_) most = std::max(most, samples_for(polygon, nodes));
    return most;
  };
  return make_picture([this](Vec3d d) { return radiance(d); }, samples, params, progress);
}

RgbCoefficients FunctionLight::project(int bands, int) const {
  RgbCoefficients coefficients = project_quadrature(function_, bands).coefficients;
  for (const Disc& disc : discs_) add_disc(disc.axis, disc.half_angle, disc.radiance, coefficients);
  for (const Polygon& polygon : polygons_) add_polygon(polygon.vertices, Sides::kBoth, polygon.radiance, coefficients);
  return coefficients;
}

std::optional<SunSplit> FunctionLight::split_sun(int) const {
  const auto power = [](const Disc& disc) { return luminance(disc.radiance) * solid_angle_of(disc.half_angle); };
  std::vector<Disc> rest = discs_;
  const auto suns = std::stable_partition(rest.begin(), rest.end(),
                                          [](const Disc& disc) { return disc.half_angle > kSunMaxHalfAngle; });
  const auto brightest =
      std::max_element(suns, rest.end(), [&](const Disc& a, const Disc& b) { return power(a) < power(b); });
  if (brightest == rest.end() || !(power(*brightest) > 0)) return {};
  const Disc disc = *brightest;
  rest.erase(brightest);
  const double all = std::sqrt(4 * std::numbers::pi) * luminance(project(1, 1)[0]);
  if (power(disc) < kSunMinShare * all) return {};
  return SunSplit{{disc.axis, solid_angle_of(disc.half_angle) * disc.radiance},
                  std::make_unique<FunctionLight>(function_, std::move(rest), polygons_)};
}

}  // namespace shlight
