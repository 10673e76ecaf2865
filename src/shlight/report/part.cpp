#include "shlight/report/part.h"

#include <fmt/format.h>

#include <span>

#include "shlight/core/file.h"
#include "shlight/image/image_io.h"
#include "shlight/report/html.h"
#include "shlight/scene/load_scene.h"
#include "shlight/truth/svg.h"

namespace shlight {

const Light& ReportSources::light() {
  if (!light_) light_ = load_light(params_.light, params_.load).light;
  return *light_;
}

const Scene& ReportSources::scene(const std::string& model) {
  const auto found = scenes_.find(model);
  return found != scenes_.end() ? found->second : scenes_.emplace(model, make_scene(model)).first->second;
}

std::string PartWriter::add_picture(const std::string& name, const Image8& picture, std::string_view alternative) {
  const std::filesystem::path path = folder_ / (name + ".png");
  const std::vector<std::byte> png = encode_png(picture, path.string());
  write_file(path, png);
  part_.files.push_back(path);
  return fmt::format("<img src=\"{}\" width=\"{}\" height=\"{}\" alt=\"{}\">", data_uri("image/png", png),
                     picture.width, picture.height, escape_xml(alternative));
}

std::string PartWriter::add_plot(const std::string& name, const std::string& svg, std::string_view alternative) {
  const std::filesystem::path path = folder_ / (name + ".svg");
  write_file(path, svg);
  part_.files.push_back(path);
  return fmt::format("<img class=\"plot\" src=\"{}\" alt=\"{}\">",
                     data_uri("image/svg+xml", std::as_bytes(std::span(svg))), escape_xml(alternative));
}

void PartWriter::add_csv(const std::string& name, const std::string& csv) {
  const std::filesystem::path path = folder_ / (name + ".csv");
  write_file(path, csv);
  part_.files.push_back(path);
}

}  // namespace shlight
