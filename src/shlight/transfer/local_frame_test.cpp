#include "shlight/transfer/local_frame.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "shlight/sh/sphere_samples.h"

namespace shlight {
namespace {

std::vector<Vec3d> normals_with_poles() {
  std::vector<Vec3d> normals = make_sphere_samples(0, 5, 2).directions;
  normals.insert(normals.end(), {{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {0, -1, 0}, {1e-9, 0, 1}});
  return normals;
}

TEST(LocalFrame, IsARotationThatTakesZToTheNormal) {
  for (const Vec3d& n : normals_with_poles()) {
    const LocalFrame f = make_local_frame(n, 0.7);
    EXPECT_TRUE(is_rotation(inverse(Rotation{{f.x, f.y, f.z}}), 1e-12)) << n.x << " " << n.y << " " << n.z;
    EXPECT_EQ(f.z, n);
  }
}

TEST(LocalFrame, QuickRotationIsTheMatrix) {
  for (const int bands : {1, 2, 5, 10, 16}) {
    RgbCoefficients values(bands);
    for (std::size_t i = 0; i < values.size(); ++i) values[i].r = std::sin(1.0 + 3 * static_cast<double>(i));
    const FrameRotation rotation(bands);
    for (const Vec3d& n : normals_with_poles()) {
      const LocalFrame f = make_local_frame(n, 2.1);
      const RgbCoefficients expected = rotate(inverse(Rotation{{f.x, f.y, f.z}}), values);
      std::vector<double> turned;
      for (const Rgb& v : values.values()) turned.push_back(v.r);
      rotation.to_world(f, turned);
      for (std::size_t i = 0; i < turned.size(); ++i) ASSERT_NEAR(turned[i], expected[i].r, 1e-12) << bands << " bands";
    }
  }
}

}  // namespace
}  // namespace shlight
