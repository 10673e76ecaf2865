#include "navigation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace shlight::viewer {
namespace {

// What lies behind the model, before the camera, goes where the pointer goes, from wherever one looks.
TEST(Navigation, TheLightBehindTheModelFollowsThePointer) {
  for (const double azimuth : {0.0, 50.0, 170.0}) {
    Settings s;
    s.camera.azimuth = azimuth, s.camera.elevation = 0;
    const double a = azimuth * std::numbers::pi / 180;
    const Vec3d ahead = {-std::sin(a), 0, -std::cos(a)}, right = {std::cos(a), 0, -std::sin(a)};
    turn_light(s, 0.1, 0);
    EXPECT_GT(dot(s.rotate_light(ahead), right), 0.2) << azimuth;
    s.rotate_light = {};
    turn_light(s, 0, 0.1);
    EXPECT_GT(s.rotate_light(ahead).y, 0.2) << azimuth;
    EXPECT_TRUE(is_rotation(s.rotate_light));
  }
}

TEST(Navigation, StaysWithinWhatRenderTakes) {
  Settings s;
  for (int i = 0; i < 500; ++i) {
    orbit(s, 0.31, -0.5);
    zoom(s, 10);
    pan(s, {}, 1.5, 0.4, 5);
    EXPECT_LE(std::abs(s.camera.elevation), 90);
    EXPECT_LE(std::abs(s.camera.azimuth), 180);
    EXPECT_LE(s.camera.zoom, 100);
    EXPECT_LE(std::abs(s.camera.target.y), 100);
  }
}

}  // namespace
}  // namespace shlight::viewer
