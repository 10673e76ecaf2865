#include "shlight/image/clamp.h"

#include <algorithm>
#include <vector>

#include "shlight/core/assert.h"
#include "shlight/core/parallel.h"
#include "shlight/image/pixels.h"

namespace shlight {

double ClampReport::lost_share() const {
  const double all = luminance(total);
  return all > 0 ? std::clamp(luminance(lost) / all, 0.0, 1.0) : 0;
}

ClampReport clamp_radiance(Environment& environment, double max, int threads) {
  SHLIGHT_ASSERT_OP(max, >, 0);
  Image& image = environment.image;
  constexpr int kBands = 6;  // as pixel_solid_angle has it
  const PixelQuadrature pixels(environment.layout, environment.size(),
                               nodes_a_side_for(environment.layout, environment.size(), kBands));
  std::vector<ClampReport> rows(static_cast<std::size_t>(image.height));
  parallel_for(rows.size(), threads, [&](std::size_t row) {
    const int y = static_cast<int>(row);
    ClampReport& report = rows[row];
    for (int x = 0; x < image.width; ++x) {
      const double solid_angle = pixels.solid_angle({x, y});
      const Rgb before = image.rgb(x, y);
      const auto above = [&](double value) { return std::max(0.0, value - max); };
      const auto below = [](double value) { return std::max(0.0, -value); };
      const Rgb cut = {above(before.r), above(before.g), above(before.b)};
      const Rgb filled = {below(before.r), below(before.g), below(before.b)};
      report.total += solid_angle * before;
      report.lost += solid_angle * cut;
      report.gained += solid_angle * filled;
      if (std::max({cut.r, cut.g, cut.b}) > 0) ++report.above;
      if (std::max({filled.r, filled.g, filled.b}) > 0) ++report.negative;
      image.set_rgb(x, y, before - cut + filled);
    }
  });

  ClampReport sum;
  sum.max = max;
  for (const ClampReport& row : rows) {
    sum.total += row.total, sum.lost += row.lost, sum.gained += row.gained;
    sum.above += row.above, sum.negative += row.negative;
  }
  return sum;
}

}  // namespace shlight
