#include "shlight/image/pixels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "shlight/sh/basis.h"
#include "shlight/sh/sphere_samples.h"

namespace shlight {
namespace {

using std::numbers::pi;

TEST(Pixels, SolidAnglesAreWholeSpheres) {
  for (const Layout layout : all_layouts())
    for (const int n : {1, 2, 7, 64}) {
      const PictureSize size = picture_size(layout, is_lat_long(layout) ? 2 * n : n);
      const PixelQuadrature quadrature(layout, size, nodes_a_side_for(layout, size, 6));
      double sum = 0;
      for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) sum += quadrature.solid_angle({x, y});
      EXPECT_NEAR(sum, 4 * pi, 1e-7 * 4 * pi) << layout_name(layout) << " of " << n;
    }
}

// The nodes carry the pixel's solid angle and lie in it.
TEST(Pixels, NodesOfAPixelAreInIt) {
  std::vector<WeightedDirection> nodes;
  for (const Layout layout : all_layouts())
    for (const int n : {7, 64}) {
      const PictureSize size = picture_size(layout, is_lat_long(layout) ? 2 * n : n);
      const PixelQuadrature quadrature(layout, size, nodes_a_side_for(layout, size, 6));
      for (int y = 0; y < size.height; y += 3)
        for (int x = 0; x < size.width; x += 2) {
          quadrature.nodes({x, y}, nodes);
          EXPECT_EQ(quadrature.covers({x, y}), !nodes.empty()) << layout_name(layout) << x << " " << y;
          double sum = 0;
          for (const WeightedDirection& node : nodes) {
            EXPECT_EQ(pixel_at(layout, size, point_of(layout, node.direction)), (Pixel{x, y})) << layout_name(layout);
            EXPECT_NEAR(dot(node.direction, node.direction), 1, 1e-12);
            sum += node.solid_angle;
          }
          EXPECT_NEAR(sum, quadrature.solid_angle({x, y}), 1e-7 * sum) << layout_name(layout) << x << " " << y;
        }
    }
}

// Orthonormality over all pixels together: what the weights of single pixels cannot show, edges and creases too.
TEST(Pixels, TheBasisIsOrthonormalOverAPicture) {
  constexpr int kBands = 5;
  constexpr std::size_t kCount = kBands * kBands;
  for (const Layout layout : all_layouts())
    for (const int n : {9, 32}) {
      const PictureSize size = picture_size(layout, n);
      // Products of two functions have twice the bands.
      const PixelQuadrature quadrature(layout, size, nodes_a_side_for(layout, size, 2 * kBands));
      std::vector<double> gram(kCount * kCount), basis(kCount);
      std::vector<WeightedDirection> nodes;
      for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
          quadrature.nodes({x, y}, nodes);
          for (const WeightedDirection& node : nodes) {
            eval_basis(kBands, node.direction, std::span<double>(basis));
            for (std::size_t i = 0; i < kCount; ++i)
              for (std::size_t j = 0; j < kCount; ++j) gram[i * kCount + j] += node.solid_angle * basis[i] * basis[j];
          }
        }
      for (std::size_t i = 0; i < kCount; ++i)
        for (std::size_t j = 0; j < kCount; ++j)
          ASSERT_NEAR(gram[i * kCount + j], i == j ? 1 : 0, 1e-6) << layout_name(layout) << n << ": " << i << " " << j;
    }
}

// Against brute force: the share of uniform directions that falls into a pixel.
TEST(Pixels, SolidAnglesByCounting) {
  const auto samples = make_sphere_samples(0, 1200, 9);
  for (const Layout layout : all_layouts()) {
    const PictureSize size = picture_size(layout, 8);
    std::vector<double> counts(static_cast<std::size_t>(size.width * size.height));
    for (const Vec3d d : samples.directions) {
      const Pixel p = pixel_at(layout, size, point_of(layout, d));
      ++counts[static_cast<std::size_t>(p.y * size.width + p.x)];
    }
    for (int y = 0; y < size.height; ++y)
      for (int x = 0; x < size.width; ++x) {
        const double expected =
            4 * pi * counts[static_cast<std::size_t>(y * size.width + x)] / double(samples.directions.size());
        EXPECT_NEAR(pixel_solid_angle(layout, size, {x, y}), expected, 0.02 * expected + 1e-3)
            << layout_name(layout) << ": " << x << " " << y;
      }
  }
}

TEST(Pixels, OpenExrCentresLieOnTheBorder) {
  const PictureSize size = {9, 5};
  const auto d = direction_at(Layout::kOpenExrLatLong, pixel_centre(Layout::kOpenExrLatLong, size, {4, 2}));
  EXPECT_NEAR(d->z, -1, 1e-12);
  EXPECT_EQ(pixel_centre(Layout::kOpenExrLatLong, size, {0, 0}).v, 0);
  EXPECT_EQ(pixel_centre(Layout::kOpenExrLatLong, size, {8, 4}).u, 1);
  // Half as wide as its neighbour, and the row at the pole lower still.
  const double border = pixel_solid_angle(Layout::kOpenExrLatLong, size, {0, 2});
  EXPECT_NEAR(2 * border, pixel_solid_angle(Layout::kOpenExrLatLong, size, {1, 2}), 1e-12);
}

}  // namespace
}  // namespace shlight
