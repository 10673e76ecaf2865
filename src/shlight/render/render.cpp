#include "shlight/render/render.h"

#include <epoxy/gl.h>

#include <chrono>
#include <numbers>
#include <optional>
#include <vector>

#include "shlight/core/assert.h"
#include "shlight/core/quantile.h"
#include "shlight/render/context.h"
#include "shlight/render/frame_renderer.h"
#include "shlight/render/highlight_light.h"

namespace shlight {
namespace {

// What of the light is drawn, in the light's unit.
RgbCoefficients drawn_light(const RenderLight& light, const LightScale& scale, const RenderParams& params) {
  if (params.show == Show::kVisibility) return visibility_light(params.bands);
  const RgbCoefficients coefficients = scaled(scale.unit, resize_bands(light.coefficients, params.bands));
  return params.show == Show::kDegree ? keep_degree(coefficients, params.degree) : coefficients;
}

// Draws with the renderer that make_renderer makes in the context from the light's coefficients, which are measured in
// 1/unit.
template <class MakeRenderer>
RenderResult render(const Scene& scene, const RenderLight& light, const RenderParams& params, const Progress& progress,
                    const MakeRenderer& make_renderer) {
  SHLIGHT_ASSERT_LE(1, params.frames);
  const HeadlessContext context;
  const FrameRenderer frame_renderer(params.width, params.height);

  const bool has_light = params.show == Show::kLit || params.show == Show::kDegree;
  const LightScale scale = has_light ? light_scale(light.coefficients) : LightScale{};
  const RgbCoefficients coefficients = drawn_light(light, scale, params);
  std::optional<Background> background;
  if (params.show_background && has_light) {
    if (light.background.num_pixels() > 0 && params.show == Show::kLit)
      background.emplace(light.background, scale.unit);
    else
      background.emplace(coefficients);
  }
  SurfaceRenderer renderer = params.show == Show::kNormals ? SurfaceRenderer(NormalRenderer())
                                                           : SurfaceRenderer(make_renderer(coefficients, scale.unit));
  FrameParams frame = {params.camera, params.rotate_light, params.exposure, params.curve};
  if (!has_light) frame.exposure = 0, frame.curve = ToneCurve::kNone;
  if (params.mark_negative) {
    const float bright = static_cast<float>(1 / exposed(scale, frame));
    mark_negative(renderer, {bright, 0, bright});
  }
  GpuScene gpu_scene(params.show == Show::kVisibility ? without_colors(scene) : scene, needs_tangents(renderer));
  std::optional<GpuShadows> shadows;
  const Drawing drawing = {gpu_scene, scene_extent(scene), renderer, background ? &*background : nullptr, scale};
  const auto draw = [&](double turn) {
    frame.camera = params.camera;
    frame.camera.azimuth += turn;
    if (params.turn_light) frame.rotate_light = rotation_about_y(-turn * std::numbers::pi / 180) * params.rotate_light;
    if (params.shadows && (params.turn_light || turn == 0)) {
      shadows = GpuShadows(params.shadows->under(rotate(frame.rotate_light, coefficients)));
      gpu_scene.set_shadows(&*shadows);
    }
    frame_renderer.draw(drawing, frame);
    gl::finish();
  };

  draw(0);
  gl::check_errors("the picture");
  RenderResult result;
  result.radiance = frame_renderer.read_radiance();
  result.picture = frame_renderer.read_picture();
  result.gl_renderer = gl_renderer();

  std::vector<double> frame_ms;
  for (int i = 0; i < params.frames; ++i) {
    report_progress(progress, static_cast<double>(i) / params.frames);
    const auto start = std::chrono::steady_clock::now();
    draw(360.0 * i / params.frames);
    frame_ms.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
  }
  report_progress(progress, 1);
  result.frame_ms = median(frame_ms);
  return result;
}

}  // namespace

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
  const RenderLight degree = {keep_degree(light.coefficients, params.degree), {}};
  const HighlightLight highlights =
      make_highlight_light(surfaces, params.show == Show::kDegree ? degree : light, params.bands);
  return render(scene, light, params, progress, [&](const RgbCoefficients& radiance, double unit) {
    return ReflectanceRenderer(surfaces, radiance, params.shade, &highlights, unit);
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
