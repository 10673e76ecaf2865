#include "shlight/scene/balloon.h"

#include <gtest/gtest.h>

#include <cmath>

namespace shlight {
namespace {

double length(Vec3f v) {
  return std::sqrt(double{dot(v, v)});
}

// The first band's function of y is a figure of eight along Y: |y|, magenta below.
TEST(Balloon, IsAsFarAwayAsTheFunctionIsLarge) {
  RgbCoefficients radiance(2);
  radiance.at(1, -1) = {3, 2, 1};  // y
  const Scene scene = make_balloon(radiance);
  const Mesh& mesh = scene.meshes[0];
  ASSERT_EQ(mesh.colors.size(), mesh.positions.size());
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const Vec3f p = mesh.positions[i];
    const double r = length(p), y = p.y / r;
    EXPECT_NEAR(r, std::max(std::abs(y), 0.01), 1e-4);
    if (y > 0.1) {
      EXPECT_NEAR(mesh.colors[i].y / mesh.colors[i].x, 2.0 / 3, 1e-4) << "the light's own hue";
    } else if (y < -0.1) {
      EXPECT_LT(mesh.colors[i].y, 0.1) << "negative light is magenta";
    }
    EXPECT_NEAR(length(mesh.normals[i]), 1, 1e-5);
  }
}

TEST(Balloon, OfAConstantIsASphereWhoseNormalsLeaveIt) {
  RgbCoefficients radiance(3);
  radiance[0] = {1, 1, 1};
  const Mesh mesh = make_balloon(radiance).meshes[0];
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    EXPECT_NEAR(length(mesh.positions[i]), 1, 1e-5);
    EXPECT_GT(dot(mesh.positions[i], mesh.normals[i]), 0.99f);
  }
}

TEST(Balloon, OfNothingIsASmallBall) {
  const Mesh mesh = make_balloon(RgbCoefficients(4)).meshes[0];
  for (const Vec3f& p : mesh.positions) EXPECT_NEAR(length(p), 0.01, 1e-6);
}

}  // namespace
}  // namespace shlight
