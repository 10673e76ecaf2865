#include "shlight/image/layout.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "shlight/sh/sphere_samples.h"

namespace shlight {
namespace {

void expect_direction(Layout layout, double u, double v, Vec3d expected) {
  const auto d = direction_at(layout, {u, v});
  ASSERT_TRUE(d.has_value());
  EXPECT_NEAR(d->x, expected.x, 1e-12) << layout_name(layout) << " " << u << " " << v;
  EXPECT_NEAR(d->y, expected.y, 1e-12) << layout_name(layout) << " " << u << " " << v;
  EXPECT_NEAR(d->z, expected.z, 1e-12) << layout_name(layout) << " " << u << " " << v;
}

TEST(Layout, CentreIsForwardRightIsXTopIsY) {
  for (const Layout layout : {Layout::kLatLong, Layout::kOpenExrLatLong}) {
    expect_direction(layout, 0.5, 0.5, {0, 0, -1});
    expect_direction(layout, 0.75, 0.5, {1, 0, 0});
    expect_direction(layout, 0.25, 0.5, {-1, 0, 0});
    expect_direction(layout, 0.3, 0, {0, 1, 0});
    expect_direction(layout, 0, 0.5, {0, 0, 1});
  }
  const double r = std::sqrt(0.5);
  for (const auto& [layout, quarter] : {std::pair{Layout::kAngularMap, 0.25}, {Layout::kMirrorBall, r / 2}}) {
    expect_direction(layout, 0.5, 0.5, {0, 0, -1});
    expect_direction(layout, 0.5 + quarter, 0.5, {1, 0, 0});
    expect_direction(layout, 0.5 - quarter, 0.5, {-1, 0, 0});
    expect_direction(layout, 0.5, 0.5 - quarter, {0, 1, 0});
    expect_direction(layout, 0, 0.5, {0, 0, 1});
    EXPECT_FALSE(direction_at(layout, {0.05, 0.05}).has_value());
  }
  expect_direction(Layout::kOctahedral, 0.5, 0.5, {0, 0, -1});
  expect_direction(Layout::kOctahedral, 1, 0.5, {1, 0, 0});
  expect_direction(Layout::kOctahedral, 0.5, 0, {0, 1, 0});
  expect_direction(Layout::kOctahedral, 0.75, 0.25, {r, r, 0});
  for (const double u : {0.0, 1.0})
    for (const double v : {0.0, 1.0}) expect_direction(Layout::kOctahedral, u, v, {0, 0, 1});
}

// The middle of each face and the middle of its right edge, as drawn in the header.
TEST(Layout, FacesAreWhereTheyAreDrawn) {
  const Vec3d x = {1, 0, 0}, y = {0, 1, 0}, z = {0, 0, 1};
  struct Face {
    double column, row;
    Vec3d middle, right;
  };
  const auto expect_faces = [](Layout layout, const std::vector<Face>& faces) {
    const auto [columns, rows] = face_grid(layout);
    const double r = std::sqrt(0.5);
    for (const auto& [column, row, middle, right] : faces) {
      const double v = (row + 0.5) / rows;
      expect_direction(layout, (column + 0.5) / columns, v, middle);
      expect_direction(layout, (column + 1 - 1e-13) / columns, v, r * (middle + right));
    }
  };
  const std::vector<Face> row = {{0, 0, x, z},  {1, 0, -x, -z}, {2, 0, y, x},
                                 {3, 0, -y, x}, {4, 0, -z, x},  {5, 0, z, -x}};
  std::vector<Face> column = row;
  for (Face& face : column) std::swap(face.column, face.row);
  expect_faces(Layout::kHorizontalStrip, row);
  expect_faces(Layout::kVerticalStrip, column);
  expect_faces(Layout::kCube, column);
  expect_faces(Layout::kVerticalCross,
               {{1, 0, y, x}, {0, 1, -x, -z}, {1, 1, -z, x}, {2, 1, x, z}, {1, 2, -y, x}, {1, 3, z, x}});
  expect_faces(Layout::kHorizontalCross,
               {{1, 0, y, x}, {0, 1, -x, -z}, {1, 1, -z, x}, {2, 1, x, z}, {3, 1, z, -x}, {1, 2, -y, x}});
  // +X −X +Y −Y +Z −Z of a frame whose +Z is our −Z and whose +X our −X.
  expect_faces(Layout::kOpenExrCube,
               {{0, 0, -x, -z}, {0, 1, x, z}, {0, 2, y, -x}, {0, 3, -y, -x}, {0, 4, -z, x}, {0, 5, z, -x}});
  EXPECT_FALSE(direction_at(Layout::kVerticalCross, {0.1, 0.1}).has_value());
  EXPECT_FALSE(direction_at(Layout::kHorizontalCross, {0.9, 0.9}).has_value());
}

// A cross can be cut out and folded: faces that touch in the picture touch in space.
TEST(Layout, CrossesFoldWithoutGaps) {
  for (const Layout layout : {Layout::kVerticalCross, Layout::kHorizontalCross}) {
    const auto [columns, rows] = face_grid(layout);
    int folds = 0;
    for (const CubeFace& a : cube_faces(layout))
      for (const CubeFace& b : cube_faces(layout)) {
        const bool beside = b.row == a.row && b.column == a.column + 1;
        const bool below = b.column == a.column && b.row == a.row + 1;
        if (!beside && !below) continue;
        ++folds;
        for (const double along : {0.1, 0.5, 0.8}) {
          const double u = beside ? b.column : a.column + along, v = below ? b.row : a.row + along;
          const double du = beside ? 1e-9 : 0, dv = below ? 1e-9 : 0;
          const auto before = direction_at(layout, {(u - du) / columns, (v - dv) / rows});
          const auto after = direction_at(layout, {(u + du) / columns, (v + dv) / rows});
          EXPECT_NEAR(dot(*before, *after), 1, 1e-12) << layout_name(layout) << a.column << a.row;
        }
      }
    EXPECT_EQ(folds, 5);
  }
}

TEST(Layout, NoFaceIsMirrored) {
  for (const Layout layout : all_layouts())
    for (const CubeFace& face : cube_faces(layout))
      EXPECT_EQ(cross(face.forward, -face.down), face.right) << layout_name(layout) << face.column << face.row;
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
    // Every direction has a point in the picture, the poles, the seam and the edges too.
    for (const Vec3d d : {Vec3d{0, 1, 0}, Vec3d{0, -1, 0}, Vec3d{0, 0, 1}, Vec3d{0, 0, -1}, Vec3d{-0.0, 0, 1},
                          Vec3d{std::sqrt(0.5), std::sqrt(0.5), 0}, Vec3d{0, -std::sqrt(0.5), std::sqrt(0.5)}}) {
      const ImagePoint point = point_of(layout, d);
      EXPECT_GE(point.u, 0);
      EXPECT_LE(point.u, 1);
      EXPECT_GE(point.v, 0);
      EXPECT_LE(point.v, 1);
    }
  }
}

TEST(Layout, NamesAreInverse) {
  for (const Layout layout : all_layouts()) EXPECT_EQ(layout_from_name(layout_name(layout)), layout);
  EXPECT_FALSE(layout_from_name("lat-lon").has_value());
}

TEST(Layout, PicturesFitTheirLayout) {
  for (const Layout layout : all_layouts()) EXPECT_TRUE(fits(layout, picture_size(layout, 64)));
  EXPECT_EQ(picture_size(Layout::kVerticalCross, 10), (PictureSize{30, 40}));
  EXPECT_FALSE(fits(Layout::kVerticalCross, {40, 30}));
  EXPECT_FALSE(fits(Layout::kHorizontalCross, {41, 30}));
  EXPECT_FALSE(fits(Layout::kAngularMap, {64, 32}));
  EXPECT_FALSE(fits(Layout::kVerticalStrip, {0, 0}));
}

}  // namespace
}  // namespace shlight
