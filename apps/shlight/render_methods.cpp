#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>

#include "render.h"
#include "shlight/brdf/make_brdf.h"
#include "shlight/core/error.h"
#include "shlight/core/file.h"
#include "shlight/image/tone_map.h"
#include "shlight/render/context.h"
#include "shlight/scene/load_scene.h"
#include "shlight/transfer/baked_file.h"
#include "shlight/truth/comparison.h"
#include "shlight/truth/heat_map.h"
#include "shlight/truth/image_error.h"
#include "shlight/truth/path_tracer.h"

namespace shlight::app {
namespace {

std::filesystem::path output_of(const RenderArguments& arguments) {
  return arguments.output.empty() && !arguments.json ? "render.png" : arguments.output;
}

// That of --material; none where it is not given.
std::unique_ptr<Brdf> make_material(const RenderArguments& arguments) {
  if (arguments.material.empty()) return nullptr;
  std::vector<std::string> warnings;
  auto brdf = make_brdf(arguments.material, &warnings);
  for (const std::string& warning : warnings) spdlog::warn("{}", warning);
  return brdf;
}

// What a baked file holds, or what is baked now, and what there is to say of it in JSON.
struct TransferToDraw {
  Baked baked;
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
};

// Of a baked file, too, reflectance can be drawn without the shadows in it: --transfer cosine.
bool wants_no_shadows(const RenderArguments& arguments) {
  return arguments.method != "transfer" && arguments.kind_given && arguments.bake.kind == TransferKind::kCosine;
}

// The file as it was baked; refuses options that ask for another bake.
TransferToDraw load_transfer(const RenderArguments& arguments) {
  TransferToDraw result = {load_baked(arguments.model), {}};
  const auto& [scene, transfer, info] = result.baked;
  const std::string accepted = "what it holds, or the model that it was baked from (" + info.model + ")";
  if (arguments.kind_given && arguments.bake.kind != transfer.kind && !wants_no_shadows(arguments))
    throw Error(arguments.model,
                fmt::format("holds {} transfer, not {}", to_text(transfer.kind), to_text(arguments.bake.kind)),
                accepted);
  if (arguments.samples_given && arguments.bake.samples != info.params.samples)
    throw Error(arguments.model, "is baked already: --samples cannot change it", accepted);
  if (arguments.bounces_given && arguments.bake.bounces != info.params.bounces)
    throw Error(arguments.model, "is baked already: --bounces cannot change it", accepted);
  if (arguments.method == "transfer" && arguments.bands_given && arguments.params.bands > transfer.bands)
    throw Error(arguments.model, fmt::format("holds {} bands and not {}", transfer.bands, arguments.params.bands),
                fmt::format("--bands 1 to {}", transfer.bands));
  spdlog::info("{}: {} transfer of {} vertices, {} bands, {}, baked from {}", arguments.model, to_text(transfer.kind),
               transfer.num_vertices(), transfer.bands, describe_storage(info), info.model);
  result.json = {
      {"transfer", to_text(transfer.kind)}, {"vertices", transfer.num_vertices()}, {"baked_bands", transfer.bands}};
  return result;
}

TransferToDraw bake_now(const RenderArguments& arguments, Scene scene) {
  BakeParams params = arguments.bake;
  params.bands = arguments.params.bands;
  TransferToDraw result;
  const Transfer& transfer = result.baked.transfer = bake_aloud(arguments.model, scene, params);
  result.baked.scene = std::move(scene);
  result.json = {
      {"transfer", to_text(transfer.kind)},
      {"vertices", transfer.num_vertices()},
      {"bake_seconds", transfer.seconds},
      {"rays", transfer.rays},
      {"rays_per_second", transfer.seconds > 0 ? static_cast<double>(transfer.rays) / transfer.seconds : 0.0}};
  return result;
}

Scene load_model(const std::string& model) {
  Scene scene = make_scene(model);
  for (const std::string& warning : scene.warnings) spdlog::warn("{}: {}", model, warning);
  return scene;
}

RenderResult draw_reflectance(const RenderArguments& arguments, const Scene& scene, const RenderLight& light,
                              const RenderParams& params, nlohmann::ordered_json& json) {
  ReflectanceTableParams table;
  table.bands = params.bands;
  const auto start = std::chrono::steady_clock::now();
  const auto brdf = make_material(arguments);
  const bool hybrid = arguments.method == "hybrid";
  const auto surfaces =
      brdf ? make_surface_reflectances(scene, *brdf, table, hybrid)
           : make_surface_reflectances(scene, table, hybrid, progress_bar("making reflectance tables"));
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  json.update({{"material", brdf ? arguments.material : "own"},
               {"shade", params.shade == Shade::kPixel ? "pixel" : "vertex"},
               {"table_seconds", seconds}});
  const auto draw = hybrid ? render_hybrid : render_reflectance;
  return draw(scene, surfaces, light, params, progress_bar("drawing"));
}

// Root mean square of the pixels' deviations, relative to the picture's.
double relative_noise(const PathTraceResult& result) {
  double variance = 0, square = 0;
  for (const float v : result.variance.values) variance += double{v};
  for (const float v : result.radiance.values) square += double{v} * double{v};
  return square > 0 ? std::sqrt(variance / square) : 0;
}

// The same picture, path traced.
PathTraceParams make_trace_params(const RenderParams& render) {
  PathTraceParams params;
  params.width = render.width, params.height = render.height;
  params.camera = render.camera;
  params.rotate_light = render.rotate_light;
  params.show_background = render.show_background;
  return params;
}

void run_reference(const RenderArguments& arguments, const Scene& scene, const Light& light,
                   const RenderParams& render) {
  const std::filesystem::path output = output_of(arguments);
  for (const auto& path : {output, arguments.deviation})
    if (!path.empty()) check_writable(path);  // before minutes of work

  PathTraceParams params = make_trace_params(render);
  params.transfer = arguments.bake.kind, params.bounces = arguments.bake.bounces;
  if (arguments.bake.samples > 0) params.samples = arguments.bake.samples;
  const auto brdf = make_material(arguments);
  params.brdf = brdf.get();
  params.gloss = arguments.gloss;
  const PathTraceResult result = trace_paths(scene, light, params, progress_bar("tracing"));

  if (output.extension() == ".exr")
    save_image(output, result.radiance);
  else if (!output.empty())
    save_image8(output, make_picture8(result.radiance, auto_exposure(light.project(1)) * std::exp2(render.exposure),
                                      render.curve));
  if (!arguments.deviation.empty()) {
    Image deviation = result.variance;
    for (float& v : deviation.values) v = std::sqrt(v);
    save_image(arguments.deviation, deviation);
  }
  const double noise = relative_noise(result);
  if (!output.empty())
    spdlog::info("{}: {} x {}, {} triangles, {} paths a pixel, {:.3g} million rays in {:.3g} s, noise {:.2g} %",
                 output.string(), params.width, params.height, num_triangles(scene), result.samples,
                 1e-6 * static_cast<double>(result.rays), result.seconds, 100 * noise);
  if (arguments.json)
    print_json({{"frame_ms", 1000 * result.seconds},
                {"width", params.width},
                {"height", params.height},
                {"triangles", num_triangles(scene)},
                {"gl_renderer", "none"},
                {"method", arguments.method},
                {"transfer", to_text(params.transfer)},
                {"samples", result.samples},
                {"rays", result.rays},
                {"noise", noise}});
}

// What was drawn beside what it approximates and where the two differ, and their errors in JSON.
Image8 compare_with_reference(const RenderArguments& arguments, const Baked& drawn, const Light& light,
                              const RenderParams& render, const RenderResult& result, nlohmann::ordered_json& json) {
  PathTraceParams params = make_trace_params(render);
  params.samples = arguments.compare_samples;
  params.transfer = TransferKind::kCosine;
  if (drawn.transfer.num_vertices() > 0) {
    params.transfer = drawn.transfer.kind;
    params.bounces = is_baked_file(arguments.model) ? drawn.info.params.bounces : arguments.bake.bounces;
  }
  const auto brdf = make_material(arguments);
  params.brdf = brdf.get();
  params.gloss = (arguments.method == "reflectance" || arguments.method == "hybrid") && !brdf;
  const PathTraceResult truth = trace_paths(drawn.scene, light, params, progress_bar("tracing"));
  ImageErrorParams error_params;
  error_params.meaning = Meaning::kRadiance;
  const ImageError error = measure_error(result.radiance, truth.radiance, error_params);
  const double noise = relative_noise(truth);
  json = {{"rmse", error.rmse},           {"relative", error.relative}, {"ssim", error.ssim}, {"flip", error.flip},
          {"max_error", error.max_error}, {"samples", truth.samples},   {"noise", noise}};

  const double exposure = auto_exposure(light.project(1)) * std::exp2(render.exposure);
  const float largest = *std::ranges::max_element(error.flip_map.values);
  const std::string method = arguments.method + (arguments.material.empty() ? "" : " " + arguments.material);
  return make_comparison(
      {{result.picture, {method, fmt::format("{} bands", render.bands)}},
       {make_picture8(truth.radiance, exposure, render.curve),
        {fmt::format("path traced: {}", to_text(params.transfer)),
         fmt::format("{} paths a pixel, noise {:.2g} %", truth.samples, 100 * noise)}},
       {make_heat_map(error.flip_map, largest > 0 ? double{largest} : 1.0),
        {fmt::format("FLIP {:.4f}", error.flip),
         fmt::format("RMSE {:.3g} = {:.3g} %, SSIM {:.4f}", error.rmse, 100 * error.relative, error.ssim)}}});
}

}  // namespace

void run_render(const RenderArguments& arguments) {
  const bool transfer = arguments.method == "transfer";
  const bool is_reflectance = arguments.method == "reflectance" || arguments.method == "hybrid";
  // What is baked shadows surfaces that reflect by tables, too.
  const bool is_baked = (transfer || is_reflectance) && is_baked_file(arguments.model);
  const bool bakes_now =
      !is_baked && (transfer || (is_reflectance && arguments.kind_given && !wants_no_shadows(arguments)));
  TransferToDraw drawn;
  if (is_baked)
    drawn = load_transfer(arguments);
  else
    drawn.baked.scene = load_model(arguments.model);
  const LoadedLight loaded = load_light_aloud(arguments.light, arguments.load);

  RenderParams params = arguments.params;
  if (is_baked && transfer && !arguments.bands_given)
    params.bands = std::min(drawn.baked.transfer.bands, kMaxRenderBands);
  params.show_background = !arguments.no_background;
  params.rotate_light = rotation_about_y(arguments.rotate_light * std::numbers::pi / 180) * arguments.shape.rotation;
  if (arguments.method == "reference") return run_reference(arguments, drawn.baked.scene, *loaded.light, params);
  RenderLight light = make_render_light(*loaded.light, params.bands);
  light.coefficients = apply_window(arguments.shape, light.coefficients);
  const std::filesystem::path output = output_of(arguments);

  if (bakes_now) {
    // What can fail at once is not to fail after minutes of baking.
    if (!output.empty()) check_writable(output);
    { const HeadlessContext can_draw; }
    drawn = bake_now(arguments, std::move(drawn.baked.scene));
  }
  const Scene& scene = drawn.baked.scene;
  std::optional<ShadowRatio> shadows;
  if (wants_no_shadows(arguments)) drawn.baked.transfer = {}, drawn.json.clear();
  if (is_reflectance && drawn.baked.transfer.num_vertices() > 0) shadows.emplace(scene, drawn.baked.transfer);
  params.shadows = shadows ? &*shadows : nullptr;
  const RenderResult result = transfer         ? render_baked(drawn.baked, light, params, progress_bar("drawing"))
                              : is_reflectance ? draw_reflectance(arguments, scene, light, params, drawn.json)
                                               : render_irradiance(scene, light, params, progress_bar("drawing"));

  nlohmann::ordered_json comparison;
  if (arguments.compare) {
    const Image8 picture = compare_with_reference(arguments, drawn.baked, *loaded.light, params, result, comparison);
    if (!output.empty()) save_image8(output, picture);
    spdlog::info("off by {:.3g} % (RMSE), FLIP {:.4f}, from a reference with {:.2g} % noise",
                 100 * comparison["relative"].get<double>(), comparison["flip"].get<double>(),
                 100 * comparison["noise"].get<double>());
  } else if (output.extension() == ".exr") {
    save_image(output, result.radiance);
  } else if (!output.empty()) {
    save_image8(output, result.picture);
  }
  if (!output.empty())
    spdlog::info("{}: {} x {}, {} triangles, {:.1f} ms a frame on {}", output.string(), params.width, params.height,
                 num_triangles(scene), result.frame_ms, result.gl_renderer);
  if (arguments.json) {
    nlohmann::ordered_json json = {{"frame_ms", result.frame_ms},
                                   {"width", params.width},
                                   {"height", params.height},
                                   {"triangles", num_triangles(scene)},
                                   {"gl_renderer", result.gl_renderer},
                                   {"method", arguments.method},
                                   {"bands", params.bands}};
    json.update(drawn.json);
    if (arguments.compare) json["compare"] = comparison;
    print_json(json);
  }
}

}  // namespace shlight::app
