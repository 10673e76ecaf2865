#pragma once

#include "shlight/image/image.h"
#include "shlight/light/light.h"
#include "shlight/sh/coefficients.h"

namespace shlight {

inline constexpr int kMaxRenderBands = 10;

// A distant light as the renderers need it.
struct RenderLight {
  RgbCoefficients coefficients;  // of radiance
  Image background;              // lat-long radiance, drawn at infinity; empty: reconstructed from the coefficients
};

// The coefficients and the picture of `light`. Lights that are coefficients themselves need no picture.
RenderLight make_render_light(const Light& light, int bands, int background_width = 2048, int threads = 0);

// Half floats hold 6e-5 to 65504 at full precision, so lights are drawn in a unit near their mean, whatever they are
// measured in: multiplied by `unit`, a power of two, which takes off no digit. `exposure` is auto_exposure().
struct LightScale {
  double exposure = 1;
  double unit = 1;
};
LightScale light_scale(const RgbCoefficients& radiance);

// `factor` times each coefficient.
RgbCoefficients scaled(double factor, RgbCoefficients coefficients);

// The coefficients of degree l alone; zeros elsewhere.
RgbCoefficients keep_degree(RgbCoefficients coefficients, int l);

}  // namespace shlight
