#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

#include "command.h"
#include "shlight/core/error.h"
#include "shlight/core/file.h"
#include "shlight/image/image_io.h"
#include "shlight/image/pixel_report.h"
#include "shlight/truth/heat_map.h"
#include "shlight/truth/image_error.h"

namespace shlight::app {
namespace {

struct CompareArguments {
  std::string test, reference;
  LoadImageParams load;
  ImageErrorParams error;
  bool repair = false;
  std::string show = "flip";
  std::optional<double> most_rmse, most_relative, least_psnr, least_ssim, most_flip, most_error;
  std::filesystem::path output;
  bool json = false;
};

// Formats of floats hold radiance, others what is shown.
Meaning meaning_of(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const bool is_radiance = ending == ".exr" || ending == ".hdr" || ending == ".pic" || ending == ".pfm" ||
                           ending == ".float" || ending == ".dds";
  return is_radiance ? Meaning::kRadiance : Meaning::kShown;
}

Image load(const std::string& path, const CompareArguments& arguments) {
  LoadedImage loaded = load_image(path, arguments.load);
  for (const std::string& warning : loaded.warnings) spdlog::warn("{}: {}", path, warning);
  if (!arguments.repair) return std::move(loaded.image);
  const PixelReport report = report_pixels(loaded.image);
  if (report.nan + report.inf > 0) spdlog::warn("{}: {}", path, describe(report));
  repair_pixels(loaded.image);
  return std::move(loaded.image);
}

nlohmann::ordered_json json_of(Rgb c) {
  return {c.r, c.g, c.b};
}

// Infinity, of equal pictures, has no number in JSON: null.
nlohmann::ordered_json json_of(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json();
}

void print_error(const CompareArguments& arguments, const ImageError& error, const Image& image) {
  if (arguments.json) {
    nlohmann::ordered_json json = {{"rmse", error.rmse},
                                   {"relative", json_of(error.relative)},
                                   {"psnr", json_of(error.psnr)},
                                   {"ssim", error.ssim},
                                   {"flip", error.flip},
                                   {"max_error", error.max_error},
                                   {"width", image.width},
                                   {"height", image.height},
                                   {"values", arguments.error.meaning == Meaning::kShown ? "shown" : "radiance"},
                                   {"worst", nlohmann::ordered_json::array()}};
    for (const WorstPixel& worst : error.worst)
      json["worst"].push_back({{"x", worst.pixel.x},
                               {"y", worst.pixel.y},
                               {"error", worst.error},
                               {"a", json_of(worst.test)},
                               {"b", json_of(worst.reference)}});
    return print_json(json);
  }
  std::string text = fmt::format(
      "{} x {} pixels of {}\n"
      "  RMSE {:.6g}, {:.4g} % of B, largest {:.6g}\n"
      "  PSNR {:.2f} dB, SSIM {:.5f}, FLIP {:.5f} ({:g} pixels a degree)\n",
      image.width, image.height,
      arguments.error.meaning == Meaning::kShown ? "what is shown, sRGB from 0 to 1" : "linear radiance", error.rmse,
      100 * error.relative, error.max_error, error.psnr, error.ssim, error.flip,
      arguments.error.flip.pixels_per_degree);
  if (!error.worst.empty()) text += "  worst pixels:\n";
  for (const WorstPixel& worst : error.worst)
    text += fmt::format("    {:5d},{:5d}  off by {:.4g}: {:.4g} {:.4g} {:.4g}, B {:.4g} {:.4g} {:.4g}\n", worst.pixel.x,
                        worst.pixel.y, worst.error, worst.test.r, worst.test.g, worst.test.b, worst.reference.r,
                        worst.reference.g, worst.reference.b);
  print_result(text);
}

// NaN passes no threshold.
void check_most(const std::string& name, const char* what, double value, std::optional<double> most) {
  if (most && !(value <= *most))
    throw Error(name, fmt::format("{} {:.6g}", what, value), fmt::format("at most {:g}", *most));
}
void check_least(const std::string& name, const char* what, double value, std::optional<double> least) {
  if (least && !(value >= *least))
    throw Error(name, fmt::format("{} {:.6g}", what, value), fmt::format("at least {:g}", *least));
}

void run_compare(const CompareArguments& given) {
  CompareArguments arguments = given;
  arguments.error.meaning = meaning_of(arguments.reference);
  if (meaning_of(arguments.test) != arguments.error.meaning)
    throw Error(arguments.test, "one of the pictures holds radiance and the other what is shown",
                "two pictures of one kind");
  if (!arguments.output.empty()) check_writable(arguments.output);
  const Image test = load(arguments.test, arguments), reference = load(arguments.reference, arguments);
  check_comparable(test, arguments.test, reference, arguments.reference);

  const ImageError error = measure_error(test, reference, arguments.error);
  if (!arguments.output.empty()) {
    const bool is_flip = arguments.show == "flip";
    // The scale of differences ends at the largest, of FLIP at the largest that there can be.
    const double largest = is_flip || error.max_error == 0 ? 1 : error.max_error;
    save_image8(arguments.output, make_heat_map(is_flip ? error.flip_map : error.difference, largest));
    spdlog::info("{}: {} at each pixel, from 0 to {:g}", arguments.output.string(), is_flip ? "FLIP" : "the difference",
                 largest);
  }
  print_error(arguments, error, test);

  check_most(arguments.test, "RMSE", error.rmse, arguments.most_rmse);
  check_most(arguments.test, "relative error", error.relative, arguments.most_relative);
  check_least(arguments.test, "PSNR", error.psnr, arguments.least_psnr);
  check_least(arguments.test, "SSIM", error.ssim, arguments.least_ssim);
  check_most(arguments.test, "FLIP", error.flip, arguments.most_flip);
  check_most(arguments.test, "largest error", error.max_error, arguments.most_error);
}

}  // namespace

void add_compare(CLI::App& program, Run& run) {
  auto* command = program.add_subcommand("compare", "Measure how far a picture is from another");
  const auto arguments = std::make_shared<CompareArguments>();
  command->add_option("A", arguments->test, "A picture: what is shown (.png …) or radiance (.exr, .hdr)")->required();
  command->add_option("B", arguments->reference, "The reference, of the same size and kind")->required();
  command->add_option("-o,--output", arguments->output, "Write a heat map of what differs, with a scale")
      ->type_name("DIFF.png")
      ->check(CLI::Validator(
          [](std::string& name) {
            return std::filesystem::path(name).extension() == ".png" ? "" : "'" + name + "' does not end in .png";
          },
          ""));
  command->add_option("--show", arguments->show, "What the heat map shows: FLIP, or the largest channel's difference")
      ->type_name("flip|difference")
      ->capture_default_str()
      ->check(CLI::IsMember({"flip", "difference"}).description(""));
  command->add_option("--pixels-per-degree", arguments->error.flip.pixels_per_degree, "Of the observer, for FLIP")
      ->capture_default_str()
      ->check(number_from(5, 500));
  command->add_option("--worst", arguments->error.num_worst, "List so many of the worst pixels")
      ->capture_default_str()
      ->check(CLI::Range(0, 1000).description("0 to 1000"));
  command->add_flag("--repair", arguments->repair,
                    "Take pixels that are not finite as 0; without, such pictures are refused");
  const double largest = std::numeric_limits<float>::max();
  const auto add_threshold = [&](const char* name, std::optional<double>& value, const char* help) {
    command->add_option(name, value, help)->check(number_from(-largest, largest).description(""))->group("Thresholds");
  };
  add_threshold("--max-rmse", arguments->most_rmse, "Exit with 1 where the root mean square error is larger");
  add_threshold("--max-relative", arguments->most_relative, "… where it is larger relative to B's root mean square");
  add_threshold("--min-psnr", arguments->least_psnr, "… where the peak signal-to-noise ratio is smaller, dB");
  add_threshold("--min-ssim", arguments->least_ssim, "… where the structural similarity is smaller");
  add_threshold("--max-flip", arguments->most_flip, "… where FLIP is larger");
  add_threshold("--max-error", arguments->most_error, "… where any channel of any pixel is off by more");
  command->add_flag("--json", arguments->json, "Print all of it on stdout as JSON");
  command->footer(
      "Differences are of sRGB values from 0 to 1 for what is shown, of linear values for radiance. FLIP of radiance "
      "is\n"
      "HDR-FLIP; its SSIM is of both pictures tone mapped, with B's mean at middle grey.\n\n"
      "Examples:\n  shlight compare now.png approved.png --max-flip 0.01 -o difference.png\n"
      "  shlight compare nine.exr truth.exr --json");
  command->callback([arguments, &run] { run = [arguments] { run_compare(*arguments); }; });
}

}  // namespace shlight::app
