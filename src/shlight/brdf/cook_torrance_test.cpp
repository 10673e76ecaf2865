#include "shlight/brdf/cook_torrance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "shlight/brdf/brdf_test_util.h"
#include "shlight/brdf/project_brdf.h"

namespace shlight {
namespace {

using std::numbers::pi;

TEST(CookTorrance, IsItsFormula) {
  const double m = 0.4, f0 = 0.2;
  const auto brdf = make_cook_torrance(m, {f0, f0, f0});
  for (const double degrees : {10.0, 45.0, 85.0})
    for (const double azimuth : {0.0, 100.0, 180.0}) {
      const Vec3d s = direction_at(60, 0), v = direction_at(degrees, azimuth), sum = s + v;
      const Vec3d h = 1 / std::sqrt(dot(sum, sum)) * sum;
      const double nh = h.z, vh = dot(v, h), tan2 = 1 / (nh * nh) - 1;
      const double d = std::exp(-tan2 / (m * m)) / (pi * m * m * std::pow(nh, 4));
      const double g = std::min({1.0, 2 * nh * v.z / vh, 2 * nh * s.z / vh});
      const double f = f0 + (1 - f0) * std::pow(1 - vh, 5);
      const double expected = f * d * g / (4 * s.z * v.z);
      EXPECT_NEAR(brdf->eval(s, v).g, expected, 1e-12 * expected) << degrees << ", " << azimuth;
    }
}

// With the π of D and the 4 that the thesis leaves out, a perfect mirror that is nearly smooth reflects everything.
TEST(CookTorrance, NearlySmoothMirrorReflectsAll) {
  const auto brdf = make_cook_torrance(0.02, {1, 1, 1});
  for (const double degrees : {0.0, 30.0, 60.0}) {
    const BrdfProjection projection = project_brdf(*brdf, direction_at(degrees, 0), 1);
    EXPECT_NEAR(std::sqrt(4 * pi) * projection.coefficients[0].g, 1, 1e-5);
  }
}

// Fresnel's reflectance belongs to the facet: seen against the light at an angle of 2·75°, from wherever, it is that of
// 75°. Taken with n·v, as the thesis prints it, it would be another one.
TEST(CookTorrance, FresnelIsTheFacets) {
  const double m = 0.5, cosine = std::cos(75 * pi / 180), reflectance = 0.1 + 0.9 * std::pow(1 - cosine, 5);
  const auto brdf = make_cook_torrance(m, {0.1, 0.1, 0.1}), white = make_cook_torrance(m, {1, 1, 1});
  for (const auto& [a, b] : {std::pair{75.0, 75.0}, {65.0, 85.0}, {88.0, 62.0}}) {
    const Vec3d s = direction_at(a, 0), v = direction_at(b, 180);
    EXPECT_NEAR(brdf->eval(s, v).g, reflectance * white->eval(s, v).g, 1e-12);
  }
}

}  // namespace
}  // namespace shlight
