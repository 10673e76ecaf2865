#include "shlight/truth/light_sampler.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "shlight/core/parallel.h"

namespace shlight {
namespace {

constexpr int kPictureWidth = 1024;

// Pixels with more than this share of the light are parted, where the light is not constant within them.
constexpr double kPartedShare = 1e-3;
constexpr int kParts = 32;  // a side
// The share of a parted pixel that is spread evenly, for what is seen neither at parts' corners nor in their middles.
constexpr double kEvenShare = 0.02;

double brightness(Rgb c) {
  return (std::abs(c.r) + std::abs(c.g) + std::abs(c.b)) / 3;
}

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

// How much denser than evenly one of the parts is sampled.
double part_density(std::span<const float> sums, std::size_t i) {
  return kParts * (double{sums[i + 1]} - double{sums[i]});
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

  const auto* image = dynamic_cast<const ImageLight*>(&light);
  if (total == 0 || (image && image->environment().layout == Layout::kLatLong)) return;
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x)
      if (probability(x, y) > kPartedShare)
        parted_.push_back(
            part(light, static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x),
                 brightness(picture.rgb(x, y))));
}

LightSampler::Parted LightSampler::part(const Light& light, std::size_t pixel, double mean) const {
  const double left = static_cast<double>(pixel % static_cast<std::size_t>(width_));
  const double top = static_cast<double>(pixel / static_cast<std::size_t>(width_));
  Parted parted{pixel, std::vector<float>(kParts + 1), std::vector<float>((kParts + 1) * kParts)};
  // What an edge cuts through is to be sampled as densely as what lies within it: a part counts as the brightest of its
  // corners and its middle.
  const auto at = [&](double x, double y) {
    return brightness(
        light.radiance(direction(left + x / kParts, std::min(top + y / kParts, std::nextafter(top + 1, 0)))));
  };
  std::vector<double> corners((kParts + 1) * (kParts + 1));
  for (std::size_t k = 0; k < corners.size(); ++k)
    corners[k] = at(static_cast<double>(k % (kParts + 1)), static_cast<double>(k / (kParts + 1)));
  for (std::size_t j = 0; j < kParts; ++j) {
    const std::span<float> weights = std::span(parted.columns).subspan((kParts + 1) * j, kParts + 1);
    for (std::size_t i = 0; i < kParts; ++i) {
      const double* corner = corners.data() + (kParts + 1) * j + i;
      const double brightest = std::max({corner[0], corner[1], corner[kParts + 1], corner[kParts + 2],
                                         at(static_cast<double>(i) + 0.5, static_cast<double>(j) + 0.5)});
      weights[i + 1] = static_cast<float>(brightest + kEvenShare * mean);
    }
    parted.rows[j + 1] = static_cast<float>(accumulate(weights));
  }
  accumulate(parted.rows);
  return parted;
}

const LightSampler::Parted* LightSampler::find_parted(std::size_t pixel) const {
  const auto found = std::ranges::lower_bound(parted_, pixel, {}, &Parted::pixel);
  return found != parted_.end() && found->pixel == pixel ? &*found : nullptr;
}

Vec3d LightSampler::direction(double x, double y) const {
  // Uniform in a pixel's solid angle: in the azimuth and in the height above the horizon.
  const double row = std::min(std::floor(y), height_ - 1.0);
  const double azimuth = 2 * std::numbers::pi * (x / width_ - 0.5);
  const double height =
      std::lerp(std::cos(std::numbers::pi * row / height_), std::cos(std::numbers::pi * (row + 1) / height_), y - row);
  const double radius = std::sqrt(std::max(0.0, 1 - height * height));
  return {radius * std::sin(azimuth), height, -radius * std::cos(azimuth)};
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
  Place row = find(rows_, v);
  const std::size_t stride = static_cast<std::size_t>(width_) + 1;
  Place column = find(std::span(columns_).subspan(stride * row.index, stride), u);
  const int x = static_cast<int>(column.index), y = static_cast<int>(row.index);
  double pdf = probability(x, y) / solid_angle(y);
  if (const Parted* parted = find_parted(row.index * static_cast<std::size_t>(width_) + column.index)) {
    // What is left of both numbers chooses a part.
    row = find(parted->rows, row.fraction);
    const auto of_row = std::span(parted->columns).subspan((kParts + 1) * row.index, kParts + 1);
    column = find(of_row, column.fraction);
    pdf *= part_density(parted->rows, row.index) * part_density(of_row, column.index);
    row.fraction = (static_cast<double>(row.index) + row.fraction) / kParts;
    column.fraction = (static_cast<double>(column.index) + column.fraction) / kParts;
  }
  return {direction(x + column.fraction, y + row.fraction), pdf};
}

double LightSampler::pdf(Vec3d direction) const {
  const ImagePoint p = point_of(Layout::kLatLong, direction);
  const int x = std::clamp(static_cast<int>(p.u * width_), 0, width_ - 1);
  const int y = std::clamp(static_cast<int>(p.v * height_), 0, height_ - 1);
  const double pdf = probability(x, y) / solid_angle(y);
  const Parted* parted =
      find_parted(static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x));
  if (!parted) return pdf;
  const double top = std::cos(std::numbers::pi * y / height_), bottom = std::cos(std::numbers::pi * (y + 1) / height_);
  const auto part_of = [](double fraction) {
    return static_cast<std::size_t>(std::clamp(static_cast<int>(fraction * kParts), 0, kParts - 1));
  };
  const std::size_t i = part_of(p.u * width_ - x), j = part_of((top - direction.y) / (top - bottom));
  return pdf * part_density(parted->rows, j) *
         part_density(std::span(parted->columns).subspan((kParts + 1) * j, kParts + 1), i);
}

}  // namespace shlight
