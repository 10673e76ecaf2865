#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "command.h"
#include "shlight/core/error.h"
#include "shlight/core/file.h"
#include "viewer/viewer.h"

namespace shlight::app {

void add_view(CLI::App& program, Run& run) {
  auto* command = program.add_subcommand("view", "Show a model under a light in a window, to turn and to understand");
  const auto params = std::make_shared<viewer::ViewerParams>();
  viewer::Settings& settings = params->settings;
  command->add_option("MODEL", settings.model, kModelHelp)->capture_default_str();
  command->add_option("--light", settings.light, kLightHelp)->capture_default_str();
  command
      ->add_option_function<std::vector<std::string>>(
          "--set",
          [&settings](const std::vector<std::string>& all) {
            for (const std::string& text : all) {
              const std::size_t equals = std::min(text.find('='), text.size());
              try {
                viewer::set_by_name(settings, text.substr(0, equals),
                                    equals < text.size() ? text.substr(equals + 1) : "");
              } catch (const Error& error) {
                throw CLI::ValidationError("--set", error.what());
              }
            }
          },
          "Begin with this setting, for instance bands=3 or method=hybrid; may be given several times")
      ->type_name("NAME=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command
      ->add_option_function<std::string>(
          "--size",
          [params](const std::string& text) {
            int end = 0;
            if (std::sscanf(text.c_str(), "%5dx%5d%n", &params->width, &params->height, &end) != 2 ||
                end != static_cast<int>(text.size()) || params->width < 1 || params->height < 1)
              throw CLI::ValidationError("--size", "'" + text + "' is no size such as 1280x800");
          },
          "Of the window")
      ->type_name("WxH")
      ->default_str(fmt::format("{}x{}", params->width, params->height));
  command->add_option("--scale", params->scale, "Of text and controls; if not given, as the display wants it")
      ->check(number_from(0.5, 4));
  command->add_option("--script", params->script, "Do what this file says, without hands (docs/viewer.md), then close")
      ->type_name("FILE");
  command->add_option("--screenshot", params->screenshot, "Save a picture of the window once all is drawn, then close")
      ->type_name("FILE.png");
  command->footer(
      "Examples:\n  shlight view\n  shlight view skull.x --light venice.hdr\n"
      "  shlight view statue.glb --light builtin:studio   (of shlight bake)\n"
      "  shlight view builtin:knot --set method=hybrid --set material=ggx:alpha=0.3,f0=0.9/0.6/0.2\n"
      "  shlight view --screenshot window.png\n\nIn the window, H shows what keys and pointer do.");
  command->callback([params, &run] {
    run = [params] {
      if (!params->screenshot.empty()) check_writable(params->screenshot);
      params->asked_to_stop = stop_requested;
      viewer::run_viewer(*params);
    };
  });
}

}  // namespace shlight::app
