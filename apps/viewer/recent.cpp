#include "recent.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string_view>
#include <system_error>

#include "shlight/core/error.h"
#include "shlight/core/file.h"
#include "shlight/scene/load_scene.h"

namespace shlight::viewer {
namespace {

constexpr std::size_t kMost = 8, kMostBeside = 40;
constexpr std::string_view kModel = "model ", kLight = "light ";

std::filesystem::path state_file() {
  const char* state = std::getenv("XDG_STATE_HOME");
  const char* home = std::getenv("HOME");
  if (state && *state) return std::filesystem::path(state) / "shlight" / "recent";
  return home && *home ? std::filesystem::path(home) / ".local/state/shlight/recent" : std::filesystem::path();
}

std::vector<std::string> files_beside(const std::string& path,
                                      const std::function<bool(const std::filesystem::path&)>& fits) {
  std::vector<std::string> files;
  std::error_code error;
  const std::filesystem::path file = std::filesystem::absolute(path, error);
  if (error || !std::filesystem::is_regular_file(file, error)) return files;
  for (std::filesystem::directory_iterator entry(file.parent_path(), error), end; !error && entry != end;
       entry.increment(error))
    if (fits(entry->path())) files.push_back(entry->path().string());
  std::ranges::sort(files);
  if (files.size() > kMostBeside) files.resize(kMostBeside);
  return files;
}

}  // namespace

Recent::Recent(bool remember) {
  if (!remember || state_file().empty()) return;
  file_ = state_file().string();
  std::vector<std::byte> bytes;
  try {
    constexpr std::uint64_t kMaxBytes = 1 << 16;
    bytes = read_file(file_, kMaxBytes);
  } catch (const Error&) {
    return;  // the first time, there is none
  }
  std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    if (line.starts_with(kModel) && models_.size() < kMost) models_.emplace_back(line.substr(kModel.size()));
    if (line.starts_with(kLight) && lights_.size() < kMost) lights_.emplace_back(line.substr(kLight.size()));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

void Recent::add(std::vector<std::string>& list, const std::string& path) {
  if (path.starts_with("builtin:") || path.find('\n') != std::string::npos) return;
  std::error_code error;
  const bool is_file = std::filesystem::exists(path, error);
  const std::string name = is_file ? std::filesystem::absolute(path, error).string() : path;
  std::erase(list, name);
  list.insert(list.begin(), name);
  if (list.size() > kMost) list.resize(kMost);
  save();
}

void Recent::save() const {
  if (file_.empty()) return;
  std::string text;
  for (const std::string& model : models_) text += std::string(kModel) + model + "\n";
  for (const std::string& light : lights_) text += std::string(kLight) + light + "\n";
  std::error_code error;
  std::filesystem::create_directories(std::filesystem::path(file_).parent_path(), error);
  try {
    write_file(file_, text);
  } catch (const Error&) {
    // A list of files is not worth a message.
  }
}

std::vector<std::string> models_beside(const std::string& path) {
  return files_beside(path, is_model_file);
}

std::vector<std::string> lights_beside(const std::string& path) {
  constexpr std::array kEndings = {".hdr", ".exr", ".json", ".dds", ".pfm", ".float", ".pic"};
  return files_beside(path, [&](const std::filesystem::path& file) {
    return std::ranges::find(kEndings, file.extension().string()) != kEndings.end();
  });
}

}  // namespace shlight::viewer
