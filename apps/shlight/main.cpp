#include <fmt/format.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <exception>
#include <new>

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

}  // namespace

int main(int argc, char** argv) {
  CLI::App program("shlight lights things with spherical harmonics.\n", "shlight");
  program.set_version_flag("--version", SHLIGHT_VERSION);
  program.require_subcommand(1);
  program.footer(
      "Start with:  shlight demo -o demo\nThen:        shlight COMMAND --help  shows an example of each command.");
  bool quiet = false;
  program.add_flag("-q,--quiet", quiet, "Say only what went wrong");

  shlight::app::Run run;
  shlight::app::add_project(program, run);
  shlight::app::add_render(program, run);
  shlight::app::add_info(program, run);
  shlight::app::add_demo(program, run);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? 0 : kWrongUsage;
  }

  const std::string command = program.get_subcommands().front()->get_name();
  const auto fail = [&](const std::string& text) {
    fmt::print(stderr, "shlight {}: {}\n", command, text);
    return kFailed;
  };
  try {
    set_up_log(quiet);
    shlight::app::watch_for_stop();
    run();
    return 0;
  } catch (const std::bad_alloc&) {
    return fail("out of memory");
  } catch (const std::exception& error) {
    return fail(shlight::app::stop_requested() ? "stopped before it was done" : error.what());
  }
}
