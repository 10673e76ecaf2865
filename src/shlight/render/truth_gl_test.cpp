// Drawn pictures against path-traced ones of the same camera, scene and light.

#include <gtest/gtest.h>

#include <cmath>

#include "shlight/light/light.h"
#include "shlight/render/render.h"
#include "shlight/render/render_test_util.h"
#include "shlight/truth/path_tracer.h"

namespace shlight {
namespace {

class TruthGl : public GlTest {};

// A light of as many bands as are drawn, on a surface without an outline in the picture: what is left is noise, whose
// squares have the mean that the variances say, and the renderer's half floats.
TEST_F(TruthGl, IrradianceIsTheMeanOfCosinePaths) {
  RgbCoefficients coefficients = constant_light(3, {1, 1, 1});
  add_delta({0.48, 0.6, 0.64}, {0.4, 0.3, 0.2}, coefficients);
  const CoefficientLight light(coefficients);
  const Scene scene = make_test_scene(make_ellipsoid({1, 0.7, 0.9}), {0.9f, 0.5f, 0.3f});
  RenderParams drawn;
  drawn.width = 48, drawn.height = 32;
  drawn.camera = {30, 20, 6, 35};
  drawn.rotate_light = rotation_about_y(0.9);
  const RenderResult picture = render_irradiance(scene, make_render_light(light, 3), drawn);

  PathTraceParams params;
  params.width = drawn.width, params.height = drawn.height;
  params.camera = drawn.camera;
  params.rotate_light = drawn.rotate_light;
  params.transfer = TransferKind::kCosine;
  const PathTraceResult truth = trace_paths(scene, light, params);

  double squares = 0;
  for (int y = 0; y < drawn.height; ++y)
    for (int x = 0; x < drawn.width; ++x) {
      const double expected = picture.radiance.rgb(x, y).g;
      // Half floats of the radiance, and what four samples a pixel are off its mean.
      const double variance = truth.variance.rgb(x, y).g + std::pow(expected / 1024, 2);
      squares += std::pow(truth.radiance.rgb(x, y).g - expected, 2) / variance;
      EXPECT_GT(expected, 0.05);
    }
  // Fifteen degrees of freedom a pixel: the mean of such squares is 15/13; their spread over all pixels is a few per
  // cent.
  EXPECT_NEAR(squares / (drawn.width * drawn.height), 15.0 / 13, 0.2);
}

}  // namespace
}  // namespace shlight
