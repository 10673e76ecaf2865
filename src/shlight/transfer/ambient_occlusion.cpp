#include "shlight/transfer/ambient_occlusion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "shlight/core/assert.h"

namespace shlight {

float eval_ambient_occlusion(std::span<const float> shadowed) {
  SHLIGHT_ASSERT_GE(shadowed.size(), std::size_t{1});
  // What is sampled may miss the range by rounding.
  return std::clamp(static_cast<float>(std::sqrt(4 * std::numbers::pi) * double{shadowed[0]}), 0.0f, 1.0f);
}

Vec3f eval_bent_normal(std::span<const float> shadowed, Vec3f normal) {
  SHLIGHT_ASSERT_GE(shadowed.size(), std::size_t{4});
  // Coefficients 1, 2, 3 go with y, z, x.
  const Vec3f mean = {shadowed[3], shadowed[1], shadowed[2]};
  const float length = std::sqrt(dot(mean, mean));
  // What is open by less than a ray in many thousands is rounding.
  constexpr float kLeast = 1e-5f;
  return length > kLeast ? (1 / length) * mean : normal;
}

}  // namespace shlight
