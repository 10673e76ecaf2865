#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "shlight/core/progress.h"
#include "shlight/light/light.h"
#include "shlight/sh/rotation.h"
#include "shlight/sh/sphere_samples.h"
#include "shlight/transfer/baked_file.h"
#include "shlight/transfer/transfer.h"

namespace shlight::app {

// What the chosen command will do, set while the command line is parsed and called by main afterwards.
using Run = std::function<void()>;

// One function a command: adds it to the program.
void add_project(CLI::App& program, Run& run);
void add_project_brdf(CLI::App& program, Run& run);
void add_render(CLI::App& program, Run& run);
void add_bake(CLI::App& program, Run& run);
void add_info(CLI::App& program, Run& run);
void add_demo(CLI::App& program, Run& run);
void add_convert_map(CLI::App& program, Run& run);
void add_compare(CLI::App& program, Run& run);
void add_bands(CLI::App& program, Run& run);
void add_bench(CLI::App& program, Run& run);
void add_reproduce(CLI::App& program, Run& run);
void add_view(CLI::App& program, Run& run);

// The help of a LIGHT argument, and of a MODEL.
extern const char* const kLightHelp;
extern const char* const kModelHelp;

std::map<std::string, Layout> layouts_by_name();

// An option that takes the name of a layout; Value is Layout or an optional one.
template <class Value>
CLI::Option* add_layout_option(CLI::App& command, const std::string& name, Value& layout, const std::string& help) {
  return command.add_option(name, layout, help)
      ->transform(CLI::CheckedTransformer(layouts_by_name()).description(""))
      ->type_name("LAYOUT");
}

// Options of commands that read a light: --layout, and how pictures are read.
void add_light_options(CLI::App& command, LoadLightParams& params);
void add_picture_options(CLI::App& command, LoadLightParams& params);

// How a light is turned and its coefficients are smoothed: --rotate and --window of project and render.
struct LightShape {
  Rotation rotation;
  std::string window = "none";
};
void add_shape_options(CLI::App& command, LightShape& shape);
void add_window_option(CLI::App& command, LightShape& shape);

// The windowed coefficients; says on stderr what an automatic window did.
RgbCoefficients apply_window(const LightShape& shape, const RgbCoefficients& coefficients);

// "azimuth -125.0, elevation 30.0, irradiance 1 2 3, 62.1 % of the light"; `all` is ∫ L of the whole light.
std::string describe_sun(const Sun& sun, Rgb all);
// As the commands print it in JSON: direction, azimuth and elevation in degrees, irradiance, share of the luminance.
nlohmann::ordered_json json_of_sun(const Sun& sun, Rgb all);

// How transfer is baked: --transfer, --samples and --bounces. check_bake_options refuses those that the kind has no use
// for, to be called when the command line is parsed.
void add_bake_options(CLI::App& command, BakeParams& params);
void check_bake_options(const CLI::App& command, const BakeParams& params);

// "16 bits", "64 clusters of 7 components".
std::string describe_storage(const BakeInfo& info);

// Bakes with a bar, and says on stderr what it took.
Transfer bake_aloud(const std::string& model, const Scene& scene, const BakeParams& params);

// --size WxH of a picture in pixels.
void add_size_option(CLI::App& command, int& width, int& height);

// Numbers in [low, high]; unlike CLI::Range, it does not take NaN for one.
CLI::Validator number_from(double low, double high);

// Loads a light and says on stderr what is worth knowing about it.
LoadedLight load_light_aloud(const std::string& light, const LoadLightParams& params);

// Random samples of --method monte-carlo. Throws Error where they would take too much memory.
SphereSamples make_monte_carlo_samples(int bands, int samples, std::uint64_t seed);

// A table of coefficients, a line each: l, m, red, green, blue to six digits.
std::string table_of(const RgbCoefficients& coefficients);

// Writes to stdout; throws Error where that is closed or full.
void print_result(const std::string& text);
void print_json(const nlohmann::ordered_json& json);

// Shows `what` and a bar on stderr where that is a terminal; stops where the user asked to.
Progress progress_bar(std::string what);

// True once the user has asked to stop (Ctrl-C, a closed terminal, SIGTERM).
bool stop_requested();
void watch_for_stop();

// A standard stream that the program was started without would else be the next file it opens.
void keep_standard_streams();

}  // namespace shlight::app
