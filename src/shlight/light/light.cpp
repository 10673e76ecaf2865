#include "shlight/light/light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "shlight/core/parallel.h"
#include "shlight/light/project_image.h"
#include "shlight/sh/basis.h"
#include "shlight/sh/zonal.h"

namespace shlight {

namespace {

// The mean of f over a pixel of a lat-long picture, from samples x samples directions.
template <class F>
Rgb mean_over_pixel(const Image& image, int x, int y, int samples, F&& f) {
  Rgb sum;
  for (int i = 0; i < samples; ++i)
    for (int j = 0; j < samples; ++j) {
      const ImagePoint point = {(x + (j + 0.5) / samples) / image.width, (y + (i + 0.5) / samples) / image.height};
      sum += f(*direction_at(Layout::kLatLong, point));
    }
  return 1.0 / (samples * samples) * sum;
}

template <class PixelValue>
Image make_lat_long(int width, int threads, PixelValue&& value) {
  Image image(width, std::max(1, width / 2));
  parallel_for(static_cast<std::size_t>(image.height), threads, [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < image.width; ++x) image.set_rgb(x, y, value(image, x, y));
  });
  return image;
}

constexpr int kSamples = 2;       // a side, of a pixel
constexpr int kDiscSamples = 16;  // of a pixel on a disc's edge: the sun is hardly larger than a pixel

// The mean over a pixel of a disc's radiance.
Rgb disc_over_pixel(const FunctionLight::Disc& disc, const Image& image, int x, int y) {
  const Vec3d centre = *direction_at(Layout::kLatLong, {(x + 0.5) / image.width, (y + 0.5) / image.height});
  const double angle = std::acos(std::clamp(dot(centre, disc.axis), -1.0, 1.0));
  const double reach = std::numbers::pi / image.height;  // more than half of a pixel's diagonal
  if (angle > disc.half_angle + reach) return {};
  if (angle < disc.half_angle - reach) return disc.radiance;
  const double edge = std::cos(disc.half_angle);
  return mean_over_pixel(image, x, y, kDiscSamples,
                         [&](Vec3d d) { return dot(d, disc.axis) >= edge ? disc.radiance : Rgb{}; });
}

}  // namespace

Image Light::lat_long(int width, int threads) const {
  return make_lat_long(width, threads, [&](const Image& image, int x, int y) {
    return mean_over_pixel(image, x, y, kSamples, [&](Vec3d d) { return radiance(d); });
  });
}

RgbCoefficients ImageLight::project(int bands, int threads) const {
  return project_image(environment_, bands, threads);
}

Image ImageLight::lat_long(int width, int threads) const {
  if (environment_.layout == Layout::kLatLong) return environment_.image;
  return Light::lat_long(width, threads);
}

Rgb CoefficientLight::radiance(Vec3d direction) const {
  return reconstruct(coefficients_, direction);
}

RgbCoefficients CoefficientLight::project(int bands, int) const {
  return resize_bands(coefficients_, bands);
}

Rgb FunctionLight::radiance(Vec3d direction) const {
  Rgb sum = function_(direction);
  for (const Disc& disc : discs_)
    if (dot(direction, disc.axis) >= std::cos(disc.half_angle)) sum += disc.radiance;
  return sum;
}

Image FunctionLight::lat_long(int width, int threads) const {
  return make_lat_long(width, threads, [&](const Image& image, int x, int y) {
    Rgb sum = mean_over_pixel(image, x, y, kSamples, function_);
    for (const Disc& disc : discs_) sum += disc_over_pixel(disc, image, x, y);
    return sum;
  });
}

RgbCoefficients FunctionLight::project(int bands, int) const {
  RgbCoefficients coefficients = project_quadrature(function_, bands).coefficients;
  for (const Disc& disc : discs_) add_disc(disc.axis, disc.half_angle, disc.radiance, coefficients);
  return coefficients;
}

}  // namespace shlight
