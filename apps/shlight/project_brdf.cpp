#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>

#include "command.h"
#include "shlight/brdf/make_brdf.h"
#include "shlight/brdf/project_brdf.h"

namespace shlight::app {
namespace {

struct ProjectBrdfArguments {
  std::string material;
  double theta = 0, phi = 0;  // of the view, in degrees
  int bands = 5;
  std::string method = "exact";
  int samples = 10000;
  std::uint64_t seed = 1;
  bool json = false;
};

// What is wrong with the text of a view; nothing where it could be read.
std::string parse_view(const std::string& text, double& theta, double& phi) {
  int end = 0;
  const bool read = std::sscanf(text.c_str(), "%lf,%lf%n", &theta, &phi, &end) == 2;
  const bool good = read && end == static_cast<int>(text.size()) && theta >= 0 && theta < 90 && std::abs(phi) <= 1e6;
  return good ? "" : "'" + text + "' is no view: polar angle (0 to below 90, 0 is the normal) and azimuth in degrees";
}

BrdfProjection project(const Brdf& brdf, const ProjectBrdfArguments& arguments) {
  const double theta = arguments.theta * std::numbers::pi / 180, phi = arguments.phi * std::numbers::pi / 180;
  const Vec3d v = {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
  if (arguments.method == "exact") return project_brdf(brdf, v, arguments.bands);
  const SphereSamples samples = make_monte_carlo_samples(arguments.bands, arguments.samples, arguments.seed);
  return {project_brdf_monte_carlo(brdf, {0, 0, 1}, {1, 0, 0}, v, samples)};
}

void run_project_brdf(const ProjectBrdfArguments& arguments) {
  std::vector<std::string> warnings;
  const auto brdf = make_brdf(arguments.material, &warnings);
  for (const std::string& warning : warnings) spdlog::warn("{}", warning);
  const BrdfProjection projection = project(*brdf, arguments);
  const RgbCoefficients& coefficients = projection.coefficients;
  const Rgb albedo = std::sqrt(4 * std::numbers::pi) * coefficients[0];
  if (!arguments.json) {
    spdlog::info("{}: reflects {:.4g} {:.4g} {:.4g} of uniform light to this view", arguments.material, albedo.r,
                 albedo.g, albedo.b);
    print_result(table_of(coefficients));
    return;
  }
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Rgb c : coefficients.values()) list.push_back({c.r, c.g, c.b});
  print_json({{"material", arguments.material},
              {"view", {{"theta", arguments.theta}, {"phi", arguments.phi}}},
              {"bands", arguments.bands},
              {"method", arguments.method},
              {"change", projection.change},
              {"albedo", {albedo.r, albedo.g, albedo.b}},
              {"coefficients", list}});
}

}  // namespace

void add_project_brdf(CLI::App& program, Run& run) {
  auto* command = program.add_subcommand("project-brdf",
                                         "Turn a material, seen from one side, into spherical-harmonic coefficients");
  const auto arguments = std::make_shared<ProjectBrdfArguments>();
  command->add_option("MATERIAL", arguments->material, "name:key=value,… of the list below; colours as red/green/blue")
      ->required();
  command
      ->add_option_function<std::string>(
          "--view",
          [arguments](const std::string& text) {
            if (const std::string wrong = parse_view(text, arguments->theta, arguments->phi); !wrong.empty())
              throw CLI::ValidationError("--view", wrong);
          },
          "Where it is seen from, in degrees: from the normal, and around it from the tangent")
      ->required()
      ->type_name("THETA,PHI");
  command->add_option("--bands", arguments->bands, "Bands n: n*n coefficients of degrees 0 … n-1")
      ->capture_default_str()
      ->check(CLI::Range(1, 64).description("1 to 64"));
  command->add_option("--method", arguments->method, "Exact integration, or the thesis's random samples")
      ->capture_default_str()
      ->check(CLI::IsMember({"exact", "monte-carlo"}));
  command->add_option("--samples", arguments->samples, "Samples of monte-carlo, rounded up to a square")
      ->capture_default_str()
      ->check(CLI::Range(9, 100'000'000).description("9 to 100000000"));
  command->add_option("--seed", arguments->seed, "Of monte-carlo: another seed, other samples")->capture_default_str();
  command->add_flag("--json", arguments->json, "Print JSON: material, view, bands, change, albedo, coefficients");
  command->footer("Materials, with their ranges:\n" + describe_brdf_models() +
                  "Example:\n  shlight project-brdf cook-torrance:m=0.5,f0=0.9 --view 45,0 --bands 5");
  command->callback([arguments, &run] { run = [arguments] { run_project_brdf(*arguments); }; });
}

}  // namespace shlight::app
