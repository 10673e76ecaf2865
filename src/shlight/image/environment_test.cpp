#include "shlight/image/environment.h"

#include <gtest/gtest.h>

#include <cmath>

#include "shlight/image/pixels.h"
#include "shlight/sh/sphere_samples.h"

namespace shlight {
namespace {

Environment make_environment(Layout layout, int size) {
  const auto [width, height] = picture_size(layout, size);
  return {Image(width, height), layout};
}

TEST(Environment, LookupsSeeThePixelThatCoversADirection) {
  for (const Layout layout : all_layouts()) {
    Environment environment = make_environment(layout, 16);
    const auto [width, height] = environment.size();
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) environment.image.set_rgb(x, y, {double(x), double(y), 1});
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const auto d = direction_at(layout, pixel_centre(layout, environment.size(), {x, y}));
        if (!d) continue;
        // Centres on a border belong to several pixels.
        if (!centres_on_border(layout)) {
          const Rgb nearest = eval_nearest(environment, *d);
          EXPECT_EQ(nearest.r, x) << layout_name(layout);
          EXPECT_EQ(nearest.g, y) << layout_name(layout);
          const Rgb bilinear = eval_bilinear(environment, *d);
          EXPECT_NEAR(bilinear.r, x, 1e-6) << layout_name(layout);
          EXPECT_NEAR(bilinear.g, y, 1e-6) << layout_name(layout);
        }
        EXPECT_NEAR(eval_bilinear(environment, *d).b, 1, 1e-12);
      }
  }
}

// A linear function of the direction is smooth everywhere; a lookup that broke at a seam, a pole, an edge or a fold
// would show.
TEST(Environment, BilinearIsSmoothOverSeams) {
  for (const Layout layout : all_layouts()) {
    Environment environment = make_environment(layout, size_from_horizon(layout, 256));
    const auto [width, height] = environment.size();
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        if (const auto d = direction_at(layout, pixel_centre(layout, environment.size(), {x, y})))
          environment.image.set_rgb(x, y, {1 + d->x, 1 + d->y, 1 + d->z});
        else
          environment.image.set_rgb(x, y, {1e3, 1e3, 1e3});
    // The rim of a mirror ball is one direction, and its last pixels cover as much of the sphere as any: what is left
    // out of each is half of its width, √(2 · 4/256) of a radian.
    const double tolerance = layout == Layout::kMirrorBall ? 0.18 : layout == Layout::kAngularMap ? 0.03 : 0.01;
    for (const Vec3d d : make_sphere_samples(0, 100, 4).directions) {
      const Rgb value = eval_bilinear(environment, d);
      EXPECT_NEAR(value.r, 1 + d.x, tolerance) << layout_name(layout) << " " << d.x << " " << d.y << " " << d.z;
      EXPECT_NEAR(value.g, 1 + d.y, tolerance) << layout_name(layout) << " " << d.x << " " << d.y << " " << d.z;
      EXPECT_NEAR(value.b, 1 + d.z, tolerance) << layout_name(layout) << " " << d.x << " " << d.y << " " << d.z;
    }
  }
}

TEST(Environment, UnusedPixelsAreCleared) {
  for (const Layout layout : all_layouts()) {
    Environment environment = make_environment(layout, 12);
    for (float& value : environment.image.values) value = 1;
    clear_unused(environment);
    int cleared = 0;
    for (int y = 0; y < environment.image.height; ++y)
      for (int x = 0; x < environment.image.width; ++x) {
        const bool used = pixel_solid_angle(layout, environment.size(), {x, y}) > 0;
        EXPECT_EQ(environment.image.rgb(x, y).r, used ? 1 : 0) << layout_name(layout) << x << " " << y;
        cleared += !used;
      }
    const bool cross = layout == Layout::kVerticalCross || layout == Layout::kHorizontalCross;
    const bool disc = layout == Layout::kAngularMap || layout == Layout::kMirrorBall;
    EXPECT_EQ(cleared, cross ? 6 * 144 : disc ? 12 : 0) << layout_name(layout);
  }
}

}  // namespace
}  // namespace shlight
