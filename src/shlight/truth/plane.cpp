#include "shlight/truth/plane.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "shlight/core/assert.h"
#include "shlight/core/parallel.h"

namespace shlight {
namespace {

// sums[x] += factor · row[x].
void add_scaled(double factor, const float* row, std::span<double> sums) {
  for (std::size_t x = 0; x < sums.size(); ++x) sums[x] += factor * double{row[x]};
}

void store(std::span<const double> sums, float* row) {
  std::ranges::transform(sums, row, [](double v) { return static_cast<float>(v); });
}

}  // namespace

double mean(const Plane& plane) {
  if (plane.values.empty()) return 0;
  return std::accumulate(plane.values.begin(), plane.values.end(), 0.0) / static_cast<double>(plane.values.size());
}

Plane filter_separably(const Plane& plane, std::span<const double> along_x, std::span<const double> along_y,
                       int threads) {
  SHLIGHT_ASSERT_EQ(along_x.size() % 2, 1u);
  SHLIGHT_ASSERT_EQ(along_y.size() % 2, 1u);
  const std::size_t width = static_cast<std::size_t>(plane.width), radius_x = along_x.size() / 2;
  const int radius_y = static_cast<int>(along_y.size() / 2);
  Plane rows(plane.width, plane.height), result(plane.width, plane.height);
  parallel_for(static_cast<std::size_t>(plane.height), threads, [&](std::size_t y) {
    // The row with its ends drawn out, so that the loop below has no ifs.
    const float* row = plane.values.data() + y * width;
    std::vector<float> padded(width + 2 * radius_x);
    for (std::size_t x = 0; x < padded.size(); ++x)
      padded[x] = row[std::min(std::max(x, radius_x) - radius_x, width - 1)];
    std::vector<double> sums(width);
    for (std::size_t i = 0; i < along_x.size(); ++i) add_scaled(along_x[i], padded.data() + i, sums);
    store(sums, rows.values.data() + y * width);
  });
  parallel_for(static_cast<std::size_t>(plane.height), threads, [&](std::size_t y) {
    std::vector<double> sums(width);
    for (std::size_t j = 0; j < along_y.size(); ++j) {
      const int from = std::clamp(static_cast<int>(y + j) - radius_y, 0, plane.height - 1);
      add_scaled(along_y[j], rows.values.data() + static_cast<std::size_t>(from) * width, sums);
    }
    store(sums, result.values.data() + y * width);
  });
  return result;
}

std::vector<double> make_gaussian(double sigma, int radius) {
  std::vector<double> kernel;
  for (int x = -radius; x <= radius; ++x) kernel.push_back(std::exp(-0.5 * x * x / (sigma * sigma)));
  const double sum = std::accumulate(kernel.begin(), kernel.end(), 0.0);
  for (double& k : kernel) k /= sum;
  return kernel;
}

}  // namespace shlight
