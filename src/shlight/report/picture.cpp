#include "shlight/report/picture.h"

#include <algorithm>
#include <cmath>

#include "shlight/core/assert.h"
#include "shlight/truth/path_tracer.h"

namespace shlight {
namespace {

// Pictures of one size, value by value.
template <class F>
Image combine(const Image& a, const Image& b, F&& f) {
  SHLIGHT_ASSERT_EQ(a.width, b.width);
  SHLIGHT_ASSERT_EQ(a.height, b.height);
  Image result(a.width, a.height);
  std::ranges::transform(a.values, b.values, result.values.begin(), f);
  return result;
}

}  // namespace

Image average_blocks(const Image& image, int factor) {
  Image result(image.width / factor, image.height / factor);
  for (int y = 0; y < result.height; ++y)
    for (int x = 0; x < result.width; ++x) {
      Rgb sum;
      for (int j = 0; j < factor; ++j)
        for (int i = 0; i < factor; ++i) sum += image.rgb(x * factor + i, y * factor + j);
      result.set_rgb(x, y, 1.0 / (factor * factor) * sum);
    }
  return result;
}

Image draw_fine(const RenderLight& light, const RenderParams& params, const DrawMethod& draw) {
  RenderParams fine = params;
  fine.width *= kFine, fine.height *= kFine;
  return average_blocks(draw(light, fine).radiance, kFine);
}

Image draw_backdrop(const Scene& scene, const RenderLight& light, RenderParams params) {
  const DrawMethod draw = [&](const RenderLight& l, const RenderParams& p) { return render_irradiance(scene, l, p); };
  params.show_background = false;
  const Image without = draw_fine(light, params, draw);
  params.show_background = true;
  return combine(draw_fine(light, params, draw), without, [](float with, float model) { return with - model; });
}

Image add_images(const Image& a, const Image& b) {
  return combine(a, b, [](float x, float y) { return x + y; });
}

Reference trace_reference(const Scene& scene, const Light& light, const RenderParams& params, const Brdf* brdf,
                          int samples, const Progress& progress) {
  PathTraceParams trace;
  trace.width = params.width, trace.height = params.height;
  trace.camera = params.camera;
  trace.transfer = TransferKind::kCosine;
  trace.samples = samples;
  trace.brdf = brdf;
  trace.show_background = false;
  PathTraceResult result = trace_paths(scene, light, trace, progress);
  double variance = 0, square = 0;
  for (const float v : result.variance.values) variance += double{v};
  for (const float v : result.radiance.values) square += double{v} * double{v};
  return {std::move(result.radiance), square > 0 ? std::sqrt(variance / square) : 0};
}

}  // namespace shlight
