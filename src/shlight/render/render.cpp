#include "shlight/render/render.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <vector>

#include "shlight/core/assert.h"
#include "shlight/image/tone_map.h"
#include "shlight/render/background.h"
#include "shlight/render/context.h"
#include "shlight/render/gpu_scene.h"
#include "shlight/render/irradiance_renderer.h"
#include "shlight/render/targets.h"
#include "shlight/render/tone_map.h"
#include "shlight/render/transfer_renderer.h"

namespace shlight {
namespace {

RgbCoefficients scaled(double factor, RgbCoefficients coefficients) {
  for (Rgb& c : coefficients.values()) c = factor * c;
  return coefficients;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

template <class Renderer>
bool needs_tangents(const Renderer&) {
  return false;
}
bool needs_tangents(const ReflectanceRenderer& renderer) {
  return renderer.needs_tangents();
}

// Draws with the renderer that make_renderer makes in the context from the light's coefficients, which are measured in
// 1/unit.
template <class MakeRenderer>
RenderResult render(const Scene& scene, const RenderLight& light, const RenderParams& params, const Progress& progress,
                    const MakeRenderer& make_renderer) {
  SHLIGHT_ASSERT_LE(1, params.frames);
  const HeadlessContext context;
  const RadianceTarget radiance_target(params.width, params.height);
  const PictureTarget picture_target(params.width, params.height);

  // Half floats hold 6e-5 to 65504 at full precision, so lights are drawn in a unit near their mean, whatever they are
  // measured in. A power of two: what it takes off a value, it gives back exactly.
  const double exposure = auto_exposure(light.coefficients);
  const double unit = std::exp2(std::round(std::log2(exposure)));
  const RgbCoefficients coefficients = scaled(unit, resize_bands(light.coefficients, params.bands));
  const Background background =
      light.background.num_pixels() > 0 ? Background(light.background, unit) : Background(coefficients);
  auto renderer = make_renderer(coefficients, unit);
  const double exposed = exposure / unit * std::exp2(params.exposure);
  if (params.mark_negative) {
    const float bright = static_cast<float>(1 / exposed);
    renderer.mark_negative({bright, 0, bright});
  }
  const GpuScene gpu_scene(scene, needs_tangents(renderer));
  const ToneMapper tone_mapper;

  const Extent extent = scene_extent(scene);
  const auto draw = [&](double turn) {
    Camera camera = params.camera;
    camera.azimuth += turn;
    const View view = make_view(camera, extent, static_cast<double>(params.width) / params.height);
    radiance_target.begin();
    const Rotation light_turn = params.turn_light
                                    ? rotation_about_y(-turn * std::numbers::pi / 180) * params.rotate_light
                                    : params.rotate_light;
    renderer.draw(gpu_scene, view, light_turn);
    if (params.show_background) background.draw(view, light_turn);
    radiance_target.resolve();
    picture_target.begin();
    tone_mapper.draw(radiance_target.texture(), exposed);
    glFinish();
  };

  draw(0);
  gl::check_errors("the picture");
  RenderResult result;
  result.radiance = radiance_target.read(1 / unit);
  result.picture = picture_target.read();
  result.gl_renderer = gl_renderer();

  std::vector<double> frame_ms;
  for (int frame = 0; frame < params.frames; ++frame) {
    report_progress(progress, static_cast<double>(frame) / params.frames);
    const auto start = std::chrono::steady_clock::now();
    draw(360.0 * frame / params.frames);
    frame_ms.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
  }
  report_progress(progress, 1);
  result.frame_ms = median(frame_ms);
  return result;
}

}  // namespace

RenderLight make_render_light(const Light& light, int bands, int background_width) {
  RenderLight result{light.project(bands), {}};
  if (!dynamic_cast<const CoefficientLight*>(&light)) result.background = light.lat_long(background_width);
  return result;
}

RenderResult render_irradiance(const Scene& scene, const RenderLight& light, const RenderParams& params,
                               const Progress& progress) {
  return render(scene, light, params, progress,
                [](const RgbCoefficients& radiance, double) { return IrradianceRenderer(radiance); });
}

RenderResult render_reflectance(const Scene& scene, std::span<const SurfaceReflectance> surfaces,
                                const RenderLight& light, const RenderParams& params, const Progress& progress) {
  SHLIGHT_ASSERT_EQ(surfaces.size(), scene.materials.size());
  return render(scene, light, params, progress, [&](const RgbCoefficients& radiance, double) {
    return ReflectanceRenderer(surfaces, radiance, params.shade);
  });
}

RenderResult render_hybrid(const Scene& scene, std::span<const SurfaceReflectance> surfaces, const RenderLight& light,
                           const RenderParams& params, const Progress& progress) {
  SHLIGHT_ASSERT_EQ(surfaces.size(), scene.materials.size());
  // A light that is coefficients is what they reconstruct.
  constexpr int kWidth = 256;
  const Image picture =
      light.background.num_pixels() > 0 ? light.background : CoefficientLight(light.coefficients).lat_long(kWidth, 0);
  const ResidualLight residual(picture, taken_by_highlights(resize_bands(light.coefficients, params.bands)));
  return render(scene, light, params, progress, [&](const RgbCoefficients& radiance, double unit) {
    return ReflectanceRenderer(surfaces, radiance, params.shade, &residual, unit);
  });
}

RenderResult render_transfer(const Scene& scene, const Transfer& transfer, const RenderLight& light,
                             const RenderParams& params, const Progress& progress) {
  SHLIGHT_ASSERT_EQ(transfer.num_vertices(), num_vertices(scene));
  return render(scene, light, params, progress,
                [&](const RgbCoefficients& radiance, double) { return TransferRenderer(transfer, radiance); });
}

RenderResult render_baked(const Baked& baked, const RenderLight& light, const RenderParams& params,
                          const Progress& progress) {
  const BakeInfo& info = baked.info;
  SHLIGHT_ASSERT_EQ(baked.transfer.num_vertices(), num_vertices(baked.scene));
  return render(baked.scene, light, params, progress, [&](const RgbCoefficients& radiance, double) {
    return info.pca ? TransferRenderer(*info.pca, radiance) : TransferRenderer(baked.transfer, radiance, info.bits);
  });
}

}  // namespace shlight
