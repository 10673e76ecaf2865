#include <fmt/format.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <exception>
#include <iostream>
#include <new>
#include <optional>
#include <sstream>

#include "command.h"
#include "shlight/core/error.h"

namespace {

constexpr int kFailed = 1;
constexpr int kWrongUsage = 2;

// Words for people go to stderr; results alone to stdout.
void set_up_log(bool quiet) {
  auto logger = spdlog::stderr_color_st("shlight");
  logger->set_pattern("%^%l%$: %v");
  logger->set_level(quiet ? spdlog::level::err : spdlog::level::info);
  spdlog::set_default_logger(logger);
}

// The exit code where the command line asks for no command: it is wrong, or wants help.
std::optional<int> parse(CLI::App& program, int argc, char** argv) {
  try {
    program.parse(argc, argv);
    // Not required above: CLI11 would then not name the word that it takes for no command.
    if (program.get_subcommands().empty()) throw CLI::RequiredError::Subcommand(1);
    return {};
  } catch (const CLI::ParseError& error) {
    std::ostringstream help;
    if (program.exit(error, help, std::cerr) != 0) return kWrongUsage;
    shlight::app::print_result(help.str());
    return 0;
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App program("shlight lights things with spherical harmonics.\n", "shlight");
  program.set_version_flag("--version", SHLIGHT_VERSION);
  program.require_subcommand(0, 1);
  program.footer(
      "Start with:  shlight demo -o demo\nThen:        shlight COMMAND --help  shows an example of each command.");
  bool quiet = false;
  program.add_flag("-q,--quiet", quiet, "Say only what went wrong");

  shlight::app::Run run;
  shlight::app::add_project(program, run);
  shlight::app::add_project_brdf(program, run);
  shlight::app::add_render(program, run);
  shlight::app::add_bake(program, run);
  shlight::app::add_info(program, run);
  shlight::app::add_demo(program, run);
  shlight::app::add_convert_map(program, run);
  shlight::app::add_compare(program, run);
  shlight::app::add_bands(program, run);
  shlight::app::add_bench(program, run);
  shlight::app::add_reproduce(program, run);
  shlight::app::add_view(program, run);

  const auto fail = [&](std::string text) {
    // One line, whatever the name of a file holds.
    std::replace_if(
        text.begin(), text.end(), [](unsigned char c) { return c < ' '; }, ' ');
    const auto commands = program.get_subcommands();
    fmt::print(stderr, "shlight{}: {}\n", commands.empty() ? "" : " " + commands.front()->get_name(), text);
    return kFailed;
  };
  try {
    shlight::app::keep_standard_streams();
    shlight::app::watch_for_stop();
    if (const auto exit_code = parse(program, argc, argv)) return *exit_code;
    set_up_log(quiet);
    run();
    return 0;
  } catch (const std::bad_alloc&) {
    return fail("out of memory");
  } catch (const std::exception& error) {
    return fail(shlight::app::stop_requested() ? "stopped before it was done" : error.what());
  }
}
