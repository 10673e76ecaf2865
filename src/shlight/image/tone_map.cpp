#include "shlight/image/tone_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace shlight {
namespace {

// As in tone_map.frag.
constexpr double kMiddle = 0.18;   // stays where it is
constexpr double kContrast = 1.4;  // the curve's exponent
constexpr double kMix = 0.24;      // how far each channel goes toward the mean of all three
constexpr double kWhite = 1e6;     // far in the white: keeps infinity out of the curve

// fmax takes the number where the other is NaN.
double limited(double value) {
  return std::fmin(std::fmax(value, 0.0), kWhite);
}

double curve(double mixed) {
  const double power = std::pow(mixed / kMiddle, kContrast);
  return power / (power + (1 - kMiddle) / kMiddle);
}

unsigned char to_byte(double linear) {
  return static_cast<unsigned char>(std::lround(255 * encode_srgb(linear)));
}

}  // namespace

double encode_srgb(double linear) {
  return linear < 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

double decode_srgb(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

Rgb tone_map(Rgb radiance) {
  const std::array<double, 3> in = {limited(radiance.r), limited(radiance.g), limited(radiance.b)};
  const double mean = (in[0] + in[1] + in[2]) / 3;
  std::array<double, 3> out;
  for (std::size_t c = 0; c < 3; ++c) out[c] = curve((1 - kMix) * in[c] + kMix * mean);
  const double mean_out = (out[0] + out[1] + out[2]) / 3;
  for (double& v : out) v = std::clamp((v - kMix * mean_out) / (1 - kMix), 0.0, 1.0);
  return {out[0], out[1], out[2]};
}

Rgb tone_map(Rgb radiance, ToneCurve tone_curve) {
  if (tone_curve == ToneCurve::kFilmic) return tone_map(radiance);
  const auto cut = [](double value) { return std::min(limited(value), 1.0); };
  return {cut(radiance.r), cut(radiance.g), cut(radiance.b)};
}

Image8 make_picture8(const Image& radiance, double exposure, ToneCurve tone_curve) {
  Image8 picture{radiance.width, radiance.height, {}};
  picture.values.reserve(4 * radiance.num_pixels());
  for (int y = 0; y < radiance.height; ++y)
    for (int x = 0; x < radiance.width; ++x) {
      const Rgb shown = tone_map(exposure * radiance.rgb(x, y), tone_curve);
      picture.values.insert(picture.values.end(), {to_byte(shown.r), to_byte(shown.g), to_byte(shown.b), 255});
    }
  return picture;
}

double auto_exposure(const RgbCoefficients& radiance) {
  constexpr double kExposedMean = 2 * kMiddle;
  if (radiance.size() == 0) return 1;
  const double mean = luminance(radiance[0]) / std::sqrt(4 * std::numbers::pi);
  const double exposure = kExposedMean / mean;
  return mean > 0 && std::isfinite(exposure) ? exposure : 1;
}

}  // namespace shlight
