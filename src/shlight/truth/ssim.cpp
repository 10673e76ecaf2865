#include "shlight/truth/ssim.h"

#include "shlight/core/assert.h"

namespace shlight {
namespace {

constexpr int kRadius = 5;
constexpr double kSigma = 1.5;

Plane product(const Plane& a, const Plane& b) {
  Plane result = a;
  for (std::size_t i = 0; i < result.values.size(); ++i) result.values[i] *= b.values[i];
  return result;
}

}  // namespace

Plane ssim_map(const Plane& a, const Plane& b, int threads) {
  SHLIGHT_ASSERT_EQ(a.width, b.width);
  SHLIGHT_ASSERT_EQ(a.height, b.height);
  constexpr double kC1 = 0.01 * 0.01, kC2 = 0.03 * 0.03;
  const std::vector<double> window = make_gaussian(kSigma, kRadius);
  const auto windowed = [&](const Plane& plane) { return filter_separably(plane, window, window, threads); };
  const Plane mean_a = windowed(a), mean_b = windowed(b);
  const Plane mean_aa = windowed(product(a, a)), mean_bb = windowed(product(b, b)), mean_ab = windowed(product(a, b));

  Plane map(a.width, a.height);
  for (std::size_t i = 0; i < map.values.size(); ++i) {
    const double ma = mean_a.values[i], mb = mean_b.values[i];
    const double variances = mean_aa.values[i] - ma * ma + mean_bb.values[i] - mb * mb;
    const double covariance = mean_ab.values[i] - ma * mb;
    map.values[i] = static_cast<float>((2 * ma * mb + kC1) * (2 * covariance + kC2) /
                                       ((ma * ma + mb * mb + kC1) * (variances + kC2)));
  }
  return map;
}

double mean_ssim(const Plane& map) {
  const int border = map.width > 2 * kRadius && map.height > 2 * kRadius ? kRadius : 0;
  double sum = 0;
  for (int y = border; y < map.height - border; ++y)
    for (int x = border; x < map.width - border; ++x) sum += double{map.at(x, y)};
  return sum / (static_cast<double>(map.width - 2 * border) * (map.height - 2 * border));
}

}  // namespace shlight
