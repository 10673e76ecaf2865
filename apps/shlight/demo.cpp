#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <nlohmann/json.hpp>
#include <system_error>

#include "command.h"
#include "shlight/core/error.h"
#include "shlight/light/coefficient_file.h"
#include "shlight/render/render.h"
#include "shlight/scene/load_scene.h"

namespace shlight::app {
namespace {

struct DemoArguments {
  std::filesystem::path folder = "demo";
  bool json = false;
};

// One picture of the demo. Everything in it is built in.
struct Shot {
  const char* file;
  const char* model;
  const char* light;
  RenderParams params;
};

RenderParams shot_params(Camera camera, int bands, double exposure = 0) {
  RenderParams params;
  params.width = 1280, params.height = 720;
  params.camera = camera;
  params.bands = bands;
  params.exposure = exposure;
  return params;
}

std::vector<Shot> shots() {
  std::vector<Shot> all = {
      {"scene_sky.png", "builtin:scene", "builtin:sky", shot_params({30, 7, 1.15}, 3, 0.6)},
      {"scene_evening.png", "builtin:scene", "builtin:sky:elevation=8,azimuth=-110,turbidity=3",
       shot_params({35, 6, 1.15}, 3, 0.4)},
      {"scene_studio.png", "builtin:scene", "builtin:studio", shot_params({30, 14, 1.1}, 3, 0.4)},
      {"knot_studio.png", "builtin:knot", "builtin:studio", shot_params({20, 12}, 3, 0.4)},
  };
  // A sphere among spots on the axes, from two sides that show all six: each faces the sphere's part of its colour.
  for (const auto& [file, camera] : {std::pair{"axes_from_above.png", Camera{45, 35, 0.7, 100}},
                                     {"axes_from_below.png", Camera{225, -35, 0.7, 100}}})
    all.push_back({file, "builtin:sphere", "builtin:axes", shot_params(camera, 3)});
  // How the thesis's light of two lobes sharpens with the number of bands.
  for (const auto& [file, bands] : {std::pair{"thesis_1_band.png", 1},
                                    {"thesis_2_bands.png", 2},
                                    {"thesis_3_bands.png", 3},
                                    {"thesis_5_bands.png", 5},
                                    {"thesis_9_bands.png", 9}})
    all.push_back({file, "builtin:sphere", "builtin:thesis", shot_params({100, 20}, bands)});
  return all;
}

void run_demo(const DemoArguments& arguments) {
  std::error_code failed;
  std::filesystem::create_directories(arguments.folder, failed);
  if (failed)
    throw Error(arguments.folder.string(), "cannot be made (" + failed.message() + ")", "a folder in a writable place");

  nlohmann::ordered_json files = nlohmann::ordered_json::array();
  const auto made = [&](const std::filesystem::path& path, const std::string& what) {
    spdlog::info("{}: {}", path.string(), what);
    files.push_back(path.string());
  };
  const std::vector<Shot> all = shots();
  const Progress progress = progress_bar("demo");
  for (std::size_t i = 0; i < all.size(); ++i) {
    report_progress(progress, static_cast<double>(i) / static_cast<double>(all.size()));
    const Shot& shot = all[i];
    const LoadedLight loaded = load_light(shot.light);
    const RenderLight light = make_render_light(*loaded.light, shot.params.bands);
    const RenderResult result = render_irradiance(make_scene(shot.model), light, shot.params);
    save_image8(arguments.folder / shot.file, result.picture);
    made(arguments.folder / shot.file, fmt::format("{} under {}, {} bands", shot.model, shot.light, shot.params.bands));
    const auto coefficients = std::filesystem::path(shot.file).replace_extension(".json");
    save_coefficients(arguments.folder / coefficients, light.coefficients);
    made(arguments.folder / coefficients, "the light's coefficients");
  }
  report_progress(progress, 1);
  if (arguments.json) print_json({{"files", files}});
}

}  // namespace

void add_demo(CLI::App& program, Run& run) {
  auto* command = program.add_subcommand("demo", "Make pictures from what is built in, no files needed");
  const auto arguments = std::make_shared<DemoArguments>();
  command->add_option("-o,--output", arguments->folder, "Folder for the pictures, made if missing")
      ->capture_default_str()
      ->type_name("DIR");
  command->add_flag("--json", arguments->json, "Print the files' names on stdout");
  command->footer("Example:\n  shlight demo -o demo");
  command->callback([arguments, &run] { run = [arguments] { run_demo(*arguments); }; });
}

}  // namespace shlight::app
