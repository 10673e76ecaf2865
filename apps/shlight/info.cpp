#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>

#include "command.h"
#include "shlight/core/error.h"
#include "shlight/scene/load_scene.h"
#include "shlight/transfer/baked_file.h"

namespace shlight::app {
namespace {

using nlohmann::ordered_json;

struct InfoArguments {
  std::string file;
  LoadLightParams load;
  std::string model;  // --fits
  bool json = false;
};

const char* kind_name(LightInfo::Kind kind) {
  switch (kind) {
    case LightInfo::Kind::kImage:
      return "image";
    case LightInfo::Kind::kCoefficients:
      return "coefficients";
    case LightInfo::Kind::kFormula:
      return "formula";
    case LightInfo::Kind::kBuiltin:
      return "builtin";
  }
  return "";
}

ordered_json info_of(const LoadedLight& loaded) {
  const auto& [light, info] = loaded;
  ordered_json json = {{"kind", kind_name(info.kind)}};
  if (info.layout) {
    json["layout"] = layout_name(*info.layout);
    json["width"] = info.width;
    json["height"] = info.height;
    json["min"] = info.pixels.min;
    json["max"] = info.pixels.max;
    json["nan"] = info.pixels.nan;
    json["inf"] = info.pixels.inf;
    json["negative"] = info.pixels.negative;
    if (!info.pixels.clean()) json["bad_pixels"] = describe(info.pixels);
    json["warnings"] = info.warnings;
    if (const auto& clamp = info.clamp) {
      const auto array = [](Rgb c) { return ordered_json{c.r, c.g, c.b}; };
      json["clamp"] = {{"max", clamp->max},
                       {"pixels_above", clamp->above},
                       {"pixels_negative", clamp->negative},
                       {"total", array(clamp->total)},
                       {"lost", array(clamp->lost)},
                       {"gained", array(clamp->gained)},
                       {"lost_share", clamp->lost_share()}};
    }
  }
  if (info.bands > 0) json["bands"] = info.bands;
  // L00 tells the mean radiance; degree 1, of its luminance, where most of the light comes from.
  const RgbCoefficients c = light->project(2);
  const Rgb mean = 1 / std::sqrt(4 * std::numbers::pi) * c[0];
  json["mean_radiance"] = {mean.r, mean.g, mean.b};
  // The integral of the radiance over all directions.
  const double sphere = 4 * std::numbers::pi;
  json["energy"] = {sphere * mean.r, sphere * mean.g, sphere * mean.b};
  const Vec3d l1 = {luminance(c[3]), luminance(c[1]), luminance(c[2])};
  const double length = std::sqrt(dot(l1, l1));
  // Of a light that is nearly the same from everywhere, noise would have the say.
  if (length > 1e-3 * std::abs(luminance(c[0])))
    json["dominant_direction"] = {l1.x / length, l1.y / length, l1.z / length};
  if (const auto split = light->split_sun())
    json["sun"] = json_of_sun(split->sun, std::sqrt(4 * std::numbers::pi) * c[0]);
  return json;
}

ordered_json info_of(const Scene& scene) {
  ordered_json json = {{"kind", "model"},
                       {"vertices", num_vertices(scene)},
                       {"triangles", num_triangles(scene)},
                       {"meshes", scene.meshes.size()},
                       {"instances", scene.instances.size()},
                       {"materials", scene.materials.size()},
                       {"textures", scene.textures.size()}};
  if (const auto bounds = world_bounds(scene)) {
    json["bounds_min"] = {bounds->min.x, bounds->min.y, bounds->min.z};
    json["bounds_max"] = {bounds->max.x, bounds->max.y, bounds->max.z};
  }
  json["warnings"] = scene.warnings;
  return json;
}

ordered_json info_of(const Baked& baked) {
  const auto& [scene, transfer, info] = baked;
  ordered_json json = info_of(scene);
  json["kind"] = "baked";
  json["model"] = info.model;
  json["transfer"] = to_text(transfer.kind);
  json["bands"] = transfer.bands;
  json["channels"] = transfer.channels;
  json["bits"] = info.bits;
  if (info.pca) {
    json["clusters"] = info.pca->clusters;
    json["components"] = info.pca->components;
  }
  json["bytes_per_vertex"] = baked_bytes_per_vertex(transfer, info);
  json["rays"] = transfer.rays;
  json["estimated_error"] = transfer.estimated_error;
  json["hash"] = fmt::format("{:016x}", transfer.hash);
  json["settings"] = {{"method", to_text(info.params.method)},
                      {"samples", info.params.samples},
                      {"error", info.params.error},
                      {"bounces", info.params.bounces},
                      {"seed", info.params.seed}};
  return json;
}

// Whether the file is what baking `model` with its settings would give now.
bool fits(const std::string& file, const Baked& baked, const std::string& model) {
  const bool fits = still_fits(baked.transfer, make_scene(model), baked.info.params);
  if (!fits) spdlog::warn("{}: no longer fits {}: bake it again", file, model);
  return fits;
}

ordered_json info_of_scene(const InfoArguments& arguments) {
  const std::string& file = arguments.file;
  if (is_baked_file(file)) {
    const Baked baked = load_baked(file);
    ordered_json json = info_of(baked);
    if (!arguments.model.empty()) json["fits"] = fits(file, baked, arguments.model);
    return json;
  }
  if (!arguments.model.empty()) throw Error(file, "is no baked file", "with --fits, a .glb of shlight bake");
  return info_of(make_scene(file));
}

// What can only be a light is read as one; files with the ending of a picture first as a light, then as a model.
ordered_json info_of_file(const InfoArguments& arguments) {
  const std::string& file = arguments.file;
  const bool builtin = file.starts_with("builtin:");
  if (builtin && is_builtin_scene(file)) return info_of_scene(arguments);
  if (builtin || file.starts_with("fn:") || file.ends_with(".json")) return info_of(load_light(file, arguments.load));
  if (is_model_file(file)) return info_of_scene(arguments);
  try {
    return info_of(load_light(file, arguments.load));
  } catch (const Error& light_error) {
    if (arguments.load.layout || !std::filesystem::is_regular_file(file)) throw;
    try {
      return info_of_scene(arguments);
    } catch (const Error&) {
      throw light_error;
    }
  }
}

// Floats as JSON shows them have more digits than a person wants.
std::string words_for(const ordered_json& value) {
  if (value.is_number_float()) return fmt::format("{:.6g}", value.get<double>());
  if (value.is_string()) return value.get<std::string>();
  std::string text;
  if (value.is_object())
    for (const auto& [key, part] : value.items()) text += (text.empty() ? "" : ", ") + key + " " + words_for(part);
  if (value.is_object()) return text;
  if (!value.is_array()) return value.dump();
  for (const auto& element : value) text += (text.empty() ? "" : element.is_string() ? "; " : " ") + words_for(element);
  return text.empty() ? "none" : text;
}

void run_info(const InfoArguments& arguments) {
  const ordered_json json = info_of_file(arguments);
  if (arguments.json) return print_json(json);
  std::string text = arguments.file + "\n";
  for (const auto& [key, value] : json.items()) {
    std::string name = key;
    std::replace(name.begin(), name.end(), '_', ' ');
    text += fmt::format("  {:<20}{}\n", name, words_for(value));
  }
  print_result(text);
}

}  // namespace

void add_info(CLI::App& program, Run& run) {
  auto* command = program.add_subcommand("info", "Tell what a light, a model or a baked file holds");
  const auto arguments = std::make_shared<InfoArguments>();
  command->add_option("FILE", arguments->file, "Any light or model that the other commands take")->required();
  add_light_options(*command, arguments->load);
  command->add_option("--fits", arguments->model, "Tell whether a baked file is what baking this would give now")
      ->type_name("MODEL");
  command->add_flag("--json", arguments->json, "Print it as JSON on stdout");
  command->footer("Example:\n  shlight info venice.hdr\n  shlight info statue.glb --fits statue.obj");
  command->callback([arguments, &run] { run = [arguments] { run_info(*arguments); }; });
}

}  // namespace shlight::app
