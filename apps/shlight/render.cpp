#include "shlight/render/render.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "command.h"
#include "shlight/core/error.h"
#include "shlight/core/file.h"
#include "shlight/image/tone_map.h"
#include "shlight/scene/load_scene.h"
#include "shlight/truth/path_tracer.h"

namespace shlight::app {
namespace {

struct RenderArguments {
  std::string model = "builtin:scene";
  std::string light = "builtin:sky";
  LoadLightParams load;
  LightShape shape;
  double rotate_light = 0;  // degrees about +Y
  std::string method = "irradiance";
  BakeParams bake;  // --method transfer
  RenderParams params;
  std::filesystem::path output;
  std::filesystem::path deviation;  // --method reference
  bool no_background = false;
  bool json = false;
};

// "WxH"
std::string parse_size(const std::string& text, RenderParams& params) {
  int end = 0;
  if (std::sscanf(text.c_str(), "%5dx%5d%n", &params.width, &params.height, &end) != 2 ||
      end != static_cast<int>(text.size()) || params.width < 1 || params.height < 1)
    return "'" + text + "' is no size such as 1280x720";
  return "";
}

// "AZIMUTH,ELEVATION" or "AZIMUTH,ELEVATION,ZOOM"
std::string parse_camera(const std::string& text, Camera& camera) {
  int end = 0;
  const int count =
      std::sscanf(text.c_str(), "%lf,%lf%n,%lf%n", &camera.azimuth, &camera.elevation, &end, &camera.zoom, &end);
  const bool good = count >= 2 && end == static_cast<int>(text.size()) && std::abs(camera.azimuth) <= 1e6 &&
                    std::abs(camera.elevation) <= 90 && camera.zoom >= 0.01 && camera.zoom <= 100;
  return good ? "" : "'" + text + "' is no camera: azimuth, elevation (-90 to 90) in degrees, zoom (0.01 to 100)";
}

// Root mean square of the pixels' deviations, relative to the picture's.
double relative_noise(const PathTraceResult& result) {
  double variance = 0, square = 0;
  for (const float v : result.variance.values) variance += double{v};
  for (const float v : result.radiance.values) square += double{v} * double{v};
  return square > 0 ? std::sqrt(variance / square) : 0;
}

void run_reference(const RenderArguments& arguments, const Scene& scene, const Light& light,
                   const RenderParams& render) {
  std::filesystem::path output = arguments.output;
  if (output.empty() && !arguments.json) output = "render.png";
  for (const auto& path : {output, arguments.deviation})
    if (!path.empty()) check_writable(path);  // before minutes of work

  PathTraceParams params;
  params.width = render.width, params.height = render.height;
  params.camera = render.camera;
  params.rotate_light = render.rotate_light;
  params.show_background = render.show_background;
  params.transfer = arguments.bake.kind, params.bounces = arguments.bake.bounces;
  if (arguments.bake.samples > 0) params.samples = arguments.bake.samples;
  const PathTraceResult result = trace_paths(scene, light, params, progress_bar("tracing"));

  if (output.extension() == ".exr")
    save_image(output, result.radiance);
  else if (!output.empty())
    save_image8(output, make_picture8(result.radiance, auto_exposure(light.project(1)) * std::exp2(render.exposure)));
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
                {"transfer", transfer_kind_name(params.transfer)},
                {"samples", result.samples},
                {"rays", result.rays},
                {"noise", noise}});
}

void run_render(const RenderArguments& arguments) {
  const Scene scene = make_scene(arguments.model);
  for (const std::string& warning : scene.warnings) spdlog::warn("{}: {}", arguments.model, warning);
  const LoadedLight loaded = load_light_aloud(arguments.light, arguments.load);

  RenderParams params = arguments.params;
  params.show_background = !arguments.no_background;
  params.rotate_light = rotation_about_y(arguments.rotate_light * std::numbers::pi / 180) * arguments.shape.rotation;
  if (arguments.method == "reference") return run_reference(arguments, scene, *loaded.light, params);
  RenderLight light = make_render_light(*loaded.light, params.bands);
  light.coefficients = apply_window(arguments.shape, light.coefficients);

  RenderResult result;
  nlohmann::ordered_json of_bake = nlohmann::ordered_json::object();
  if (arguments.method == "transfer") {
    BakeParams bake = arguments.bake;
    bake.bands = params.bands;
    const Transfer transfer = bake_aloud(arguments.model, scene, bake);
    of_bake = {{"transfer", transfer_kind_name(transfer.kind)},
               {"vertices", transfer.num_vertices()},
               {"bake_seconds", transfer.seconds},
               {"rays", transfer.rays},
               {"rays_per_second", transfer.seconds > 0 ? static_cast<double>(transfer.rays) / transfer.seconds : 0.0}};
    result = render_transfer(scene, transfer, light, params, progress_bar("drawing"));
  } else {
    result = render_irradiance(scene, light, params, progress_bar("drawing"));
  }

  std::filesystem::path output = arguments.output;
  if (output.empty() && !arguments.json) output = "render.png";
  if (output.extension() == ".exr")
    save_image(output, result.radiance);
  else if (!output.empty())
    save_image8(output, result.picture);
  if (!output.empty())
    spdlog::info("{}: {} x {}, {} triangles, {:.1f} ms a frame on {}", output.string(), params.width, params.height,
                 num_triangles(scene), result.frame_ms, result.gl_renderer);
  if (arguments.json) {
    nlohmann::ordered_json json = {{"frame_ms", result.frame_ms},       {"width", params.width},
                                   {"height", params.height},           {"triangles", num_triangles(scene)},
                                   {"gl_renderer", result.gl_renderer}, {"method", arguments.method}};
    json.update(of_bake);
    print_json(json);
  }
}

}  // namespace

void add_render(CLI::App& program, Run& run) {
  auto* command = program.add_subcommand("render", "Draw a model under a light");
  const auto arguments = std::make_shared<RenderArguments>();
  RenderParams& params = arguments->params;
  command->add_option("MODEL", arguments->model, kModelHelp)->capture_default_str();
  command->add_option("--light", arguments->light, kLightHelp)->capture_default_str();
  add_light_options(*command, arguments->load);
  add_shape_options(*command, arguments->shape);
  command->add_option("--bands", params.bands, "Bands of the light's coefficients")
      ->capture_default_str()
      ->check(CLI::Range(1, 10).description("1 to 10"));
  command
      ->add_option(
          "--method", arguments->method,
          "How the model is lit: by its normals, by what is baked for each vertex (--transfer), or path traced "
          "without spherical harmonics, what the others approximate (--transfer, --samples a pixel)")
      ->type_name("irradiance|transfer|reference")
      ->capture_default_str()
      ->check(CLI::IsMember({"irradiance", "transfer", "reference"}).description(""));
  arguments->bake.kind = TransferKind::kInterreflected;
  add_bake_options(*command, arguments->bake);
  command
      ->add_option_function<std::string>(
          "--camera",
          [&params](const std::string& text) {
            if (const std::string wrong = parse_camera(text, params.camera); !wrong.empty())
              throw CLI::ValidationError("--camera", wrong);
          },
          "Around the model: azimuth 0 looks along -Z, 90 along -X")
      ->type_name("AZIMUTH,ELEVATION[,ZOOM]")
      ->default_str(fmt::format("{},{},{}", params.camera.azimuth, params.camera.elevation, params.camera.zoom));
  command
      ->add_option_function<std::string>(
          "--size",
          [&params](const std::string& text) {
            if (const std::string wrong = parse_size(text, params); !wrong.empty())
              throw CLI::ValidationError("--size", wrong);
          },
          "Of the picture in pixels")
      ->type_name("WxH")
      ->default_str(fmt::format("{}x{}", params.width, params.height));
  command->add_option("--rotate-light", arguments->rotate_light, "Turn the light about the vertical, degrees")
      ->capture_default_str()
      ->check(number_from(-36000, 36000));
  command->add_option("--exposure", params.exposure, "Stops brighter than automatic")
      ->capture_default_str()
      ->check(number_from(-60, 60));
  command->add_option("--frames", params.frames, "Draw so many frames with the view turning, for the time of one")
      ->capture_default_str()
      ->check(CLI::Range(1, 1'000'000).description("1 to 1000000"));
  command->add_flag("--no-background", arguments->no_background, "Do not draw the light behind the model");
  command->add_flag("--mark-negative", params.mark_negative,
                    "Stripes where light of so few bands is below zero (see --window)");
  command->add_option("-o,--output", arguments->output, "Picture as shown (.png) or linear radiance (.exr)")
      ->type_name("FILE.png|.exr")
      ->check(CLI::Validator(
          [](std::string& name) {
            const auto extension = std::filesystem::path(name).extension();
            return extension == ".png" || extension == ".exr" ? "" : "'" + name + "' ends neither in .png nor in .exr";
          },
          ""));
  command->add_option("--deviation", arguments->deviation, "Write how noisy each pixel of --method reference is")
      ->type_name("FILE.exr")
      ->check(CLI::Validator(
          [](std::string& name) {
            return std::filesystem::path(name).extension() == ".exr" ? "" : "'" + name + "' does not end in .exr";
          },
          ""));
  command->add_flag("--json", arguments->json, "Print the time of a frame and more on stdout");
  command->footer(
      "Examples:\n  shlight render skull.x --light venice.hdr -o picture.png\n"
      "  shlight render builtin:knot --light builtin:studio --bands 5 --camera 20,10,1.2 -o knot.png\n"
      "  shlight render builtin:scene --method transfer --transfer shadowed --bands 5 -o shadows.png\n"
      "  shlight render builtin:scene --method reference --transfer shadowed --samples 64 --size 320x180 -o truth.exr");
  command->callback([arguments, command, &run] {
    const bool is_reference = arguments->method == "reference";
    for (const char* option : {"--transfer", "--samples", "--bounces"})
      if (command->count(option) > 0 && arguments->method != "transfer" && !is_reference)
        throw CLI::ValidationError(option, "only with --method transfer or reference");
    for (const char* option : {"--bands", "--window", "--mark-negative", "--frames"})
      if (command->count(option) > 0 && is_reference) throw CLI::ValidationError(option, "not with --method reference");
    if (command->count("--deviation") > 0 && !is_reference)
      throw CLI::ValidationError("--deviation", "only with --method reference");
    if (command->count("--bounces") > 0 && is_reference && arguments->bake.kind != TransferKind::kInterreflected)
      throw CLI::ValidationError("--bounces", "only with --transfer interreflected");
    if (!is_reference) check_bake_options(*command, arguments->bake);
    run = [arguments] { run_render(*arguments); };
  });
}

}  // namespace shlight::app
