#include "render.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <memory>

#include "shlight/brdf/make_brdf.h"
#include "shlight/truth/path_tracer.h"

namespace shlight::app {
namespace {

// "AZIMUTH,ELEVATION" or "AZIMUTH,ELEVATION,ZOOM"
std::string parse_camera(const std::string& text, Camera& camera) {
  int end = 0;
  const int count =
      std::sscanf(text.c_str(), "%lf,%lf%n,%lf%n", &camera.azimuth, &camera.elevation, &end, &camera.zoom, &end);
  const bool good = count >= 2 && end == static_cast<int>(text.size()) && std::abs(camera.azimuth) <= 1e6 &&
                    std::abs(camera.elevation) <= 90 && camera.zoom >= 0.01 && camera.zoom <= 100;
  return good ? "" : "'" + text + "' is no camera: azimuth, elevation (-90 to 90) in degrees, zoom (0.01 to 100)";
}

// "X,Y,Z"
std::string parse_target(const std::string& text, Vec3d& target) {
  int end = 0;
  const int count = std::sscanf(text.c_str(), "%lf,%lf,%lf%n", &target.x, &target.y, &target.z, &end);
  const auto good = [](double value) { return std::abs(value) <= 100; };
  if (count == 3 && end == static_cast<int>(text.size()) && good(target.x) && good(target.y) && good(target.z))
    return "";
  return "'" + text + "' is no point: three numbers from -100 to 100";
}

// "normals", "visibility", "degree:L"
std::string parse_show(const std::string& text, RenderParams& params) {
  int end = 0;
  if (text == "normals")
    params.show = Show::kNormals;
  else if (text == "visibility")
    params.show = Show::kVisibility;
  else if (std::sscanf(text.c_str(), "degree:%d%n", &params.degree, &end) == 1 &&
           end == static_cast<int>(text.size()) && params.degree >= 0 && params.degree < kMaxRenderBands)
    params.show = Show::kDegree;
  else
    return fmt::format("'{}' is none of normals, visibility, degree:0 to degree:{}", text, kMaxRenderBands - 1);
  return "";
}

// Which options go together; fills in what depends on others.
void check_render_options(const CLI::App& command, RenderArguments& arguments) {
  const auto given = [&](const char* option) { return command.count(option) > 0; };
  if (given("--material") && !given("--method")) arguments.method = "reflectance";
  const std::string& method = arguments.method;
  const bool is_reference = method == "reference", is_reflectance = method == "reflectance" || method == "hybrid";
  for (const char* option : {"--transfer", "--samples", "--bounces"})
    if (given(option) && method == "irradiance")
      throw CLI::ValidationError(option, "not with --method irradiance, which knows no transfer");
  if (is_reflectance && !given("--transfer"))
    for (const char* option : {"--samples", "--bounces"})
      if (given(option)) throw CLI::ValidationError(option, "only with --transfer");
  for (const char* option : {"--bands", "--window", "--mark-negative", "--frames", "--show"})
    if (given(option) && is_reference) throw CLI::ValidationError(option, "not with --method reference");
  for (const char* option : {"--deviation", "--gloss"})
    if (given(option) && !is_reference) throw CLI::ValidationError(option, "only with --method reference");
  if (given("--material") && !is_reflectance && !is_reference)
    throw CLI::ValidationError("--material", "only with --method reflectance, hybrid or reference");
  if (given("--material") && arguments.gloss)
    throw CLI::ValidationError("--gloss", "not with --material, which takes the place of the model's own materials");
  if (given("--shade") && !is_reflectance)
    throw CLI::ValidationError("--shade", "only with --method reflectance or hybrid");
  if (given("--compare") && is_reference) throw CLI::ValidationError("--compare", "not with --method reference");
  if (given("--compare") && arguments.output.extension() == ".exr")
    throw CLI::ValidationError("--compare", "makes a picture as shown: -o FILE.png");
  if (given("--compare-samples") && !given("--compare"))
    throw CLI::ValidationError("--compare-samples", "only with --compare");
  if (given("--bounces") && is_reference && arguments.bake.kind != TransferKind::kInterreflected)
    throw CLI::ValidationError("--bounces", "only with --transfer interreflected");
  const RenderParams& params = arguments.params;
  if (params.show == Show::kVisibility && method != "transfer")
    throw CLI::ValidationError("--show", "visibility only with --method transfer, which knows it");
  if (given("--show") && given("--compare")) throw CLI::ValidationError("--show", "not with --compare");
  if (!is_reference) check_bake_options(command, arguments.bake);
  arguments.kind_given = given("--transfer");
  arguments.samples_given = given("--samples");
  arguments.bounces_given = given("--bounces");
  arguments.bands_given = given("--bands");
  // What is not diffuse needs more.
  if (is_reflectance && !arguments.bands_given) arguments.params.bands = 5;
  if (params.show == Show::kDegree && params.degree >= params.bands)
    throw CLI::ValidationError("--show",
                               fmt::format("{} bands have the degrees 0 to {}", params.bands, params.bands - 1));
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
      ->default_str("3, of reflectance 5")
      ->check(CLI::Range(1, kMaxRenderBands).description(fmt::format("1 to {}", kMaxRenderBands)));
  command
      ->add_option(
          "--method", arguments->method,
          "How the model is lit: by its normals; by what is baked for each vertex, now (--transfer) or before "
          "where MODEL is a file of shlight bake; by how its materials or --material reflect (hybrid: in highlights "
          "all of the light, not only its first bands), shadowed by what is baked, if it is; or path traced "
          "without spherical harmonics, what the others approximate (--transfer, --samples a pixel)")
      ->type_name("irradiance|transfer|reflectance|hybrid|reference")
      ->default_str("irradiance, with --material reflectance")
      ->check(CLI::IsMember({"irradiance", "transfer", "reflectance", "hybrid", "reference"}).description(""));
  command
      ->add_option("--material", arguments->material,
                   "How all surfaces reflect, instead of their own materials, for instance cook-torrance:m=0.3,f0=0.9")
      ->type_name("MATERIAL");
  command->add_option("--shade", params.shade, "Where reflectance is found: at each pixel, or at each vertex, quicker")
      ->transform(
          CLI::CheckedTransformer(std::map<std::string, Shade>{{"pixel", Shade::kPixel}, {"vertex", Shade::kVertex}})
              .description(""))
      ->type_name("pixel|vertex")
      ->default_str("pixel");
  command->add_flag("--gloss", arguments->gloss, "Show the gloss of the model's own materials by --method reference");
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
          "--look-at",
          [&params](const std::string& text) {
            if (const std::string wrong = parse_target(text, params.camera.target); !wrong.empty())
              throw CLI::ValidationError("--look-at", wrong);
          },
          "The point that the camera turns around, from the middle of the model, in radii of it")
      ->type_name("X,Y,Z")
      ->default_str("0,0,0");
  add_size_option(*command, params.width, params.height);
  command->add_option("--rotate-light", arguments->rotate_light, "Turn the light about the vertical, degrees")
      ->capture_default_str()
      ->check(number_from(-36000, 36000));
  command->add_option("--exposure", params.exposure, "Stops brighter than automatic")
      ->capture_default_str()
      ->check(number_from(-60, 60));
  command
      ->add_option("--tone-map", params.curve, "From radiance to a picture: a film's soft curve, or cut off at white")
      ->transform(CLI::CheckedTransformer(
                      std::map<std::string, ToneCurve>{{"filmic", ToneCurve::kFilmic}, {"none", ToneCurve::kNone}})
                      .description(""))
      ->type_name("filmic|none")
      ->default_str("filmic");
  command
      ->add_option_function<std::string>(
          "--show",
          [&params](const std::string& text) {
            if (const std::string wrong = parse_show(text, params); !wrong.empty())
              throw CLI::ValidationError("--show", wrong);
          },
          "Something else than the lit model: its normals, how open its vertices are to light (of --method transfer), "
          "or one degree of the light alone")
      ->type_name("normals|visibility|degree:L");
  command->add_option("--frames", params.frames, "Draw so many frames with the view turning, for the time of one")
      ->capture_default_str()
      ->check(CLI::Range(1, 1'000'000).description("1 to 1000000"));
  command->add_flag("--no-background", arguments->no_background, "Do not draw the light behind the model");
  command->add_flag("--mark-negative", params.mark_negative,
                    "Stripes where light of so few bands is below zero (see --window)");
  command->add_flag("--compare", arguments->compare,
                    "Draw it beside the path-traced reference and their difference (FLIP), with the errors in numbers");
  command->add_option("--compare-samples", arguments->compare_samples, "Paths a pixel of the reference of --compare")
      ->capture_default_str()
      ->check(CLI::Range(1, kMaxPathSamples).description(fmt::format("1 to {}", kMaxPathSamples)));
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
      "  shlight render statue.glb --method transfer --light builtin:studio -o statue.png   (of shlight bake)\n"
      "  shlight render builtin:knot --material ggx:alpha=0.3,f0=0.9/0.6/0.2 --light builtin:studio -o gold.png\n"
      "  shlight render builtin:scene --method reference --transfer shadowed --samples 64 --size 320x180 -o truth.exr\n"
      "  shlight render builtin:knot --bands 3 --size 320x240 --compare -o three_bands.png\n"
      "\nMATERIAL is one of\n" +
      describe_brdf_models());
  command->callback([arguments, command, &run] {
    check_render_options(*command, *arguments);
    run = [arguments] { run_render(*arguments); };
  });
}

}  // namespace shlight::app
