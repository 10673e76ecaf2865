#include "shlight/sh/area_light.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "shlight/sh/basis.h"
#include "shlight/sh/project.h"
#include "shlight/sh/sphere_samples.h"
#include "shlight/sh/zonal.h"

namespace shlight {
namespace {

using std::numbers::pi;

constexpr int kBands = 10;
constexpr Rgb kWhite = {1, 1, 1};

double length(Vec3d v) {
  return std::sqrt(dot(v, v));
}

RgbCoefficients polygon(std::span<const Vec3d> vertices, Sides sides = Sides::kBoth, int bands = kBands) {
  RgbCoefficients coefficients(bands);
  add_polygon(vertices, sides, kWhite, coefficients);
  return coefficients;
}

// Adds dA cos θ / r² of a flat piece of lamp.
void add_piece(Vec3d position, Vec3d area, RgbCoefficients& sum) {
  const double distance = length(position);
  const double solid_angle = std::abs(dot(area, position)) / (distance * distance * distance);
  add_delta(1 / distance * position, solid_angle * kWhite, sum);
}

// Adds a flat triangle by Gauss-Legendre in two dimensions, one corner drawn out to an edge; cut into four `cuts`
// times, which takes the pole at the origin far from the pieces.
void add_triangle(Vec3d a, Vec3d b, Vec3d c, int cuts, const GaussLegendre& rule, RgbCoefficients& sum) {
  if (cuts > 0) {
    const Vec3d ab = 0.5 * (a + b), bc = 0.5 * (b + c), ca = 0.5 * (c + a);
    for (const auto& [p, q, r] : {std::array{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}})
      add_triangle(p, q, r, cuts - 1, rule, sum);
    return;
  }
  const Vec3d area = 0.5 * cross(b - a, c - a);
  for (std::size_t i = 0; i < rule.nodes.size(); ++i)
    for (std::size_t j = 0; j < rule.nodes.size(); ++j) {
      const double u = 0.5 * (1 + rule.nodes[i]), v = 0.5 * (1 + rule.nodes[j]);
      add_piece(a + u * ((1 - v) * (b - a) + v * (c - a)), 0.5 * rule.weights[i] * rule.weights[j] * u * area, sum);
    }
}

RgbCoefficients triangle_by_quadrature(Vec3d a, Vec3d b, Vec3d c, int bands, int cuts = 4) {
  RgbCoefficients sum(bands);
  add_triangle(a, b, c, cuts, make_gauss_legendre(24), sum);
  return sum;
}

RgbCoefficients disc_by_quadrature(Vec3d centre, Vec3d normal, double radius, int bands, int nodes = 80) {
  const Vec3d n = 1 / length(normal) * normal;
  Vec3d x = cross(n, std::abs(n.x) < 0.6 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0});
  x = 1 / length(x) * x;
  const Vec3d y = cross(n, x);
  const GaussLegendre rule = make_gauss_legendre(nodes);
  RgbCoefficients sum(bands);
  for (std::size_t i = 0; i < rule.nodes.size(); ++i)
    for (int j = 0; j < 4 * nodes; ++j) {
      const double r = radius * 0.5 * (1 + rule.nodes[i]), phi = 2 * pi * j / (4 * nodes);
      const double area = 0.5 * rule.weights[i] * radius * r * 2 * pi / (4 * nodes);
      add_piece(centre + r * std::cos(phi) * x + r * std::sin(phi) * y, area * n, sum);
    }
  return sum;
}

double largest_difference(const RgbCoefficients& a, const RgbCoefficients& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i].g - b[i].g));
  return largest;
}

void expect_near(const RgbCoefficients& a, const RgbCoefficients& b, double tolerance) {
  ASSERT_EQ(a.bands(), b.bands());
  EXPECT_LE(largest_difference(a, b), tolerance);
}

RgbCoefficients operator+(RgbCoefficients a, const RgbCoefficients& b) {
  a += b;
  return a;
}

const Vec3d kA = {1.2, -0.3, -1.5}, kB = {0.2, 1.1, -1.1}, kC = {-0.8, -0.4, -1.9};

// What the sums of the quadratures below leave, of up to a hundred thousand terms, each right to 1e-16 of 1.
constexpr double kRounding = 5e-14;

TEST(AreaLight, TriangleIsItsQuadrature) {
  for (const auto& [a, b, c] : {std::array{kA, kB, kC}, {kA, kB, Vec3d{1, 2, 1}}, {Vec3d{0, 1, 0}, {.4, .4, .8}, kC}}) {
    const auto expected = triangle_by_quadrature(a, b, c, kBands);
    expect_near(polygon(std::array{a, b, c}), expected, kRounding);
    expect_near(polygon(std::array{c, b, a}), expected, kRounding);
  }
}

TEST(AreaLight, TriangleIsItsQuadratureAt32Bands) {
  expect_near(polygon(std::array{kA, kB, kC}, Sides::kBoth, 32), triangle_by_quadrature(kA, kB, kC, 32), 1e-13);
}

// Of all directions with x, y, z > 0: ∫ 1 = π/2, ∫ x = π/4, ∫ xy = 1/3, ∫ 3z² − 1 = ∫ x² − y² = 0.
TEST(AreaLight, OctantIsKnown) {
  const RgbCoefficients c = polygon(std::vector<Vec3d>{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, Sides::kBoth, 3);
  const double y1 = std::sqrt(3 / (4 * pi)), y2 = std::sqrt(15 / (4 * pi));
  const double expected[9] = {
      std::sqrt(1 / (4 * pi)) * pi / 2, y1 * pi / 4, y1 * pi / 4, y1 * pi / 4, y2 / 3, y2 / 3, 0, y2 / 3, 0};
  for (std::size_t i = 0; i < 9; ++i) EXPECT_NEAR(c[i].g, expected[i], 1e-15) << "coefficient " << i;
}

// The origin in the polygon's plane and inside of it, and unit vertices on an equator: the hemisphere behind the front.
TEST(AreaLight, APolygonAroundTheOriginIsAHemisphere) {
  RgbCoefficients up(kBands), down(kBands);
  add_disc({0, 1, 0}, pi / 2, kWhite, up);
  add_disc({0, -1, 0}, pi / 2, kWhite, down);
  // Counter-clockwise from above: the front is above, and who stands on it looks down at it.
  const std::vector<Vec3d> square = {{2, 0, 1}, {1, 0, -1}, {-1, 0, -1}, {-1, 0, 3}};
  expect_near(polygon(square, Sides::kFront), down, kRounding);
  expect_near(polygon(std::vector<Vec3d>(square.rbegin(), square.rend()), Sides::kFront), up, kRounding);
  EXPECT_TRUE(polygon_covers(square, Sides::kFront, {.6, -.8, 0}));
  EXPECT_FALSE(polygon_covers(square, Sides::kFront, {.6, .8, 0}));
  // From a hair above it is nearly that.
  std::vector<Vec3d> near = square;
  for (Vec3d& v : near) v.y -= 1e-9;
  expect_near(polygon(near, Sides::kFront), down, 1e-7);
  // The origin on an edge: a quarter of the sphere, half of the hemisphere below.
  std::vector<Vec3d> beside = {{-1, 0, 0}, {1, 0, 0}, {1, 0, -1}, {-1, 0, -1}};
  const RgbCoefficients quarter = polygon(beside, Sides::kFront);
  EXPECT_NEAR(quarter[0].g, std::sqrt(1 / (4 * pi)) * pi, kRounding);
  EXPECT_NEAR(quarter.at(1, -1).g, 0.5 * down.at(1, -1).g, kRounding);
  EXPECT_NEAR(quarter.at(1, 0).g, 0.5 * down.at(1, -1).g, kRounding);
}

TEST(AreaLight, EdgeOnThereIsNothing) {
  // All in the plane x = 0 through the origin.
  const std::vector<Vec3d> square = {{0, 1, -2}, {0, 1, -3}, {0, 2, -3}, {0, 2, -2}};
  for (const Sides sides : {Sides::kFront, Sides::kBoth})
    expect_near(polygon(square, sides), RgbCoefficients(kBands), kRounding);
  expect_near(polygon(std::array{kA, kB}), RgbCoefficients(kBands), 0);
  expect_near(polygon({}), RgbCoefficients(kBands), 0);
  expect_near(polygon(std::array{kA, kA, kA}), RgbCoefficients(kBands), 0);
  expect_near(polygon(std::array{kA, kB, kA}), RgbCoefficients(kBands), kRounding);
}

TEST(AreaLight, ShinesToItsFront) {
  // Seen from the origin kA, kB, kC run counter-clockwise.
  ASSERT_LT(dot(cross(kB - kA, kC - kA), kA), 0);
  EXPECT_EQ(polygon(std::array{kA, kB, kC}, Sides::kFront), polygon(std::array{kA, kB, kC}, Sides::kBoth));
  EXPECT_EQ(polygon(std::array{kC, kB, kA}, Sides::kFront), RgbCoefficients(kBands));
  RgbCoefficients disc(kBands);
  add_flat_disc({0, 3, 0}, {0, 1, 0}, 1, Sides::kFront, kWhite, disc);
  EXPECT_EQ(disc, RgbCoefficients(kBands));
  add_flat_disc({0, 3, 0}, {0, -1, 0}, 1, Sides::kFront, kWhite, disc);
  EXPECT_GT(disc[0].g, 0.01);
}

// An L, which is not convex, is the sum of its two rectangles; and repeated and collinear vertices change nothing.
TEST(AreaLight, APolygonIsTheSumOfItsParts) {
  const auto at = [](double x, double y) { return Vec3d{x, y - 0.3, -1 - 0.4 * x + 0.2 * y}; };
  const std::vector<Vec3d> whole = {at(0, 0), at(3, 0), at(3, 1), at(1, 1), at(1, 2), at(0, 2)};
  const std::vector<Vec3d> low = {at(0, 0), at(3, 0), at(3, 1), at(0, 1)};
  const std::vector<Vec3d> high = {at(0, 1), at(1, 1), at(1, 2), at(0, 2)};
  expect_near(polygon(whole), polygon(low) + polygon(high), kRounding);
  const std::vector<Vec3d> same = {at(0, 0), at(0, 0), at(1, 0), at(3, 0),   at(3, 1), at(3, 1),
                                   at(1, 1), at(1, 2), at(0, 2), at(0, 1.3), at(0, 1)};
  expect_near(polygon(same), polygon(whole), kRounding);
  // A hole, reached by a cut and back.
  const std::vector<Vec3d> frame = {at(0, 0),  at(3, 0),   at(3, 2),   at(0, 2),  at(0, 0),
                                    at(1, .5), at(1, 1.5), at(2, 1.5), at(2, .5), at(1, .5)};
  const std::vector<Vec3d> full = {at(0, 0), at(3, 0), at(3, 2), at(0, 2)};
  const std::vector<Vec3d> hole = {at(1, .5), at(2, .5), at(2, 1.5), at(1, 1.5)};
  expect_near(polygon(frame) + polygon(hole), polygon(full), kRounding);
}

// The horizon cuts a polygon in two, edges on its plane included.
TEST(AreaLight, ClippedHalvesSumToTheWhole) {
  const auto at = [](double x, double y) { return Vec3d{x, y, -1}; };
  const std::vector<Vec3d> star = {at(0, 2),  at(-.5, .5), at(-2, 0), at(-.5, -.5),
                                   at(0, -2), at(.5, -.5), at(2, 0),  at(.5, .5)};
  for (const Vec3d normal : {Vec3d{0, 1, 0}, {.6, .8, 0}, {.1, .7, -.3}}) {
    const std::vector<Vec3d> above = clip_polygon(star, normal), below = clip_polygon(star, -normal);
    for (const Vec3d v : above) EXPECT_GE(dot(normal, v), -1e-15);
    expect_near(polygon(above) + polygon(below), polygon(star), kRounding);
  }
  EXPECT_TRUE(clip_polygon(star, {0, 0, 1}).empty());
  EXPECT_EQ(clip_polygon(star, {0, 0, -1}), star);
}

// A sliver has the coefficients of a line of deltas; a far lamp those of one.
TEST(AreaLight, SliversAndFarLampsKeepTheirSize) {
  const Vec3d a = {-1, .5, -2}, b = {1, .7, -2};
  for (const double width : {1e-3, 1e-6, 1e-9}) {
    const Vec3d up = {0, width, 0};
    const RgbCoefficients thin = polygon(std::array{a, b, b + up, a + up});
    const RgbCoefficients expected =
        triangle_by_quadrature(a, b, b + up, kBands) + triangle_by_quadrature(a, b + up, a + up, kBands);
    EXPECT_LE(largest_difference(thin, expected), kRounding) << "width " << width;
    EXPECT_GT(thin[0].g, 0.05 * width);
  }
  const Vec3d far = 1e4 * kA;
  const RgbCoefficients lamp = polygon(std::array{far, far + kB, far + kC});
  EXPECT_LE(largest_difference(lamp, triangle_by_quadrature(far, far + kB, far + kC, kBands, 0)), 1e-15);
}

// Error O(1/n²): twice the sides, a quarter of it.
TEST(AreaLight, PolygonsOfManySidesBecomeADisc) {
  const Vec3d centre = {0.7, 0.4, -1.2}, x = {.8, -.6, 0}, y = {.48, .64, -.6};
  RgbCoefficients disc(kBands);
  add_flat_disc(centre, cross(x, y), 0.9, Sides::kBoth, kWhite, disc);
  double before = 0;
  for (const int sides : {64, 128, 256}) {
    std::vector<Vec3d> vertices;
    for (int i = 0; i < sides; ++i)
      vertices.push_back(centre + 0.9 * std::cos(2 * pi * i / sides) * x + 0.9 * std::sin(2 * pi * i / sides) * y);
    const double error = largest_difference(polygon(vertices), disc);
    if (before > 0) {
      EXPECT_NEAR(before / error, 4, 0.02) << sides;
    }
    before = error;
  }
}

TEST(AreaLight, FlatDiscIsItsQuadrature) {
  for (const Vec3d normal : {Vec3d{0, 0, 1}, {.36, .48, .8}, {1, .2, .1}, {-.3, 2, .5}})
    for (const Vec3d centre : {Vec3d{0, 0, -1.5}, {.5, .7, -1.5}, {2, -1, 1}}) {
      RgbCoefficients disc(kBands);
      add_flat_disc(centre, normal, 0.8, Sides::kBoth, kWhite, disc);
      expect_near(disc, disc_by_quadrature(centre, normal, 0.8, kBands), kRounding);
    }
}

TEST(AreaLight, ADiscSeenFromItsAxisIsACap) {
  for (const double height : {1e-6, 0.1, 1.0, 100.0}) {
    RgbCoefficients disc(kBands), cap(kBands);
    add_flat_disc({0, height, 0}, {0, -1, 0}, 1, Sides::kFront, kWhite, disc);
    add_disc({0, 1, 0}, std::atan2(1, height), kWhite, cap);
    expect_near(disc, cap, kRounding);
  }
}

// From a hair above its plane a disc is nearly a hemisphere inside of its rim, nothing outside, and half of the
// hemisphere on it.
TEST(AreaLight, ADiscNearItsPlane) {
  RgbCoefficients hemisphere(kBands);
  add_disc({0, -1, 0}, pi / 2, kWhite, hemisphere);
  for (const double height : {0.0, 1e-7}) {
    RgbCoefficients inside(kBands), outside(kBands);
    add_flat_disc({0.99, -height, 0}, {0, 1, 0}, 1, Sides::kFront, kWhite, inside);
    expect_near(inside, hemisphere, 1e-4);
    add_flat_disc({1.01, -height, 0}, {0, 1, 0}, 1, Sides::kFront, kWhite, outside);
    expect_near(outside, RgbCoefficients(kBands), 1e-4);
  }
  RgbCoefficients rim(kBands), behind(kBands);
  add_flat_disc({1, -1e-6, 0}, {0, 1, 0}, 1, Sides::kFront, kWhite, rim);
  EXPECT_NEAR(rim[0].g, 0.5 * hemisphere[0].g, 1e-2);
  EXPECT_NEAR(rim.at(1, 1).g, -0.5 * hemisphere.at(1, -1).g, 1e-2);
  add_flat_disc({0.5, 1e-6, 0}, {0, 1, 0}, 1, Sides::kFront, kWhite, behind);
  EXPECT_EQ(behind, RgbCoefficients(kBands));
}

// Two discs that share no direction but border on the same sphere: a polygon inside of the one and around the other
// tell whether the nodes were enough where the ellipse is long.
TEST(AreaLight, LongEllipsesLieBetweenPolygons) {
  for (const double height : {1e-2, 1e-3, 1e-4}) {
    const Vec3d centre = {0.999, -height, 0};
    RgbCoefficients disc(3);
    add_flat_disc(centre, {0, 1, 0}, 1, Sides::kFront, kWhite, disc);
    double solid_angle[2];
    for (const int outer : {0, 1}) {
      constexpr int kSides = 20000;
      const double radius = outer ? 1 / std::cos(pi / kSides) : 1;
      std::vector<Vec3d> vertices;
      for (int i = 0; i < kSides; ++i)
        vertices.push_back(centre + radius * Vec3d{std::cos(2 * pi * i / kSides), 0, std::sin(2 * pi * i / kSides)});
      solid_angle[outer] = polygon(vertices, Sides::kBoth, 1)[0].g;
    }
    EXPECT_GE(disc[0].g, solid_angle[0] - 1e-11) << height;
    EXPECT_LE(disc[0].g, solid_angle[1] + 1e-11) << height;
  }
}

TEST(AreaLight, SpheresAreCapsOutsideAndAllDirectionsInside) {
  RgbCoefficients sphere(kBands), cap(kBands), inside(kBands), on(kBands);
  add_sphere({0, 2, 0}, 1, {1, 2, 3}, sphere);
  add_disc({0, 1, 0}, pi / 6, {1, 2, 3}, cap);
  EXPECT_LE(largest_difference(sphere, cap), 1e-15);
  add_sphere({0, .5, 0}, 1, kWhite, inside);
  EXPECT_NEAR(inside[0].g, std::sqrt(4 * pi), 1e-15);
  for (std::size_t i = 1; i < inside.size(); ++i) EXPECT_EQ(inside[i].g, 0);
  add_sphere({0, 1 + 1e-12, 0}, 1, kWhite, on);
  EXPECT_NEAR(on[0].g, std::sqrt(pi), 1e-5);
}

// The share of random directions that a polygon covers is its solid angle.
TEST(AreaLight, CoversWhatItsCoefficientsSay) {
  const auto at = [](double x, double y) { return Vec3d{x, y - 0.3, -1 - 0.4 * x + 0.2 * y}; };
  const std::vector<Vec3d> whole = {at(0, 0), at(3, 0), at(3, 1), at(1, 1), at(1, 2), at(0, 2)};
  const SphereSamples samples = make_sphere_samples(0, 300, 1);
  for (const auto& vertices : {whole, std::vector<Vec3d>(whole.rbegin(), whole.rend())}) {
    int covered = 0;
    for (const Vec3d d : samples.directions) covered += polygon_covers(vertices, Sides::kBoth, d);
    const double solid_angle = 4 * pi * covered / static_cast<double>(samples.directions.size());
    // Only strata on the boundary err, about 300 of them.
    EXPECT_NEAR(solid_angle, polygon(vertices)[0].g * std::sqrt(4 * pi), 3 * std::sqrt(300.0) * 4 * pi / 90000);
  }
  EXPECT_EQ(polygon_covers(whole, Sides::kFront, {0.3, 0, -1}),
            dot(cross(whole[1] - whole[0], whole[2] - whole[1]), whole[0]) < 0);
}

}  // namespace
}  // namespace shlight
