#include "shlight/truth/light_sampler.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "shlight/core/parallel.h"

namespace shlight {
namespace {

constexpr int kPictureWidth = 1024;

// Turns weights[1 …] into sums of what is before them over the sum of all; evenly spread where they are all 0.
// weights[0] is 0 before and after. Returns the sum.
double accumulate(std::span<float> weights) {
  double sum = 0;
  for (const float w : weights.subspan(1)) sum += double{w};
  const double count = static_cast<double>(weights.size() - 1);
  double before = 0;
  for (std::size_t i = 1; i < weights.size(); ++i) {
    before += double{weights[i]};
    weights[i] = static_cast<float>(sum > 0 ? before / sum : static_cast<double>(i) / count);
  }
  weights.back() = 1;
  return sum;
}

// The index i with sums[i] <= u < sums[i + 1], and how far u is between the two.
struct Place {
  std::size_t index = 0;
  double fraction = 0;
};
Place find(std::span<const float> sums, double u) {
  const auto above = std::upper_bound(sums.begin() + 1, sums.end() - 1, u,
                                      [](double value, float sum) { return value < double{sum}; });
  const double from = double{above[-1]}, to = double{above[0]};
  return {static_cast<std::size_t>(above - sums.begin()) - 1, std::clamp((u - from) / (to - from), 0.0, 1.0)};
}

}  // namespace

LightSampler::LightSampler(const Light& light, int threads) {
  const Image picture = light.lat_long(kPictureWidth, threads);
  width_ = picture.width, height_ = picture.height;
  const std::size_t stride = static_cast<std::size_t>(width_) + 1;
  columns_.resize(stride * static_cast<std::size_t>(height_));
  rows_.resize(static_cast<std::size_t>(height_) + 1);
  std::vector<double> sums(static_cast<std::size_t>(height_));
  double total = 0;
  parallel_for(sums.size(), threads, [&](std::size_t row) {
    const int y = static_cast<int>(row);
    const std::span<float> weights = std::span(columns_).subspan(stride * row, stride);
    for (int x = 0; x < width_; ++x) {
      const Rgb c = picture.rgb(x, y);
      weights[static_cast<std::size_t>(x) + 1] =
          static_cast<float>((std::abs(c.r) + std::abs(c.g) + std::abs(c.b)) / 3);
    }
    sums[row] = accumulate(weights) * solid_angle(y);
  });
  for (const double sum : sums) total += sum;
  // A row of a black light has the share of its solid angle.
  for (std::size_t row = 0; row < sums.size(); ++row)
    rows_[row + 1] = static_cast<float>(total > 0 ? sums[row] / total : solid_angle(static_cast<int>(row)));
  accumulate(rows_);
}

double LightSampler::solid_angle(int y) const {
  const double top = std::cos(std::numbers::pi * y / height_), bottom = std::cos(std::numbers::pi * (y + 1) / height_);
  return 2 * std::numbers::pi / width_ * (top - bottom);
}

double LightSampler::probability(int x, int y) const {
  const float* row = columns_.data() + (static_cast<std::size_t>(width_) + 1) * static_cast<std::size_t>(y) + x;
  return (double{rows_[static_cast<std::size_t>(y) + 1]} - double{rows_[static_cast<std::size_t>(y)]}) *
         (double{row[1]} - double{row[0]});
}

LightSampler::Sample LightSampler::sample(double u, double v) const {
  const Place row = find(rows_, v);
  const std::size_t stride = static_cast<std::size_t>(width_) + 1;
  const Place column = find(std::span(columns_).subspan(stride * row.index, stride), u);
  const int x = static_cast<int>(column.index), y = static_cast<int>(row.index);
  // Uniform in the pixel's solid angle: in the azimuth and in the height above the horizon.
  const double azimuth = 2 * std::numbers::pi * ((x + column.fraction) / width_ - 0.5);
  const double height =
      std::lerp(std::cos(std::numbers::pi * y / height_), std::cos(std::numbers::pi * (y + 1) / height_), row.fraction);
  const double radius = std::sqrt(std::max(0.0, 1 - height * height));
  return {{radius * std::sin(azimuth), height, -radius * std::cos(azimuth)}, probability(x, y) / solid_angle(y)};
}

double LightSampler::pdf(Vec3d direction) const {
  const ImagePoint p = point_of(Layout::kLatLong, direction);
  const int x = std::clamp(static_cast<int>(p.u * width_), 0, width_ - 1);
  const int y = std::clamp(static_cast<int>(p.v * height_), 0, height_ - 1);
  return probability(x, y) / solid_angle(y);
}

}  // namespace shlight
