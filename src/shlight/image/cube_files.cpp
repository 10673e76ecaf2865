#include "shlight/image/cube_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>
#include <vector>

#include "shlight/core/error.h"

namespace shlight {
namespace {

namespace fs = std::filesystem;

using FaceNames = std::array<std::string_view, 6>;
constexpr FaceNames kNames[] = {{"px", "nx", "py", "ny", "pz", "nz"},
                                {"posx", "negx", "posy", "negy", "posz", "negz"},
                                {"right", "left", "top", "bottom", "front", "back"},
                                {"right", "left", "up", "down", "front", "back"}};
constexpr const char* kAccepted = "six files named px nx py ny pz nz, posx negx … or right left top bottom front back";

std::string mapped(std::string text, int (*map)(int)) {
  for (char& c : text) c = static_cast<char>(map(static_cast<unsigned char>(c)));
  return text;
}

// `name` in the capitals of `model`: "FRONT", "Front" or "front".
std::string in_capitals_of(const std::string& model, std::string_view name) {
  std::string result(name);
  if (model == mapped(model, std::toupper)) return mapped(result, std::toupper);
  if (std::isupper(static_cast<unsigned char>(model[0])))
    result[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(result[0])));
  return result;
}

// The cube that a file would be a face of, if it is called `face`.
std::optional<CubeFiles> cube_around(const fs::path& path, const FaceNames& names, std::string_view face) {
  const std::string stem = path.stem().string();
  if (stem.size() < face.size()) return {};
  const std::string prefix = stem.substr(0, stem.size() - face.size()), own = stem.substr(prefix.size());
  if (mapped(own, std::tolower) != face) return {};
  if (!prefix.empty() && std::isalnum(static_cast<unsigned char>(prefix.back()))) return {};
  CubeFiles files;
  for (std::size_t i = 0; i < 6; ++i)
    files[i] = path.parent_path() / (prefix + in_capitals_of(own, names[i]) + path.extension().string());
  return files;
}

// The first family of names of which at least one other file is there; nothing for what is no face.
std::optional<CubeFiles> cube_of_face(const fs::path& path) {
  std::optional<CubeFiles> best;
  std::ptrdiff_t most = 1;
  for (const FaceNames& names : kNames)
    for (const std::string_view face : names)
      if (const auto files = cube_around(path, names, face)) {
        const auto there =
            std::ranges::count_if(*files, [](const fs::path& file) { return fs::is_regular_file(file); });
        if (there > most) best = files, most = there;
      }
  return best;
}

CubeFiles cube_in_folder(const fs::path& folder) {
  std::vector<CubeFiles> found;
  for (const auto& entry : fs::directory_iterator(folder))
    if (const auto files = cube_of_face(entry.path()); files && std::ranges::count(found, *files) == 0)
      found.push_back(*files);
  std::ranges::sort(found);
  if (found.empty()) throw Error(folder.string(), "is a folder without a cube map", kAccepted);
  if (found.size() > 1)
    throw Error(folder.string(), "is a folder with several cube maps",
                "one file of the one that is meant, such as " + found[0][0].string());
  return found[0];
}

}  // namespace

std::optional<CubeFiles> find_cube_files(const fs::path& path) {
  const auto files = fs::is_directory(path) ? cube_in_folder(path) : cube_of_face(path);
  if (!files) return {};
  std::string missing;
  for (const fs::path& file : *files)
    if (!fs::exists(file)) missing += (missing.empty() ? "" : ", ") + file.filename().string();
  if (!missing.empty()) throw Error(path.string(), "is part of a cube map without " + missing, kAccepted);
  return files;
}

LoadedImage load_cube_files(const CubeFiles& files, const LoadImageParams& params) {
  LoadImageParams face_params = params;
  face_params.max_pixels = params.max_pixels / 6;
  LoadedImage cube;
  cube.layout = Layout::kCube;
  for (std::size_t i = 0; i < 6; ++i) {
    const std::string name = files[i].string();
    LoadedImage face = load_image(files[i], face_params);
    const int width = face.image.width, height = face.image.height;
    if (width != height)
      throw Error(name, fmt::format("has {} x {} pixels", width, height), "a square face of a cube map");
    if (i == 0) cube.image = {width, 0};
    if (width != cube.image.width)
      throw Error(name,
                  fmt::format("has {0} x {0} pixels, {2} has {1} x {1}", width, cube.image.width, files[0].string()),
                  "six faces of one size");
    auto& values = cube.image.values;
    values.insert(values.end(), face.image.values.begin(), face.image.values.end());
    cube.image.height += height;
    for (const std::string& warning : face.warnings)
      cube.warnings.push_back(files[i].filename().string() + ": " + warning);
  }
  return cube;
}

CubeFiles cube_files_for(const fs::path& path) {
  CubeFiles files;
  for (std::size_t i = 0; i < 6; ++i)
    files[i] =
        path.parent_path() / (path.stem().string() + "_" + std::string(kNames[0][i]) + path.extension().string());
  return files;
}

std::array<Image, 6> split_cube(const Image& cube) {
  std::array<Image, 6> faces;
  const std::size_t size = cube.values.size() / 6;
  for (std::size_t i = 0; i < 6; ++i) {
    faces[i] = Image(cube.width, cube.height / 6);
    std::copy_n(cube.values.begin() + static_cast<std::ptrdiff_t>(i * size), size, faces[i].values.begin());
  }
  return faces;
}

}  // namespace shlight
