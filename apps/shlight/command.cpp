#include "command.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>

#include "shlight/core/error.h"

namespace shlight::app {

const char* const kLightHelp =
    "Picture (.hdr, .exr, .dds, …), coefficient file (.json), builtin:sky|studio|panel|axes|thesis, or a formula "
    "\"fn:…\"";
const char* const kModelHelp = "Model or scene (.x .obj .ply .stl .off .gltf .glb …), or builtin:sphere|knot|scene";

std::map<std::string, Layout> layouts_by_name() {
  std::map<std::string, Layout> layouts;
  for (const Layout layout : all_layouts()) layouts.emplace(layout_name(layout), layout);
  return layouts;
}

void add_light_options(CLI::App& command, LoadLightParams& params) {
  add_layout_option(command, "--layout", params.layout,
                    "Layout of the picture; if not given, as the file states it, else told from its name and shape");
  add_picture_options(command, params);
}

void add_picture_options(CLI::App& command, LoadLightParams& params) {
  command
      .add_option("--clamp", params.clamp,
                  "Cut each channel of the picture at this radiance, and negative ones at 0; says what was lost")
      ->type_name("MAX")
      ->check(number_from(std::numeric_limits<float>::min(), std::numeric_limits<float>::max()).description(""));
  command.add_option("--max-pixels", params.image.max_pixels, "Refuse pictures with more pixels")
      ->capture_default_str()
      ->check(CLI::PositiveNumber.description(""));
}

void add_size_option(CLI::App& command, int& width, int& height) {
  command
      .add_option_function<std::string>(
          "--size",
          [&width, &height](const std::string& text) {
            int end = 0;
            if (std::sscanf(text.c_str(), "%5dx%5d%n", &width, &height, &end) != 2 ||
                end != static_cast<int>(text.size()) || width < 1 || height < 1)
              throw CLI::ValidationError("--size", "'" + text + "' is no size such as 1280x720");
          },
          "Of the picture in pixels")
      ->type_name("WxH")
      ->default_str(fmt::format("{}x{}", width, height));
}

CLI::Validator number_from(double low, double high) {
  const auto check = [low, high](std::string& text) {
    double value = 0;
    const bool good = CLI::detail::lexical_cast(text, value) && value >= low && value <= high;
    return good ? "" : fmt::format("'{}' is no number from {} to {}", text, low, high);
  };
  return CLI::Validator(check, fmt::format("{} to {}", low, high));
}

LoadedLight load_light_aloud(const std::string& light, const LoadLightParams& params) {
  LoadedLight loaded = load_light(light, params);
  const LightInfo& info = loaded.info;
  if (info.layout && !params.layout)
    spdlog::info("{}: {} x {} pixels, taken as {}", info.name, info.width, info.height, layout_name(*info.layout));
  for (const std::string& warning : info.warnings) spdlog::warn("{}: {}", info.name, warning);
  if (!info.pixels.clean()) spdlog::warn("{}: {}", info.name, describe(info.pixels, info.clamp.has_value()));
  if (info.clamp)
    spdlog::info("{}: clamped to {:g}: {} pixels above, with {:.4g} % of the light's luminance; {} pixels negative",
                 info.name, info.clamp->max, info.clamp->above, 100 * info.clamp->lost_share(), info.clamp->negative);
  return loaded;
}

SphereSamples make_monte_carlo_samples(int bands, int samples, std::uint64_t seed) {
  // Samples are kept with their basis values, eight bytes each.
  constexpr std::int64_t kMaxValues = 1 << 28;
  const std::int64_t most = kMaxValues / num_coefficients(bands);
  if (samples > most)
    throw Error(fmt::format("--samples {}", samples), "needs too much memory",
                fmt::format("at most {} samples at {} bands", most, bands));
  return make_sphere_samples(bands, strata_for(samples), seed);
}

std::string table_of(const RgbCoefficients& coefficients) {
  std::string text = "  l   m           red         green          blue\n";
  for (int l = 0; l < coefficients.bands(); ++l)
    for (int m = -l; m <= l; ++m) {
      const Rgb c = coefficients.at(l, m);
      text += fmt::format("{:3} {:3}  {:12.6g}  {:12.6g}  {:12.6g}\n", l, m, c.r, c.g, c.b);
    }
  return text;
}

void print_result(const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
    throw Error("stdout", fmt::format("cannot be written ({})", std::strerror(errno)),
                "an open terminal, file or pipe");
}

void print_json(const nlohmann::ordered_json& json) {
  print_result(json.dump(2) + "\n");
}

namespace {

volatile sig_atomic_t stop_signal = 0;

}  // namespace

bool stop_requested() {
  return stop_signal != 0;
}

void keep_standard_streams() {
  for (int stream = STDIN_FILENO; stream <= STDERR_FILENO; ++stream)
    // open() takes the lowest number that is free: this one. Read-only, so that writing to it fails as it did.
    if (::fcntl(stream, F_GETFD) < 0 && ::open("/dev/null", O_RDONLY) < 0) return;
}

void watch_for_stop() {
  // The first signal asks; a second one ends the program at once.
  struct sigaction ask = {};
  ask.sa_handler = [](int signal) { stop_signal = signal; };
  ask.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaction(signal, &ask, nullptr);
  // Writing to a closed pipe is an error like any other, and so is writing more than a limit allows.
  ::signal(SIGPIPE, SIG_IGN);
  ::signal(SIGXFSZ, SIG_IGN);
}

Progress progress_bar(std::string what) {
  const bool terminal = ::isatty(STDERR_FILENO) != 0;
  return [what = std::move(what), terminal, shown = -1](double fraction) mutable {
    const int percent = static_cast<int>(100 * fraction);
    if (terminal && percent != shown) {
      constexpr int kWidth = 40;
      const int filled = percent * kWidth / 100;
      fmt::print(stderr, "\r{} [{:=<{}}{:{}}] {:3}%", what, "", filled, "", kWidth - filled, percent);
      if (percent >= 100) fmt::print(stderr, "\r\033[K");
      std::fflush(stderr);
      shown = percent;
    }
    return !stop_requested();
  };
}

}  // namespace shlight::app
