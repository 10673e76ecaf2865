#include "shlight/image/layout.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "shlight/sh/sphere_samples.h"

namespace shlight {
namespace {

using std::numbers::pi;

void expect_direction(Layout layout, double u, double v, Vec3d expected) {
  const auto d = direction_at(layout, {u, v});
  ASSERT_TRUE(d.has_value());
  EXPECT_NEAR(d->x, expected.x, 1e-12) << layout_name(layout) << " " << u << " " << v;
  EXPECT_NEAR(d->y, expected.y, 1e-12) << layout_name(layout) << " " << u << " " << v;
  EXPECT_NEAR(d->z, expected.z, 1e-12) << layout_name(layout) << " " << u << " " << v;
}

TEST(Layout, CentreIsForwardRightIsXTopIsY) {
  expect_direction(Layout::kLatLong, 0.5, 0.5, {0, 0, -1});
  expect_direction(Layout::kLatLong, 0.75, 0.5, {1, 0, 0});
  expect_direction(Layout::kLatLong, 0.25, 0.5, {-1, 0, 0});
  expect_direction(Layout::kLatLong, 0.3, 0, {0, 1, 0});
  expect_direction(Layout::kLatLong, 0, 0.5, {0, 0, 1});
  expect_direction(Layout::kAngularMap, 0.5, 0.5, {0, 0, -1});
  expect_direction(Layout::kAngularMap, 0.75, 0.5, {1, 0, 0});
  expect_direction(Layout::kAngularMap, 0.5, 0.25, {0, 1, 0});
  expect_direction(Layout::kAngularMap, 0, 0.5, {0, 0, 1});
  EXPECT_FALSE(direction_at(Layout::kAngularMap, {0.05, 0.05}).has_value());
}

TEST(Layout, PointsAndDirectionsAreInverse) {
  for (const Layout layout : all_layouts()) {
    for (const Vec3d d : make_sphere_samples(0, 20, 3).directions) {
      const ImagePoint point = point_of(layout, d);
      const auto back = direction_at(layout, point);
      ASSERT_TRUE(back.has_value());
      EXPECT_NEAR(dot(*back, d), 1, 1e-12);
      EXPECT_NEAR(back->x, d.x, 1e-9);
    }
    // Every direction has a point in the picture, the poles and the seam too.
    for (const Vec3d d : {Vec3d{0, 1, 0}, Vec3d{0, -1, 0}, Vec3d{0, 0, 1}, Vec3d{0, 0, -1}, Vec3d{-0.0, 0, 1}}) {
      const ImagePoint point = point_of(layout, d);
      EXPECT_GE(point.u, 0);
      EXPECT_LE(point.u, 1);
      EXPECT_GE(point.v, 0);
      EXPECT_LE(point.v, 1);
    }
  }
}

TEST(Layout, SolidAnglesAreWholeSpheres) {
  for (const Layout layout : all_layouts())
    for (const int size : {1, 2, 7, 64}) {
      const int width = layout == Layout::kLatLong ? 2 * size : size;
      double sum = 0;
      for (int y = 0; y < size; ++y)
        for (int x = 0; x < width; ++x) sum += pixel_solid_angle(layout, width, size, x, y);
      // A pixel that holds half of the circle's radius is more than the quadrature was made for; no real picture has
      // one.
      const double tolerance = size == 1 ? 1e-2 : size == 2 ? 1e-4 : 1e-7;
      EXPECT_NEAR(sum, 4 * pi, tolerance * 4 * pi) << layout_name(layout) << " of " << size;
    }
}

TEST(Layout, NodesOfAPixelHaveItsSolidAngle) {
  std::vector<WeightedDirection> nodes;
  for (const int height : {8, 64})
    for (const int y : {0, 1, height / 2, height - 1}) {
      pixel_nodes(Layout::kLatLong, 2 * height, height, 3, y, nodes);
      double sum = 0;
      for (const WeightedDirection& node : nodes) {
        EXPECT_EQ(static_cast<int>(point_of(Layout::kLatLong, node.direction).u * 2 * height), 3);
        sum += node.solid_angle;
      }
      const double closed_form = pixel_solid_angle(Layout::kLatLong, 2 * height, height, 3, y);
      EXPECT_NEAR(sum, closed_form, 1e-11 * closed_form);
    }
}

// Against brute force: the share of uniform directions that falls into a pixel.
TEST(Layout, SolidAngleOfAPixelOnTheCircle) {
  constexpr int kSize = 8;
  const auto samples = make_sphere_samples(0, 1200, 9);
  for (const auto& [x, y] : {std::pair{0, 2}, {1, 1}, {4, 0}, {3, 3}, {7, 4}}) {
    double count = 0;
    for (const Vec3d d : samples.directions) {
      const ImagePoint p = point_of(Layout::kAngularMap, d);
      count += static_cast<int>(p.u * kSize) == x && static_cast<int>(p.v * kSize) == y;
    }
    const double expected = 4 * pi * count / double(samples.directions.size());
    EXPECT_NEAR(pixel_solid_angle(Layout::kAngularMap, kSize, kSize, x, y), expected, 0.02 * expected + 1e-4)
        << x << " " << y;
  }
  EXPECT_EQ(pixel_solid_angle(Layout::kAngularMap, 64, 64, 0, 0), 0);
}

TEST(Layout, LookupsSeeThePixelThatCoversADirection) {
  for (const Layout layout : all_layouts()) {
    Environment environment{Image(layout == Layout::kLatLong ? 32 : 16, 16), layout};
    for (int y = 0; y < environment.image.height; ++y)
      for (int x = 0; x < environment.image.width; ++x) environment.image.set_rgb(x, y, {double(x), double(y), 1});
    for (int y = 0; y < environment.image.height; ++y)
      for (int x = 0; x < environment.image.width; ++x) {
        const auto d =
            direction_at(layout, {(x + 0.5) / environment.image.width, (y + 0.5) / environment.image.height});
        if (!d) continue;
        const Rgb nearest = eval_nearest(environment, *d), bilinear = eval_bilinear(environment, *d);
        EXPECT_EQ(nearest.r, x);
        EXPECT_EQ(nearest.g, y);
        EXPECT_NEAR(bilinear.r, x, 1e-6);
        EXPECT_NEAR(bilinear.g, y, 1e-6);
        EXPECT_NEAR(bilinear.b, 1, 1e-12);
      }
  }
}

// A linear function of the direction is smooth everywhere; a lookup that broke at the seam or a pole would show.
TEST(Layout, BilinearIsSmoothOverSeamAndPoles) {
  for (const Layout layout : all_layouts()) {
    const int size = 128;
    Environment environment{Image(layout == Layout::kLatLong ? 2 * size : size, size), layout};
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < environment.image.width; ++x) {
        const auto d = direction_at(layout, {(x + 0.5) / environment.image.width, (y + 0.5) / size});
        if (d) environment.image.set_rgb(x, y, {1 + d->x, 1 + d->y, 1 + d->z});
      }
    for (const Vec3d d : make_sphere_samples(0, 60, 4).directions) {
      const Rgb value = eval_bilinear(environment, d);
      EXPECT_NEAR(value.r, 1 + d.x, 0.03) << layout_name(layout);
      EXPECT_NEAR(value.g, 1 + d.y, 0.03) << layout_name(layout);
      EXPECT_NEAR(value.b, 1 + d.z, 0.03) << layout_name(layout);
    }
  }
}

TEST(Layout, NamesAreInverse) {
  for (const Layout layout : all_layouts()) EXPECT_EQ(layout_from_name(layout_name(layout)), layout);
  EXPECT_FALSE(layout_from_name("lat-lon").has_value());
  EXPECT_EQ(layout_from_shape(1024, 512), Layout::kLatLong);
  EXPECT_EQ(layout_from_shape(600, 600), Layout::kAngularMap);
  EXPECT_FALSE(layout_from_shape(1024, 500).has_value());
}

}  // namespace
}  // namespace shlight
