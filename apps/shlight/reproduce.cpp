#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <nlohmann/json.hpp>

#include "command.h"
#include "shlight/core/error.h"
#include "shlight/report/report.h"

namespace shlight::app {
namespace {

struct ReproduceArguments {
  std::filesystem::path folder = "report";
  ReportParams params;
  bool json = false;
};

// A bar that says which part is being made.
ReportWatcher watch_parts() {
  return [bar = Progress(), shown = std::string()](const std::string& part, double fraction) mutable {
    if (part != shown) {
      shown = part;
      bar = progress_bar(fmt::format("{:<60.60}", part));
    }
    return bar(fraction);
  };
}

nlohmann::ordered_json json_of(const Report& report) {
  nlohmann::ordered_json parts = nlohmann::ordered_json::array();
  for (const ReportPart& part : report.parts) {
    nlohmann::ordered_json values = nlohmann::ordered_json::object(), times = values,
                           files = nlohmann::ordered_json::array();
    for (const ReportValue& value : part.values) (value.is_time ? times : values)[value.name] = value.value;
    for (const auto& file : part.files) files.push_back(file.string());
    nlohmann::ordered_json json = {{"id", part.id},    {"title", part.title}, {"seconds", part.seconds},
                                   {"values", values}, {"times", times},      {"files", files}};
    if (!part.missing.empty()) json["missing"] = part.missing;
    parts.push_back(std::move(json));
  }
  return {{"page", report.page.string()}, {"processor", report.processor}, {"parts", std::move(parts)}};
}

void run_reproduce(const ReproduceArguments& arguments) {
  const Report report = reproduce_thesis(arguments.folder, arguments.params, watch_parts());
  const auto missing = report.missing();
  for (const ReportPart* part : missing) spdlog::warn("{} is missing: {}", part->title, part->missing);
  double seconds = 0;
  for (const ReportPart& part : report.parts) seconds += part.seconds;
  spdlog::info("{}: {} of {} parts in {:.0f} s", report.page.string(), report.parts.size() - missing.size(),
               report.parts.size(), seconds);
  if (arguments.json) print_json(json_of(report));
  if (!missing.empty())
    throw Error(report.page.string(),
                fmt::format("{} of {} parts are missing, {} first ({})", missing.size(), report.parts.size(),
                            missing[0]->title, missing[0]->missing),
                "what the page says of each");
}

}  // namespace

void add_reproduce(CLI::App& program, Run& run) {
  auto* command = program.add_subcommand("reproduce", "Remake the thesis's figures and tables as one page, measured");
  const auto arguments = std::make_shared<ReproduceArguments>();
  ReportParams& params = arguments->params;
  command
      ->add_option("-o,--output", arguments->folder, "Folder for thesis.html and the files behind it, made if missing")
      ->capture_default_str()
      ->type_name("DIR");
  command->add_option("--light", params.light, kLightHelp)->capture_default_str()->type_name("LIGHT");
  add_light_options(*command, params.load);
  command
      ->add_option("--model", params.models,
                   "The scene of figures 17 to 22, and a row more in tables 2 and 4; given again, rows more")
      ->type_name("MODEL");
  command
      ->add_option("--samples", params.samples, "Of the thesis's Monte Carlo methods; the next square number is taken")
      ->capture_default_str()
      ->check(CLI::Range(9, kMaxTransferSamples).description(fmt::format("9 to {}", kMaxTransferSamples)));
  command->add_flag("--quick", params.quick,
                    "Smaller pictures, noisier references, fewer sizes, lights, bands and frames");
  command->add_flag("--json", arguments->json,
                    "Print all values on stdout as JSON, times apart from what is the same in every run");
  command->footer(
      "No files are needed. A part that cannot be made leaves the others: the page says what is missing and why.\n\n"
      "Examples:\n  shlight reproduce -o report\n"
      "  shlight reproduce -o report --light grace_probe.hdr --model cube_on_plane.x --model skullocc.x");
  command->callback([arguments, &run] { run = [arguments] { run_reproduce(*arguments); }; });
}

}  // namespace shlight::app
