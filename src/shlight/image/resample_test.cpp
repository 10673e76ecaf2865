#include "shlight/image/resample.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "shlight/core/error.h"

namespace shlight {
namespace {

// Smooth, without any symmetry, positive.
Rgb some_radiance(Vec3d d) {
  return {1 + 0.5 * d.x + 0.2 * d.y * d.z, 1 - 0.4 * d.y + 0.3 * d.x * d.x, 1 + 0.6 * d.z - 0.2 * d.x * d.y};
}

Image draw(Layout layout, int size) {
  return make_picture(some_radiance, [](auto) { return 4; }, {layout, size, 0});
}

double largest_difference(const Image& a, const Image& b) {
  EXPECT_EQ(a.values.size(), b.values.size());
  double largest = 0;
  for (std::size_t i = 0; i < a.values.size(); ++i)
    largest = std::max(largest, std::abs(double(a.values[i]) - double(b.values[i])));
  return largest;
}

// From every layout to every other, pixel by pixel: a flipped or turned face, a seam, a dark edge would show.
TEST(Resample, EveryLayoutFromEveryOther) {
  for (const Layout from : all_layouts()) {
    const Environment source = {draw(from, size_from_horizon(from, 128)), from};
    for (const Layout to : all_layouts()) {
      const int size = size_from_horizon(to, 32);
      const double difference = largest_difference(resample(source, {to, size, 0}), draw(to, size));
      // The last pixels of a mirror ball as small as 128 or 32 are wide, and all of them meet in one direction.
      const bool ball = from == Layout::kMirrorBall || to == Layout::kMirrorBall;
      EXPECT_LT(difference, ball ? 0.12 : 0.02) << layout_name(from) << " to " << layout_name(to);
    }
  }
}

// What one bright pixel sends is there afterwards, wherever it lies and however much smaller the new picture is.
TEST(Resample, EnergyOfASinglePixelStays) {
  for (const Layout from : all_layouts())
    for (const auto& [right, down] : {std::pair{0.30, 0.37}, {0.71, 0.55}, {0.5, 0.45}}) {
      Environment source = {Image(), from};
      const PictureSize size = picture_size(from, size_from_horizon(from, 256));
      source.image = Image(size.width, size.height);
      const Pixel sun = pixel_at(from, size, point_of(from, *direction_at(Layout::kLatLong, {right, down})));
      source.image.set_rgb(sun.x, sun.y, {1000, 1000, 1000});
      const double energy = 1000 * pixel_solid_angle(from, size, sun);
      for (const Layout to : {Layout::kLatLong, Layout::kHorizontalCross, Layout::kAngularMap}) {
        const Environment result = {resample(source, {to, size_from_horizon(to, 64), 0}), to};
        const PixelQuadrature pixels(to, result.size(), 3);
        double sum = 0;
        for (int y = 0; y < result.image.height; ++y)
          for (int x = 0; x < result.image.width; ++x) sum += result.image.rgb(x, y).g * pixels.solid_angle({x, y});
        // Bilinear interpolation between pixels of unequal size and over edges, and a finite number of samples.
        EXPECT_NEAR(sum / energy, 1, 0.08) << layout_name(from) << " to " << layout_name(to) << right;
      }
    }
}

TEST(Resample, StopsWhereAsked) {
  const Environment source = {draw(Layout::kLatLong, 64), Layout::kLatLong};
  double last = 0;
  const auto stop = [&](double done) {
    last = done;
    return done < 0.4;
  };
  EXPECT_THROW(resample(source, {Layout::kVerticalStrip, 64, 0}, stop), Cancelled);
  EXPECT_GE(last, 0.4);
  EXPECT_LT(last, 0.5);
}

TEST(Resample, SameBitsForAnyNumberOfThreads) {
  const Environment source = {draw(Layout::kOctahedral, 64), Layout::kOctahedral};
  EXPECT_EQ(resample(source, {Layout::kMirrorBall, 50, 1}).values,
            resample(source, {Layout::kMirrorBall, 50, 0}).values);
}

}  // namespace
}  // namespace shlight
