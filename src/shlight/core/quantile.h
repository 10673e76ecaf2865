#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "shlight/core/assert.h"

namespace shlight {

// The value with the rank nearest to `q` between the smallest (0) and the largest (1), the higher rank where two are as
// near. It is always one of `values`, of which there must be some.
inline double quantile(std::vector<double> values, double q) {
  SHLIGHT_ASSERT_LT(0u, values.size());
  SHLIGHT_ASSERT_GE(q, 0);
  SHLIGHT_ASSERT_LE(q, 1);
  const auto at = values.begin() + std::lround(q * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

inline double median(std::vector<double> values) {
  return quantile(std::move(values), 0.5);
}

}  // namespace shlight
