#include <spdlog/spdlog.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "command.h"
#include "shlight/core/error.h"
#include "shlight/image/cube_files.h"

namespace shlight::app {
namespace {

struct ConvertMapArguments {
  std::string light;
  LoadLightParams load;
  std::filesystem::path output;
  Layout layout = Layout::kLatLong;
  int size = 0;  // as the source resolves
  int threads = 0;
  bool json = false;
};

// With as many pixels round the horizon as the source has; 1024 where it has none.
int default_size(const LightInfo& source, Layout layout) {
  const int faces = source.layout ? face_grid(*source.layout).columns : 1;
  const int horizon = source.layout ? horizon_from_size(*source.layout, source.width / faces) : 1024;
  return size_from_horizon(layout, horizon);
}

// Gives back the names of the files written.
std::vector<std::string> save_map(const std::filesystem::path& path, const Image& image, Layout layout) {
  if (layout != Layout::kCube) {
    save_image(path, image, layout);
    return {path.string()};
  }
  const CubeFiles files = cube_files_for(path);
  const auto faces = split_cube(image);
  std::vector<std::string> names;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    save_image(files[i], faces[i]);
    names.push_back(files[i].string());
  }
  return names;
}

void run_convert_map(const ConvertMapArguments& arguments) {
  const LoadedLight loaded = load_light_aloud(arguments.light, arguments.load);
  MakePictureParams params;
  params.layout = arguments.layout;
  params.size = arguments.size > 0 ? arguments.size : default_size(loaded.info, arguments.layout);
  params.threads = arguments.threads;
  const PictureSize size = picture_size(params.layout, params.size);
  const std::uint64_t pixels = static_cast<std::uint64_t>(size.width) * static_cast<std::uint64_t>(size.height);
  if (pixels > arguments.load.image.max_pixels)
    throw Error("--size " + std::to_string(params.size), "is too large",
                "at most " + std::to_string(arguments.load.image.max_pixels) + " pixels (--max-pixels)");
  const Image image = loaded.light->picture(params, progress_bar("Resampling"));
  const auto files = save_map(arguments.output, image, params.layout);
  if (arguments.json)
    print_json(
        {{"layout", layout_name(params.layout)}, {"width", size.width}, {"height", size.height}, {"files", files}});
  spdlog::info("{} x {} pixels of {} in {}{}", size.width, size.height, layout_name(params.layout), files[0],
               files.size() > 1 ? " … " + files.back() : "");
}

}  // namespace

void add_convert_map(CLI::App& program, Run& run) {
  auto* command = program.add_subcommand("convert-map", "Turn a light into a picture of another layout or size");
  const auto arguments = std::make_shared<ConvertMapArguments>();
  command->add_option("IN", arguments->light, kLightHelp)->required();
  command
      ->add_option("-o,--output", arguments->output,
                   "Write this picture; for the layout cube, six: OUT_px.exr, OUT_nx.exr, …")
      ->required()
      ->type_name("OUT.exr|.hdr")
      ->check(CLI::Validator(
          [](std::string& name) {
            const auto ending = std::filesystem::path(name).extension();
            return ending == ".exr" || ending == ".hdr" ? "" : "'" + name + "' ends neither in .exr nor in .hdr";
          },
          ""));
  add_layout_option(*command, "--layout", arguments->layout, "The layout to write")->capture_default_str();
  command
      ->add_option(
          "--size", arguments->size,
          "Width of a face of a cube, diameter of a disc, width of another; as the source resolves if not given")
      ->check(CLI::Range(1, 32768).description("1 to 32768"));
  add_layout_option(*command, "--from", arguments->load.layout, "The layout of IN, where it is not recognised");
  add_picture_options(*command, arguments->load);
  command->add_option("--threads", arguments->threads, "0: all; the result is the same for any number")
      ->capture_default_str()
      ->check(CLI::Range(0, 1024).description("0 to 1024"));
  command->add_flag("--json", arguments->json, "Print what was written on stdout");
  command->footer(
      "Examples:\n  shlight convert-map venice.hdr -o venice_cross.exr --layout vertical-cross --size 256\n"
      "  shlight convert-map venice.hdr -o faces/venice.hdr --layout cube\n"
      "  shlight convert-map builtin:sky -o sky.exr --layout octahedral --size 512");
  command->callback([arguments, &run] { run = [arguments] { run_convert_map(*arguments); }; });
}

}  // namespace shlight::app
