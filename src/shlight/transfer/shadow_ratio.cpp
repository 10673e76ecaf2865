#include "shlight/transfer/shadow_ratio.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "shlight/core/assert.h"
#include "shlight/core/parallel.h"

namespace shlight {
namespace {

// Light from other surfaces can outshine what comes straight from a dark side.
constexpr double kLargest = 4;
// What counts as next to nothing, of the light's mean radiance.
constexpr double kNothing = 0.01;
constexpr std::size_t kVerticesATask = 4096;

double clamped_ratio(double shadowed, double open, double mean) {
  const double nothing = kNothing * std::max(mean, 0.0);
  const double below = std::max(open, 0.0) + nothing;
  return below > 0 ? std::min((std::max(shadowed, 0.0) + nothing) / below, kLargest) : 1;
}

// Σ L_i A_i of a vertex over the first coefficients of the light.
Rgb sum_transfer(const Transfer& transfer, std::size_t vertex, const RgbCoefficients& light) {
  const auto stride = static_cast<std::size_t>(num_coefficients(transfer.bands));
  const auto channels = static_cast<std::size_t>(transfer.channels);
  const float* const red = transfer.coefficients.data() + vertex * channels * stride;
  const float* const green = channels == 3 ? red + stride : red;
  const float* const blue = channels == 3 ? green + stride : red;
  Rgb sum = {};
  for (std::size_t i = 0; i < light.size(); ++i)
    sum = sum + Rgb{light[i].r * double{red[i]}, light[i].g * double{green[i]}, light[i].b * double{blue[i]}};
  return sum;
}

Transfer bake_open(const Scene& scene, int bands) {
  BakeParams params;
  params.kind = TransferKind::kCosine;
  params.bands = bands;
  return bake_transfer(scene, params);
}

}  // namespace

ShadowRatio::ShadowRatio(const Scene& scene, Transfer transfer)
    : transfer_(std::move(transfer)), open_(bake_open(scene, transfer_.bands)) {
  SHLIGHT_ASSERT_EQ(transfer_.num_vertices(), open_.num_vertices());
}

std::vector<Vec3f> ShadowRatio::under(const RgbCoefficients& light, int threads) const {
  const RgbCoefficients used = resize_bands(light, std::min(light.bands(), transfer_.bands));
  const Rgb mean = 1 / std::sqrt(4 * std::numbers::pi) * used[0];
  std::vector<Vec3f> ratios(transfer_.num_vertices());
  parallel_for((ratios.size() + kVerticesATask - 1) / kVerticesATask, threads, [&](std::size_t task) {
    const std::size_t end = std::min((task + 1) * kVerticesATask, ratios.size());
    for (std::size_t v = task * kVerticesATask; v < end; ++v) {
      const Rgb shadowed = sum_transfer(transfer_, v, used), open = sum_transfer(open_, v, used);
      ratios[v] = {static_cast<float>(clamped_ratio(shadowed.r, open.r, mean.r)),
                   static_cast<float>(clamped_ratio(shadowed.g, open.g, mean.g)),
                   static_cast<float>(clamped_ratio(shadowed.b, open.b, mean.b))};
    }
  });
  return ratios;
}

}  // namespace shlight
