#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <cstdio>
#include <nlohmann/json.hpp>
#include <vector>

#include "command.h"
#include "shlight/brdf/make_brdf.h"
#include "shlight/core/error.h"
#include "shlight/core/quantile.h"
#include "shlight/render/render.h"
#include "shlight/scene/load_scene.h"

namespace shlight::app {
namespace {

struct BenchArguments {
  std::string model = "builtin:knot";
  std::string light = "builtin:sky";
  LoadLightParams load;
  std::string material = "ggx:alpha=0.3,f0=0.9/0.6/0.3", grooved = "ggx-aniso:ax=0.1,ay=0.4,f0=0.9/0.6/0.3";
  int rounds = 5;
  RenderParams params;
  bool json = false;
};

// One method's frames, drawn anew in each round.
struct TimedMethod {
  std::string name;
  std::function<RenderResult(const Progress&)> draw;
  std::vector<double> ms = {}, ratios = {};  // a round each; ratios to the first method's of the same round
};

// What every method draws from.
struct BenchScene {
  Scene scene;
  RenderLight nine, light;  // 3 bands, and those asked for
  Transfer transfer;
  std::vector<SurfaceReflectance> isotropic, grooved, isotropic_hybrid, grooved_hybrid;
};

BenchScene make_bench_scene(const BenchArguments& arguments) {
  const int bands = arguments.params.bands;
  BenchScene bench;
  bench.scene = make_scene(arguments.model);
  const LoadedLight loaded = load_light_aloud(arguments.light, arguments.load);
  bench.nine = make_render_light(*loaded.light, 3);
  bench.light = {loaded.light->project(bands), bench.nine.background};
  BakeParams bake;
  bake.kind = TransferKind::kCosine;
  bake.bands = bands;
  bench.transfer = bake_transfer(bench.scene, bake, watch(progress_bar("making transfer")));
  ReflectanceTableParams table;
  table.bands = bands;
  const auto isotropic = make_brdf(arguments.material), grooved = make_brdf(arguments.grooved);
  bench.isotropic = make_surface_reflectances(bench.scene, *isotropic, table);
  bench.grooved = make_surface_reflectances(bench.scene, *grooved, table);
  bench.isotropic_hybrid = make_surface_reflectances(bench.scene, *isotropic, table, true);
  bench.grooved_hybrid = make_surface_reflectances(bench.scene, *grooved, table, true);
  return bench;
}

std::vector<TimedMethod> make_methods(const BenchScene& bench, const RenderParams& params) {
  RenderParams nine = params, vertex = params;
  nine.bands = 3;
  vertex.shade = Shade::kVertex;
  const auto reflectance = [&bench](const std::vector<SurfaceReflectance>& surfaces, const RenderParams& how) {
    return [&bench, &surfaces, how](const Progress& p) {
      return render_reflectance(bench.scene, surfaces, bench.light, how, p);
    };
  };
  const auto hybrid = [&bench, &params](const std::vector<SurfaceReflectance>& surfaces) {
    return [&bench, &surfaces, &params](const Progress& p) {
      return render_hybrid(bench.scene, surfaces, bench.light, params, p);
    };
  };
  return {{"irradiance, nine coefficients",
           [&bench, nine](const Progress& p) { return render_irradiance(bench.scene, bench.nine, nine, p); }},
          {"irradiance",
           [&bench, &params](const Progress& p) { return render_irradiance(bench.scene, bench.light, params, p); }},
          {"transfer",
           [&bench, &params](const Progress& p) {
             return render_transfer(bench.scene, bench.transfer, bench.light, params, p);
           }},
          {"reflectance, per vertex", reflectance(bench.isotropic, vertex)},
          {"reflectance, per pixel", reflectance(bench.isotropic, params)},
          {"reflectance, grooved, per vertex", reflectance(bench.grooved, vertex)},
          {"reflectance, grooved, per pixel", reflectance(bench.grooved, params)},
          {"hybrid", hybrid(bench.isotropic_hybrid)},
          {"hybrid, grooved", hybrid(bench.grooved_hybrid)}};
}

void run_bench(const BenchArguments& arguments) {
  const BenchScene bench = make_bench_scene(arguments);
  std::vector<TimedMethod> methods = make_methods(bench, arguments.params);
  std::string gl_renderer;
  for (int round = 0; round < arguments.rounds; ++round)
    for (TimedMethod& method : methods) {
      const RenderResult result = method.draw(progress_bar(method.name));
      gl_renderer = result.gl_renderer;
      method.ms.push_back(result.frame_ms);
      method.ratios.push_back(result.frame_ms / methods.front().ms.back());
    }

  const RenderParams& params = arguments.params;
  if (arguments.json) {
    nlohmann::ordered_json json = {
        {"width", params.width}, {"height", params.height},    {"triangles", num_triangles(bench.scene)},
        {"bands", params.bands}, {"gl_renderer", gl_renderer}, {"methods", nlohmann::ordered_json::array()}};
    for (const TimedMethod& method : methods)
      json["methods"].push_back(
          {{"method", method.name}, {"frame_ms", median(method.ms)}, {"ratio", median(method.ratios)}});
    return print_json(json);
  }
  std::string text = fmt::format(
      "{}: {} triangles at {} x {}, {} bands, light and view turning, on {}\n\n"
      "  {:<34} {:>10} {:>14} {:>8}\n",
      arguments.model, num_triangles(bench.scene), params.width, params.height, params.bands, gl_renderer, "method",
      "ms a frame", "frames/second", "ratio");
  for (const TimedMethod& method : methods)
    text += fmt::format("  {:<34} {:>10.2f} {:>14.1f} {:>8.2f}\n", method.name, median(method.ms),
                        1000 / median(method.ms), median(method.ratios));
  print_result(text);
}

}  // namespace

void add_bench(CLI::App& program, Run& run) {
  auto* bench = program.add_subcommand("bench", "Measure how long this machine takes");
  bench->require_subcommand(1);
  bench->footer("Example:\n  shlight bench render head.x --light venice.hdr");
  auto* command = bench->add_subcommand("render", "Frame times of every method of drawing, in one table");
  const auto arguments = std::make_shared<BenchArguments>();
  RenderParams& params = arguments->params;
  params.width = 1440, params.height = 900;
  params.bands = 5;
  params.frames = 8;
  params.turn_light = true;
  command->add_option("MODEL", arguments->model, kModelHelp)->capture_default_str();
  command->add_option("--light", arguments->light, kLightHelp)->capture_default_str();
  add_light_options(*command, arguments->load);
  command->add_option("--bands", params.bands, "Bands of light and reflectance")
      ->capture_default_str()
      ->check(CLI::Range(1, kMaxRenderBands).description(fmt::format("1 to {}", kMaxRenderBands)));
  add_size_option(*command, params.width, params.height);
  command->add_option("--frames", params.frames, "Frames of each method in a round; light and view turn once around")
      ->capture_default_str()
      ->check(CLI::Range(1, 1'000'000).description("1 to 1000000"));
  command->add_option("--rounds", arguments->rounds, "Rounds of all methods; medians over them are printed")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000).description("1 to 1000"));
  command->add_flag("--json", arguments->json, "Print the table on stdout as JSON");
  command->footer(
      "Ratios are to the nine coefficients of irradiance in the same round. Grooved is an anisotropic material.\n\n"
      "Example:\n  shlight bench render head.x --light venice.hdr");
  command->callback([arguments, &run] { run = [arguments] { run_bench(*arguments); }; });
}

}  // namespace shlight::app
