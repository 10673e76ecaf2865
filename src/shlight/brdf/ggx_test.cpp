#include "shlight/brdf/ggx.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "shlight/brdf/brdf_test_util.h"
#include "shlight/brdf/metallic_roughness.h"
#include "shlight/brdf/project_brdf.h"

namespace shlight {
namespace {

using std::numbers::pi;

TEST(Ggx, IsItsFormula) {
  const double ax = 0.2, ay = 0.6;
  const auto brdf = make_ggx({ax, ay, {1, 1, 1}, {}});
  const auto lambda = [&](Vec3d d) {
    return 0.5 * (std::sqrt(1 + (ax * ax * d.x * d.x + ay * ay * d.y * d.y) / (d.z * d.z)) - 1);
  };
  for (const double degrees : {0.0, 45.0, 85.0})
    for (const double azimuth : {0.0, 100.0, 180.0}) {
      const Vec3d s = direction_at(60, 20), v = direction_at(degrees, azimuth), sum = s + v;
      const Vec3d h = 1 / std::sqrt(dot(sum, sum)) * sum;
      const double slopes = std::pow(h.x / (h.z * ax), 2) + std::pow(h.y / (h.z * ay), 2);
      const double d = 1 / (pi * ax * ay * std::pow(h.z, 4) * std::pow(1 + slopes, 2));
      const double expected = d / (1 + lambda(s) + lambda(v)) / (4 * s.z * v.z);
      EXPECT_NEAR(brdf->eval(s, v).g, expected, 1e-12 * expected) << degrees << ", " << azimuth;
    }
}

// Swapped axes are a quarter of a turn; equal ones have none.
TEST(Ggx, AxesTurn) {
  const auto a = make_ggx({0.1, 0.5, {1, 1, 1}, {}}), b = make_ggx({0.5, 0.1, {1, 1, 1}, {}});
  const auto round = make_ggx({0.3, 0.3, {1, 1, 1}, {}});
  EXPECT_EQ(a->traits().symmetry, BrdfSymmetry::kMirrored);
  EXPECT_EQ(round->traits().symmetry, BrdfSymmetry::kIsotropic);
  const double here = a->eval(direction_at(50, 0), direction_at(40, 150)).g;
  EXPECT_NEAR(b->eval(direction_at(50, 90), direction_at(40, 240)).g, here, 1e-12 * here);
  EXPECT_NEAR(round->eval(direction_at(50, 33), direction_at(40, 183)).g,
              round->eval(direction_at(50, 0), direction_at(40, 150)).g, 1e-13);
}

TEST(MetallicRoughness, IsGgx) {
  const Rgb base = {0.9, 0.5, 0.1};
  const Vec3d s = direction_at(50, 0), v = direction_at(40, 150);
  EXPECT_EQ(make_metallic_roughness(base, 1, 0.5)->eval(s, v), make_ggx({0.25, 0.25, base, {}})->eval(s, v));
  // A black dielectric has only its highlight, of 4 % at normal incidence.
  EXPECT_EQ(make_metallic_roughness({}, 0, 0.5)->eval(s, v), make_ggx({0.25, 0.25, {.04, .04, .04}, {}})->eval(s, v));
  // Beside the highlight is 96 % of the diffuse part, and a little less where facets graze.
  const auto dielectric = make_metallic_roughness({1, 1, 1}, 0, 0.05);
  const Vec3d near = direction_at(10, 0), far = direction_at(30, 90);
  const Vec3d sum = near + far;
  const double vh = 0.5 * std::sqrt(dot(sum, sum));
  EXPECT_NEAR(dielectric->eval(near, far).g, 0.96 * (1 - std::pow(1 - vh, 5)) / pi, 1e-4);
}

}  // namespace
}  // namespace shlight
