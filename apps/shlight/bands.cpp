#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>

#include "command.h"
#include "shlight/brdf/make_brdf.h"
#include "shlight/core/error.h"
#include "shlight/core/file.h"
#include "shlight/scene/load_scene.h"
#include "shlight/truth/band_error.h"
#include "shlight/truth/band_plot.h"
#include "shlight/truth/model_band_error.h"

namespace shlight::app {
namespace {

struct BandsArguments {
  std::string light, material = "lambert";
  LoadLightParams load;
  LightShape shape;
  BandErrorParams params;
  std::string model;  // empty: all normals
  TransferKind transfer = TransferKind::kShadowed;
  double tolerance = 0.01;
  bool tolerance_given = false;
  std::string measure = "p99";
  std::filesystem::path output;
  bool json = false;
};

// What is asked of the errors, and the answers.
struct Enough {
  std::optional<int> plain, windowed;
};

nlohmann::ordered_json json_of(Vec3d v) {
  return {v.x, v.y, v.z};
}

nlohmann::ordered_json json_of(std::optional<int> bands) {
  return bands ? nlohmann::ordered_json(*bands) : nlohmann::ordered_json();
}

double share(const std::vector<double>& energy, std::size_t l, double total) {
  return total > 0 ? energy[l] / total : 0;
}

nlohmann::ordered_json json_of(const std::vector<BandError>& list, const BandErrors& errors) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < list.size(); ++i) {
    const BandError& error = list[i];
    json.push_back(
        {{"n", error.bands},
         {"rms", error.rms},
         {"p99", error.p99},
         {"max", error.max},
         {"rms_local", error.rms_local},
         {"p99_local", error.p99_local},
         {"max_local", error.max_local},
         {"mean", error.mean},
         {"mean_local", error.mean_local},
         {"worst", {{"normal", json_of(error.worst_normal)}, {"view", json_of(error.worst_view)}}},
         {"worst_local", {{"normal", json_of(error.worst_local_normal)}, {"view", json_of(error.worst_local_view)}}},
         {"light_energy", errors.light_energy[i]},
         {"light_share", share(errors.light_energy, i, errors.light_total)},
         {"reflectance_energy", errors.reflectance_energy[i]},
         {"reflectance_share", share(errors.reflectance_energy, i, errors.reflectance_total)}});
  }
  return json;
}

void print_errors_json(const BandsArguments& arguments, const BandErrors& errors, const Enough& enough) {
  nlohmann::ordered_json json = {{"light", arguments.light},
                                 {"material", arguments.material},
                                 {"measure", arguments.measure},
                                 {"tolerance", arguments.tolerance},
                                 {"enough", json_of(enough.plain)},
                                 {"largest", {errors.largest.r, errors.largest.g, errors.largest.b}},
                                 {"reference_error", errors.reference_error},
                                 {"bands", json_of(errors.bands, errors)}};
  if (!arguments.model.empty()) {
    json["model"] = arguments.model;
    json["transfer"] = to_text(arguments.transfer);
  }
  if (!errors.shaped.empty()) {
    json["window"] = arguments.shape.window;
    json["enough_windowed"] = json_of(enough.windowed);
    json["windowed"] = json_of(errors.shaped, errors);
  }
  print_json(json);
}

std::string table_of_errors(const std::vector<BandError>& list, const BandErrors& errors) {
  std::string text =
      "            error, % of the largest        error, % of the local      energy in the n-th, %\n"
      "   n  n*n      rms     99 %      max      rms     99 %      max      light  reflectance\n";
  for (std::size_t i = 0; i < list.size(); ++i) {
    const BandError& e = list[i];
    text += fmt::format("{:4} {:4} {:8.4g} {:8.4g} {:8.4g} {:8.4g} {:8.4g} {:8.4g}   {:8.4g}     {:8.4g}\n", e.bands,
                        e.bands * e.bands, 100 * e.rms, 100 * e.p99, 100 * e.max, 100 * e.rms_local, 100 * e.p99_local,
                        100 * e.max_local, 100 * share(errors.light_energy, i, errors.light_total),
                        100 * share(errors.reflectance_energy, i, errors.reflectance_total));
  }
  return text;
}

// "normal .58 .57 .57 seen along …"
std::string describe_direction(Vec3d normal, Vec3d view) {
  std::string text = fmt::format("normal {:.3f} {:.3f} {:.3f}", normal.x, normal.y, normal.z);
  if (normal != view) text += fmt::format(", seen from {:.3f} {:.3f} {:.3f}", view.x, view.y, view.z);
  return text;
}

std::string describe_enough(const std::vector<BandError>& list, std::optional<int> enough,
                            const BandsArguments& arguments) {
  const BandMeasure& measure = band_measure(arguments.measure);
  if (!enough)
    return fmt::format("No 1 to {} bands are within {:g} % ({}).\n", list.size(), 100 * arguments.tolerance,
                       measure.meaning);
  const BandError& error = list[static_cast<std::size_t>(*enough - 1)];
  return fmt::format(
      "{} {} enough for {:g} % ({}).\n  Worst there: {:.4g} % of the largest at {};\n"
      "  {:.4g} % of the local at {}.\n",
      *enough, *enough == 1 ? "band is" : "bands are", 100 * arguments.tolerance, measure.meaning, 100 * error.max,
      describe_direction(error.worst_normal, error.worst_view), 100 * error.max_local,
      describe_direction(error.worst_local_normal, error.worst_local_view));
}

void print_errors(const BandsArguments& arguments, const BandErrors& errors, const Enough& enough) {
  std::string text = table_of_errors(errors.bands, errors) + describe_enough(errors.bands, enough.plain, arguments);
  if (!errors.shaped.empty())
    text += "With --window " + arguments.shape.window + ":\n" + table_of_errors(errors.shaped, errors) +
            describe_enough(errors.shaped, enough.windowed, arguments);
  text += fmt::format("The truth is known to {:.2g} % of the largest.\n", 100 * errors.reference_error);
  print_result(text);
}

// A tolerance that was asked for and is never kept, with the best that there is.
void check_reached(const BandsArguments& arguments, const BandErrors& errors, const Enough& enough) {
  const bool windowed = !errors.shaped.empty();
  if (!arguments.tolerance_given || (windowed ? enough.windowed : enough.plain)) return;
  const std::vector<BandError>& list = windowed ? errors.shaped : errors.bands;
  const BandMeasure& measure = band_measure(arguments.measure);
  const auto best = std::ranges::min_element(list, {}, measure.value);
  throw Error(arguments.light,
              fmt::format("no 1 to {} bands come within --tolerance {:g} ({}); the best are {}, with {:.4g}",
                          list.size(), arguments.tolerance, measure.meaning, best->bands, *best.*measure.value),
              "a larger tolerance, more --bands or another --measure");
}

std::optional<BandErrors> measure(const BandsArguments& arguments, const Light& light, const Brdf& brdf,
                                  const BandErrorParams& params) {
  if (arguments.model.empty()) return measure_band_errors(light, brdf, params);
  const Scene scene = make_scene(arguments.model);
  for (const std::string& warning : scene.warnings) spdlog::warn("{}: {}", arguments.model, warning);
  ModelBandErrorParams of_model;
  of_model.errors = params;
  of_model.shadowed = arguments.transfer == TransferKind::kShadowed;
  return measure_model_band_errors(light, scene, of_model, progress_bar("tracing"));
}

void run_bands(const BandsArguments& arguments) {
  std::vector<std::string> warnings;
  const auto brdf = make_brdf(arguments.material, &warnings);
  for (const std::string& warning : warnings) spdlog::warn("{}", warning);
  if (!arguments.output.empty()) check_writable(arguments.output);
  const LoadedLight loaded = load_light_aloud(arguments.light, arguments.load);

  BandErrorParams params = arguments.params;
  if (arguments.shape.window != "none")
    params.shape = [&](const RgbCoefficients& c) { return apply_window(arguments.shape, c); };
  const auto measured = measure(arguments, *loaded.light, *brdf, params);
  if (!measured)
    throw Error(arguments.light, "gives no light that " + arguments.material + " reflects",
                "a light that is not black");
  const BandErrors& errors = *measured;
  const BandMeasure& measure = band_measure(arguments.measure);
  const Enough enough = {find_enough_bands(errors.bands, measure.value, arguments.tolerance),
                         find_enough_bands(errors.shaped, measure.value, arguments.tolerance)};
  if (!arguments.output.empty()) {
    const std::string name =
        loaded.info.kind == LightInfo::Kind::kFormula || loaded.info.kind == LightInfo::Kind::kBuiltin
            ? arguments.light
            : std::filesystem::path(arguments.light).filename().string();
    write_file(arguments.output,
               make_band_plot(errors, {name + " on " + (arguments.model.empty() ? arguments.material : arguments.model),
                                       arguments.measure, arguments.tolerance, "window " + arguments.shape.window}));
  }
  if (arguments.json)
    print_errors_json(arguments, errors, enough);
  else
    print_errors(arguments, errors, enough);
  check_reached(arguments, errors, enough);
}

}  // namespace

void add_bands(CLI::App& program, Run& run) {
  auto* command = program.add_subcommand("bands", "Measure how many bands a light and a material need");
  const auto arguments = std::make_shared<BandsArguments>();
  command->add_option("--light", arguments->light, kLightHelp)->required()->type_name("LIGHT");
  command->add_option("--material", arguments->material, "name:key=value,… of the list below")
      ->capture_default_str()
      ->type_name("MATERIAL");
  add_light_options(*command, arguments->load);
  add_window_option(*command, arguments->shape);
  command->add_option("--bands", arguments->params.max_bands, "The most bands that are tried")
      ->capture_default_str()
      ->check(CLI::Range(1, kMaxErrorBands).description(fmt::format("1 to {}", kMaxErrorBands)));
  command
      ->add_option("--tolerance", arguments->tolerance,
                   "The error that is small enough, 0.01 being 1 %; if given, exit with 1 where no number of bands "
                   "keeps it")
      ->capture_default_str()
      ->check(number_from(1e-9, 1e9).description(""));
  command
      ->add_option("--model", arguments->model,
                   "On the normals of this model, white and Lambertian, by area, instead of on all normals")
      ->type_name("MODEL");
  command->add_option("--transfer", arguments->transfer, "Whether the model stands in its own light")
      ->transform(CLI::CheckedTransformer(std::map<std::string, TransferKind>{{"cosine", TransferKind::kCosine},
                                                                              {"shadowed", TransferKind::kShadowed}})
                      .description(""))
      ->type_name("cosine|shadowed")
      ->default_str("shadowed");
  std::vector<std::string> measures;
  for (const BandMeasure& measure : band_measures()) measures.push_back(measure.name);
  command
      ->add_option("--measure", arguments->measure,
                   "What the tolerance is about: root mean square, 99 % of the directions or the maximum; of the "
                   "largest radiance anywhere, or of the local")
      ->capture_default_str()
      ->type_name("rms|p99|max|rms_local|p99_local|max_local")
      ->check(CLI::IsMember(measures).description(""));
  command->add_option("--threads", arguments->params.threads, "0: all; the result is the same for any number")
      ->capture_default_str()
      ->check(CLI::Range(0, 1024).description("0 to 1024"));
  command->add_option("-o,--output", arguments->output, "Write a plot")
      ->type_name("FILE.svg")
      ->check(CLI::Validator(
          [](std::string& name) {
            return std::filesystem::path(name).extension() == ".svg" ? "" : "'" + name + "' does not end in .svg";
          },
          ""));
  command->add_flag("--json", arguments->json, "Print all of it on stdout as JSON");
  command->footer(
      "Errors are of the light that a surface sends to an eye, against all bands; \"local\" ones are relative to what\n"
      "there is in the same direction, where that is more than a thousandth of the largest.\n\n"
      "Examples:\n  shlight bands --light venice.hdr -o venice.svg\n"
      "  shlight bands --light venice.hdr --material cook-torrance:m=0.3,f0=0.9 --measure max --tolerance 0.05\n"
      "  shlight bands --light venice.hdr --model skull.x --bands 6\n"
      "\nMATERIAL is one of\n" +
      describe_brdf_models());
  command->callback([arguments, command, &run] {
    const bool of_model = command->count("--model") > 0;
    if (of_model && command->count("--material") > 0)
      throw CLI::ValidationError("--material", "not with --model, which is white and Lambertian");
    if (!of_model && command->count("--transfer") > 0) throw CLI::ValidationError("--transfer", "only with --model");
    if (of_model && arguments->params.max_bands > kMaxTransferBands)
      throw CLI::ValidationError("--bands", fmt::format("at most {} with --model", kMaxTransferBands));
    arguments->tolerance_given = command->count("--tolerance") > 0;
    run = [arguments] { run_bands(*arguments); };
  });
}

}  // namespace shlight::app
