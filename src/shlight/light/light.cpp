#include "shlight/light/light.h"

#include <algorithm>
#include <cmath>

#include "shlight/light/project_image.h"
#include "shlight/sh/basis.h"
#include "shlight/sh/zonal.h"

namespace shlight {

namespace {

constexpr int kSamples = 2;       // a side, of a pixel
constexpr int kDiscSamples = 16;  // of a pixel on a disc's edge: the sun is hardly larger than a pixel

// Whether the edge of a disc may run through a pixel with these 2 x 2 nodes.
bool is_on_edge(const FunctionLight::Disc& disc, std::span<const WeightedDirection> nodes) {
  double widest = 0;  // squared chord
  for (const WeightedDirection& node : nodes)
    widest = std::max(widest, 2 - 2 * dot(node.direction, nodes[0].direction));
  const double angle = std::acos(std::clamp(dot(nodes[0].direction, disc.axis), -1.0, 1.0));
  // The nodes of a square pixel lie half of its width apart: none of it is farther from the first than 1.5 diagonals.
  return std::abs(angle - disc.half_angle) <= 1.6 * std::sqrt(widest);
}

}  // namespace

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

Rgb CoefficientLight::radiance(Vec3d direction) const {
  return reconstruct(coefficients_, direction);
}

RgbCoefficients CoefficientLight::project(int bands, int) const {
  return resize_bands(coefficients_, bands);
}

FunctionLight::FunctionLight(SphereFunction function, std::vector<Disc> discs)
    : function_(std::move(function)), discs_(std::move(discs)) {
  for (const Disc& disc : discs_) squared_chords_.push_back(4 * std::pow(std::sin(disc.half_angle / 2), 2));
}

Rgb FunctionLight::radiance(Vec3d direction) const {
  Rgb sum = function_(direction);
  for (std::size_t i = 0; i < discs_.size(); ++i) {
    const Vec3d chord = direction - discs_[i].axis;
    if (dot(chord, chord) <= squared_chords_[i]) sum += discs_[i].radiance;
  }
  return sum;
}

Image FunctionLight::picture(const MakePictureParams& params, const Progress& progress) const {
  const auto samples = [this](std::span<const WeightedDirection> nodes) {
    return std::ranges::any_of(discs_, [&](const Disc& disc) { return is_on_edge(disc, nodes); }) ? kDiscSamples
                                                                                                  : kSamples;
  };
  return make_picture([this](Vec3d d) { return radiance(d); }, samples, params, progress);
}

RgbCoefficients FunctionLight::project(int bands, int) const {
  RgbCoefficients coefficients = project_quadrature(function_, bands).coefficients;
  for (const Disc& disc : discs_) add_disc(disc.axis, disc.half_angle, disc.radiance, coefficients);
  return coefficients;
}

}  // namespace shlight
