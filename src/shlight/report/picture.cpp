#include "shlight/report/picture.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "shlight/core/assert.h"
#include "shlight/report/html.h"
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

double sum(const Image& image) {
  double total = 0;
  for (const float v : image.values) total += double{v};
  return total;
}

double sum_of_squares(const Image& image) {
  double total = 0;
  for (const float v : image.values) total += double{v} * double{v};
  return total;
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

Image draw_fine(const RenderLight& light, const RenderParams& params, int fine, const DrawMethod& draw) {
  RenderParams larger = params;
  larger.width *= fine, larger.height *= fine;
  return average_blocks(draw(light, larger).radiance, fine);
}

Image draw_backdrop(const Scene& scene, const RenderLight& light, RenderParams params, int fine) {
  const DrawMethod draw = [&](const RenderLight& l, const RenderParams& p) { return render_irradiance(scene, l, p); };
  params.show_background = false;
  const Image without = draw_fine(light, params, fine, draw);
  params.show_background = true;
  return combine(draw_fine(light, params, fine, draw), without, std::minus<float>());
}

Image add_images(const Image& a, const Image& b) {
  return combine(a, b, std::plus<float>());
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
  const double square = sum_of_squares(result.radiance), variance = sum(result.variance);
  return {std::move(result.radiance), std::move(result.variance), square > 0 ? std::sqrt(variance / square) : 0};
}

PictureError measure_picture(const Image& test, const Reference& reference) {
  double difference = 0, square = 0, spread = 0;
  for (std::size_t i = 0; i < test.values.size(); ++i) {
    const double r = double{reference.radiance.values[i]}, variance = double{reference.variance.values[i]};
    const double d2 = (double{test.values[i]} - r) * (double{test.values[i]} - r);
    difference += d2 - variance, square += r * r - variance;
    // The variance of (error + noise)² is 2 variance² + 4 error² variance.
    spread += 2 * variance * variance + 4 * std::max(0.0, d2 - variance) * variance;
  }
  if (!(square > 0)) return {};
  return {std::sqrt(std::max(0.0, difference) / square), std::sqrt(2 * std::sqrt(spread) / square)};
}

PictureError measure_difference(const Reference& a, const Reference& b) {
  return measure_picture(a.radiance, {b.radiance, add_images(a.variance, b.variance), 0});
}

void add_error(PartWriter& out, const std::string& name, const PictureError& error) {
  out.add_value(name, error.value);
  out.add_value(name + "_resolution", error.resolution);
}

std::string to_text(const PictureError& error) {
  return error.value >= error.resolution ? format_percent(error.value) : "below " + format_percent(error.resolution);
}

}  // namespace shlight
