#include "shlight/transfer/quantise.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "shlight/core/assert.h"

namespace shlight {
namespace {

constexpr int largest(int bits) {
  return (1 << (bits - 1)) - 1;
}

}  // namespace

std::vector<float> quantisation_scales(const Transfer& transfer) {
  const auto row = static_cast<std::size_t>(transfer.channels * num_coefficients(transfer.bands));
  std::vector<float> scales(row);
  for (std::size_t k = 0; k < transfer.coefficients.size(); ++k)
    scales[k % row] = std::max(scales[k % row], std::abs(transfer.coefficients[k]));
  return scales;
}

int quantise(float value, float scale, int bits) {
  SHLIGHT_ASSERT_LE(std::abs(value), scale);
  if (scale == 0) return 0;
  return static_cast<int>(std::lround(double{value} / double{scale} * largest(bits)));
}

float dequantise(int number, float scale, int bits) {
  return static_cast<float>(double{scale} * number / largest(bits));
}

Transfer quantise_transfer(Transfer transfer, int bits) {
  if (bits == 32) return transfer;
  const std::vector<float> scales = quantisation_scales(transfer);
  for (std::size_t k = 0; k < transfer.coefficients.size(); ++k) {
    float& a = transfer.coefficients[k];
    const float scale = scales[k % scales.size()];
    a = dequantise(quantise(a, scale, bits), scale, bits);
  }
  return transfer;
}

ShadingError measure_shading_error(const Transfer& a, const Transfer& b, const RgbCoefficients& any_bands) {
  SHLIGHT_ASSERT_EQ(a.coefficients.size(), b.coefficients.size());
  SHLIGHT_ASSERT_EQ(a.bands, b.bands);
  const auto n = static_cast<std::size_t>(num_coefficients(a.bands));
  const auto channels = static_cast<std::size_t>(a.channels);
  double sum = 0, sum_of_squares = 0, largest_difference = 0;
  const RgbCoefficients light = resize_bands(any_bands, a.bands);
  for (std::size_t v = 0; v < a.num_vertices(); ++v)
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t first = (v * channels + std::min(c, channels - 1)) * n;
      double radiance = 0, difference = 0;
      for (std::size_t i = 0; i < n; ++i) {
        const double l = std::array{light[i].r, light[i].g, light[i].b}[c];
        radiance += l * a.coefficients[first + i];
        difference += l * (double{b.coefficients[first + i]} - double{a.coefficients[first + i]});
      }
      sum += radiance * radiance;
      sum_of_squares += difference * difference;
      largest_difference = std::max(largest_difference, std::abs(difference));
    }
  if (sum == 0) return {};
  const double count = 3.0 * static_cast<double>(a.num_vertices());
  return {std::sqrt(sum_of_squares / sum), largest_difference / std::sqrt(sum / count)};
}

}  // namespace shlight
