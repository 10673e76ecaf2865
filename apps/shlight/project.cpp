#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "command.h"
#include "shlight/light/coefficient_file.h"
#include "shlight/sh/project.h"
#include "shlight/sh/sphere_samples.h"

namespace shlight::app {
namespace {

struct ProjectArguments {
  std::string light;
  LoadLightParams load;
  LightShape shape;
  int bands = 3;
  std::string method = "exact";
  int samples = 10000;
  std::uint64_t seed = 1;
  int threads = 0;
  std::filesystem::path output;
  bool split_sun = false;
  bool json = false;
};

RgbCoefficients project(const Light& light, const ProjectArguments& arguments) {
  if (arguments.method == "exact") return light.project(arguments.bands, arguments.threads);
  const SphereSamples samples = make_monte_carlo_samples(arguments.bands, arguments.samples, arguments.seed);
  const auto projection = project_monte_carlo([&](Vec3d d) { return light.radiance(d); }, samples);
  double largest = 0;
  for (const Rgb error : projection.standard_error.values()) largest = std::max({largest, error.r, error.g, error.b});
  spdlog::info("{} samples, largest standard error of a coefficient {:.3g} ({:.3g} of L00's luminance)",
               samples.directions.size(), largest, largest / std::abs(luminance(projection.coefficients[0])));
  return projection.coefficients;
}

void run_project(const ProjectArguments& arguments) {
  const LoadedLight loaded = load_light_aloud(arguments.light, arguments.load);
  std::optional<SunSplit> split;
  if (arguments.split_sun) split = loaded.light->split_sun(arguments.threads);
  const RgbCoefficients projected = project(split ? *split->rest : *loaded.light, arguments);
  const RgbCoefficients coefficients = apply_window(arguments.shape, rotate(arguments.shape.rotation, projected));
  std::optional<Sun> sun;
  if (split) {
    sun = Sun{arguments.shape.rotation(split->sun.direction), split->sun.irradiance};
    spdlog::info("sun: {}", describe_sun(*sun, sun->irradiance + std::sqrt(4 * std::numbers::pi) * projected[0]));
  } else if (arguments.split_sun) {
    spdlog::warn("{}: has no sun, nothing small that outshines the rest; all of it is in the coefficients",
                 loaded.info.name);
  }
  if (loaded.info.bands > 0 && loaded.info.bands < arguments.bands)
    spdlog::warn("{}: holds {} bands; those above are zero", loaded.info.name, loaded.info.bands);
  if (!arguments.output.empty()) save_coefficients(arguments.output, coefficients, sun);
  if (arguments.json)
    print_result(format_coefficients(coefficients, sun));
  else if (arguments.output.empty())
    print_result(table_of(coefficients));
}

}  // namespace

void add_project(CLI::App& program, Run& run) {
  auto* command = program.add_subcommand("project", "Turn a light into spherical-harmonic coefficients");
  const auto arguments = std::make_shared<ProjectArguments>();
  command->add_option("LIGHT", arguments->light, kLightHelp)->required();
  command->add_option("--bands", arguments->bands, "Bands n: n*n coefficients of degrees 0 … n-1")
      ->capture_default_str()
      ->check(CLI::Range(1, 256).description("1 to 256"));
  add_light_options(*command, arguments->load);
  add_shape_options(*command, arguments->shape);
  command->add_flag(
      "--split-sun", arguments->split_sun,
      "Take the sun out: its direction and irradiance go into the file, the coefficients are of the rest");
  command->add_option("--method", arguments->method, "Exact integration, or the thesis's random samples")
      ->capture_default_str()
      ->check(CLI::IsMember({"exact", "monte-carlo"}));
  command->add_option("--samples", arguments->samples, "Samples of monte-carlo, rounded up to a square")
      ->capture_default_str()
      ->check(CLI::Range(9, 100'000'000).description("9 to 100000000"));
  command->add_option("--seed", arguments->seed, "Of monte-carlo: another seed, other samples")->capture_default_str();
  command->add_option("--threads", arguments->threads, "0: all; the result is the same for any number")
      ->capture_default_str()
      ->check(CLI::Range(0, 1024).description("0 to 1024"));
  command->add_option("-o,--output", arguments->output, "Write a coefficient file")
      ->type_name("FILE.json")
      ->check(CLI::Validator([](std::string& name) { return name.empty() ? "the file's name is empty" : ""; }, ""));
  command->add_flag("--json", arguments->json, "Print the coefficient file on stdout");
  command->footer(
      "Examples:\n  shlight project venice.hdr --bands 3 -o venice.json\n"
      "  shlight project noon.hdr --split-sun -o noon.json\n"
      "  shlight project \"fn:max(0, 5*cos(theta)-4)\" --bands 4 --method monte-carlo --samples 10000");
  command->callback([arguments, &run] { run = [arguments] { run_project(*arguments); }; });
}

}  // namespace shlight::app
