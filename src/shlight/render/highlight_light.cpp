#include "shlight/render/highlight_light.h"

#include <algorithm>
#include <cstddef>
#include <map>

#include "shlight/light/light.h"
#include "shlight/light/project_image.h"

namespace shlight {
namespace {

bool same_lobe(const SurfaceReflectance& a, const SurfaceReflectance& b) {
  return b.highlight && a.highlight->lobe.width == b.highlight->lobe.width &&
         a.highlight->lobe.profile == b.highlight->lobe.profile &&
         a.highlight->lobe.wide_along_x == b.highlight->lobe.wide_along_x &&
         a.highlight->lobe.slopes == b.highlight->lobe.slopes;
}

double smooth_step(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

// None of it is a point where the lobe, twice as wide in mirrored directions as in half vectors, is as slim as a sun
// may be; all of it from three times that on. Of lobes as wide as the bands resolve, coefficients know the shape
// better.
double sun_share(const LobeFromAbove& lobe, int bands) {
  return smooth_step(0.5 * kSunMaxHalfAngle, 1.5 * kSunMaxHalfAngle, lobe.width) *
         (1 - smooth_step(1.0 / bands, 2.0 / bands, lobe.width));
}

// The coefficients of `sun` through whatever window `light`, whose coefficients without one are `raw`, has been
// through.
RgbCoefficients windowed_sun(const Sun& sun, const RgbCoefficients& raw, const RgbCoefficients& light) {
  RgbCoefficients result(light.bands());
  add_sun(sun, result);
  for (int l = 0; l < light.bands(); ++l) {
    double both = 0, power = 0;
    for (int m = -l; m <= l; ++m) {
      both += luminance(raw.at(l, m)) * luminance(light.at(l, m));
      power += luminance(raw.at(l, m)) * luminance(raw.at(l, m));
    }
    for (int m = -l; m <= l; ++m) result.at(l, m) = (power > 0 ? both / power : 1) * result.at(l, m);
  }
  return result;
}

// The picture without a share of its sun.
Image take_away(double share, const Image& rest, Image picture) {
  const auto s = static_cast<float>(share);
  for (std::size_t i = 0; i < picture.values.size(); ++i) picture.values[i] += s * (rest.values[i] - picture.values[i]);
  return picture;
}

}  // namespace

HighlightLight make_highlight_light(std::span<const SurfaceReflectance> surfaces, const RenderLight& light, int bands,
                                    int threads, const Progress& progress) {
  constexpr int kWidth = 256;  // of a light that is coefficients
  const bool has_picture = light.background.num_pixels() > 0;
  const Image picture = has_picture ? light.background : CoefficientLight(light.coefficients).lat_long(kWidth, threads);
  const RgbCoefficients coefficients = resize_bands(light.coefficients, bands);
  HighlightLight result;
  result.sun_coefficients = RgbCoefficients(bands);
  Environment rest = {picture, Layout::kLatLong};
  if (has_picture) result.sun = split_sun(rest, threads);
  if (result.sun)
    result.sun_coefficients =
        windowed_sun(*result.sun, project_image({picture, Layout::kLatLong}, bands, threads), coefficients);

  std::map<double, ResidualLight> residuals;  // by the share of the sun that is taken away
  result.surfaces.resize(surfaces.size());
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    report_progress(progress, static_cast<double>(i) / static_cast<double>(surfaces.size()));
    if (!surfaces[i].highlight) continue;
    const LobeFromAbove& lobe = surfaces[i].highlight->lobe;
    std::size_t same = 0;
    while (same < i && !same_lobe(surfaces[i], surfaces[same])) ++same;
    if (same < i) {
      result.surfaces[i] = result.surfaces[same];
      continue;
    }
    const double share = result.sun ? sun_share(lobe, bands) : 0;
    if (!residuals.contains(share)) {
      RgbCoefficients without = result.sun_coefficients;
      for (std::size_t k = 0; k < without.size(); ++k) without[k] = coefficients[k] - share * without[k];
      residuals.emplace(share,
                        ResidualLight(take_away(share, rest.image, picture), taken_by_highlights(without), threads));
    }
    result.surfaces[i] = {prefilter_cube(residuals.at(share), lobe, prefiltered_size(lobe.width), threads), share};
  }
  report_progress(progress, 1);
  return result;
}

}  // namespace shlight
