#include "shlight/brdf/blinn_phong.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "shlight/brdf/brdf_test_util.h"
#include "shlight/brdf/project_brdf.h"

namespace shlight {
namespace {

using std::numbers::pi;

TEST(BlinnPhong, ReflectsItsShareAtTheNormal) {
  for (const double n : {1.0, 2.0, 10.0, 300.0, 10000.0}) {
    const auto brdf = make_blinn_phong({0.1, 0.1, 0.1}, {0.6, 0.6, 0.6}, n);
    const double albedo = std::sqrt(4 * pi) * project_brdf(*brdf, {0, 0, 1}, 1).coefficients[0].g;
    EXPECT_NEAR(albedo, 0.7, 1e-6) << "exponent " << n;
  }
}

TEST(BlinnPhong, FallsAsThePower) {
  const auto brdf = make_blinn_phong({}, {1, 1, 1}, 20);
  const double top = brdf->eval({0, 0, 1}, {0, 0, 1}).g;
  EXPECT_NEAR(brdf->eval(direction_at(50, 0), direction_at(10, 0)).g, top * std::pow(std::cos(30 * pi / 180), 20),
              1e-12 * top);
}

}  // namespace
}  // namespace shlight
