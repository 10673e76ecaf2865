#pragma once

// What the tests of render/ share.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "shlight/core/error.h"
#include "shlight/render/context.h"
#include "shlight/scene/shapes_test_util.h"
#include "shlight/sh/basis.h"
#include "shlight/sh/coefficients.h"

namespace shlight {

// A test that draws. Skipped, visibly, where no context can be made.
class GlTest : public testing::Test {
 protected:
  void SetUp() override {
    try {
      context_.emplace();
    } catch (const Error& error) {
      GTEST_SKIP() << error.what();
    }
  }

  std::optional<HeadlessContext> context_;
};

// Directions on a spiral, which are nowhere dense and hit no symmetry.
inline Vec3d spiral_direction(int i, int count) {
  const double y = 1 - (2 * i + 1.0) / count;
  const double azimuth = i * std::numbers::pi * (3 - std::sqrt(5.0));
  const double r = std::sqrt(1 - y * y);
  return {r * std::cos(azimuth), y, r * std::sin(azimuth)};
}

// Coefficients of a delta light from `direction`.
inline RgbCoefficients delta_light(int bands, Vec3d direction, Rgb color = {1, 1, 1}) {
  RgbCoefficients light(bands);
  add_delta(direction, color, light);
  return light;
}

// Coefficients of a light that is `color` from everywhere.
inline RgbCoefficients constant_light(int bands, Rgb color) {
  RgbCoefficients light(bands);
  light[0] = std::sqrt(4 * std::numbers::pi) * color;
  return light;
}

}  // namespace shlight
