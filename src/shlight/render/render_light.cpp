#include "shlight/render/render_light.h"

#include <cmath>

#include "shlight/image/tone_map.h"

namespace shlight {

RenderLight make_render_light(const Light& light, int bands, int background_width, int threads) {
  RenderLight result{light.project(bands, threads), {}};
  if (!dynamic_cast<const CoefficientLight*>(&light)) result.background = light.lat_long(background_width, threads);
  return result;
}

LightScale light_scale(const RgbCoefficients& radiance) {
  const double exposure = auto_exposure(radiance);
  return {exposure, std::exp2(std::round(std::log2(exposure)))};
}

RgbCoefficients scaled(double factor, RgbCoefficients coefficients) {
  for (Rgb& c : coefficients.values()) c = factor * c;
  return coefficients;
}

RgbCoefficients keep_degree(RgbCoefficients coefficients, int l) {
  for (int i = 0; i < static_cast<int>(coefficients.size()); ++i)
    if (i < num_coefficients(l) || i >= num_coefficients(l + 1)) coefficients[static_cast<std::size_t>(i)] = {};
  return coefficients;
}

}  // namespace shlight
