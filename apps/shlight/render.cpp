#include "shlight/render/render.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <numbers>

#include "command.h"
#include "shlight/core/error.h"
#include "shlight/core/file.h"
#include "shlight/render/context.h"
#include "shlight/scene/load_scene.h"
#include "shlight/transfer/baked_file.h"

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
  bool kind_given = false, samples_given = false, bounces_given = false, bands_given = false;
  RenderParams params;
  std::filesystem::path output;
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

// What a baked file holds, or what is baked now, and what there is to say of it in JSON.
struct TransferToDraw {
  Baked baked;
  nlohmann::ordered_json json;
};

// The file as it was baked; refuses options that ask for another bake.
TransferToDraw load_transfer(const RenderArguments& arguments) {
  TransferToDraw result = {load_baked(arguments.model), {}};
  const auto& [scene, transfer, info] = result.baked;
  const std::string accepted = "what it holds, or the model that it was baked from (" + info.model + ")";
  if (arguments.kind_given && arguments.bake.kind != transfer.kind)
    throw Error(arguments.model,
                fmt::format("holds {} transfer, not {}", to_text(transfer.kind), to_text(arguments.bake.kind)),
                accepted);
  if (arguments.samples_given && arguments.bake.samples != info.params.samples)
    throw Error(arguments.model, "is baked already: --samples cannot change it", accepted);
  if (arguments.bounces_given && arguments.bake.bounces != info.params.bounces)
    throw Error(arguments.model, "is baked already: --bounces cannot change it", accepted);
  if (arguments.bands_given && arguments.params.bands > transfer.bands)
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

void run_render(const RenderArguments& arguments) {
  const bool transfer = arguments.method == "transfer";
  const bool is_baked = transfer && is_baked_file(arguments.model);
  TransferToDraw drawn;
  if (is_baked)
    drawn = load_transfer(arguments);
  else
    drawn.baked.scene = load_model(arguments.model);
  const LoadedLight loaded = load_light_aloud(arguments.light, arguments.load);

  RenderParams params = arguments.params;
  if (is_baked && !arguments.bands_given) params.bands = std::min(drawn.baked.transfer.bands, kMaxRenderBands);
  params.show_background = !arguments.no_background;
  params.rotate_light = rotation_about_y(arguments.rotate_light * std::numbers::pi / 180) * arguments.shape.rotation;
  RenderLight light = make_render_light(*loaded.light, params.bands);
  light.coefficients = apply_window(arguments.shape, light.coefficients);
  std::filesystem::path output = arguments.output;
  if (output.empty() && !arguments.json) output = "render.png";

  if (transfer && !is_baked) {
    // What can fail at once is not to fail after minutes of baking.
    if (!output.empty()) check_writable(output);
    { const HeadlessContext can_draw; }
    drawn = bake_now(arguments, std::move(drawn.baked.scene));
  }
  const Scene& scene = drawn.baked.scene;
  const RenderResult result = transfer ? render_baked(drawn.baked, light, params, progress_bar("drawing"))
                                       : render_irradiance(scene, light, params, progress_bar("drawing"));

  if (output.extension() == ".exr")
    save_image(output, result.radiance);
  else if (!output.empty())
    save_image8(output, result.picture);
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
  command
      ->add_option("--bands", params.bands,
                   "Bands of the light's coefficients; of a baked file, if not given, all of its bands")
      ->capture_default_str()
      ->check(CLI::Range(1, kMaxRenderBands).description(fmt::format("1 to {}", kMaxRenderBands)));
  command
      ->add_option("--method", arguments->method,
                   "How the model is lit: by its normals, or by what is baked for each vertex: now (--transfer), or "
                   "before where MODEL is a file of shlight bake")
      ->type_name("irradiance|transfer")
      ->capture_default_str()
      ->check(CLI::IsMember({"irradiance", "transfer"}).description(""));
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
  command->add_flag("--json", arguments->json, "Print the time of a frame and more on stdout");
  command->footer(
      "Examples:\n  shlight render skull.x --light venice.hdr -o picture.png\n"
      "  shlight render builtin:knot --light builtin:studio --bands 5 --camera 20,10,1.2 -o knot.png\n"
      "  shlight render builtin:scene --method transfer --transfer shadowed --bands 5 -o shadows.png\n"
      "  shlight render statue.glb --method transfer --light builtin:studio -o statue.png   (of shlight bake)");
  command->callback([arguments, command, &run] {
    for (const char* option : {"--transfer", "--samples", "--bounces"})
      if (command->count(option) > 0 && arguments->method != "transfer")
        throw CLI::ValidationError(option, "only with --method transfer");
    check_bake_options(*command, arguments->bake);
    arguments->kind_given = command->count("--transfer") > 0;
    arguments->samples_given = command->count("--samples") > 0;
    arguments->bounces_given = command->count("--bounces") > 0;
    arguments->bands_given = command->count("--bands") > 0;
    run = [arguments] { run_render(*arguments); };
  });
}

}  // namespace shlight::app
