#include "shlight/truth/accumulate_paths.h"

#include "shlight/core/assert.h"

namespace shlight {

void accumulate_paths(const PathTraceResult& more, PathTraceResult& sum) {
  if (sum.samples == 0) {
    sum = more;
    return;
  }
  SHLIGHT_ASSERT_EQ(sum.radiance.values.size(), more.radiance.values.size());
  const double share = static_cast<double>(more.samples) / (sum.samples + more.samples);
  for (std::size_t i = 0; i < sum.radiance.values.size(); ++i) {
    float &mean = sum.radiance.values[i], &variance = sum.variance.values[i];
    mean = static_cast<float>((1 - share) * mean + share * more.radiance.values[i]);
    variance = static_cast<float>((1 - share) * (1 - share) * variance + share * share * more.variance.values[i]);
  }
  sum.samples += more.samples;
  sum.rays += more.rays;
  sum.seconds += more.seconds;
}

}  // namespace shlight
