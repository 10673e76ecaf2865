#include "shlight/render/frame_in_parts.h"

#include <gtest/gtest.h>

#include "shlight/render/render_test_util.h"
#include "shlight/scene/load_scene.h"

namespace shlight {
namespace {

class FrameInPartsTest : public GlTest {};

TEST_F(FrameInPartsTest, MakesThePictureOfOneGo) {
  const Scene scene = make_scene("builtin:scene");
  GpuScene gpu_scene(scene);
  RgbCoefficients light = constant_light(2, {0.5, 0.6, 0.7});
  light[1] = {0.5, 0.4, 0.3};
  const SurfaceRenderer surfaces = IrradianceRenderer(light);
  const Background background(light);
  const Drawing drawing = {gpu_scene, scene_extent(scene), surfaces, &background, {}};
  const FrameRenderer renderer(150, 100);
  FrameParams frame;
  renderer.draw(drawing, frame);
  const Image8 whole = renderer.read_picture();
  frame.camera.azimuth += 90;
  renderer.draw(drawing, frame);
  EXPECT_NE(renderer.read_picture().values, whole.values);
  frame.camera.azimuth -= 90;

  FrameInParts parts(renderer);
  EXPECT_FALSE(parts.going_on());
  // The first time, nothing is known of how long anything takes, and then it is. Any share of a frame adds up to it.
  for (const double ms : {0.01, 0.01, 5.0, 1e6}) {
    parts.begin(gpu_scene);
    int count = 1;
    while (!parts.draw(gpu_scene, drawing, frame, ms)) ++count;
    EXPECT_FALSE(parts.going_on());
    EXPECT_EQ(renderer.read_picture().values, whole.values) << ms;
    EXPECT_GT(parts.spent_ms(), 0);
    if (ms < 1) {
      EXPECT_GT(count, 20) << ms;
    }
    if (ms > 1e5) {
      EXPECT_EQ(count, 1) << ms;
    }
  }
  // Beginning anew forgets what was drawn.
  frame.camera.azimuth += 90;
  parts.begin(gpu_scene);
  parts.draw(gpu_scene, drawing, frame, 5);
  frame.camera.azimuth -= 90;
  parts.begin(gpu_scene);
  parts.draw(gpu_scene, drawing, frame, 1e6);
  EXPECT_EQ(renderer.read_picture().values, whole.values);
}

}  // namespace
}  // namespace shlight
