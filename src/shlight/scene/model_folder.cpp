#include "shlight/scene/model_folder.h"

#include <algorithm>
#include <charconv>
#include <system_error>

namespace shlight {
namespace fs = std::filesystem;
namespace {

// glTF names files by URIs, where "%20" is a space.
std::string percent_decoded(std::string_view text) {
  std::string decoded;
  for (std::size_t i = 0; i < text.size(); ++i) {
    unsigned char byte = 0;
    const char* digits = text.data() + i + 1;
    const bool is_escape =
        text[i] == '%' && i + 2 < text.size() && std::from_chars(digits, digits + 2, byte, 16).ptr == digits + 2;
    decoded += is_escape ? static_cast<char>(byte) : text[i];
    if (is_escape) i += 2;
  }
  return decoded;
}

}  // namespace

ModelFolder::ModelFolder(const fs::path& model) {
  std::error_code ignored;  // a path that cannot be resolved stays empty, and nothing lies in it
  model_ = fs::canonical(model, ignored);
  folder_ = fs::canonical(fs::absolute(model, ignored).parent_path(), ignored);
}

bool ModelFolder::may_read(const fs::path& path) const {
  std::error_code error;
  const fs::path file = fs::canonical(path, error);
  // A pipe or a device may never end.
  if (error || folder_.empty() || !fs::is_regular_file(file, error)) return false;
  return file == model_ || std::ranges::mismatch(folder_, file).in1 == folder_.end();
}

std::optional<fs::path> ModelFolder::find(std::string_view name) const {
  for (std::string spelling : {std::string(name), percent_decoded(name)}) {
    std::ranges::replace(spelling, '\\', '/');
    const fs::path relative(spelling);
    for (const fs::path& candidate : {relative, relative.filename()})
      if (!candidate.empty() && candidate.is_relative() && may_read(folder_ / candidate)) return folder_ / candidate;
  }
  return {};
}

std::string printable(std::string_view text) {
  std::string shown(text);
  std::ranges::replace_if(
      shown, [](char c) { return static_cast<unsigned char>(c) < ' ' || c == 127; }, '?');
  return shown;
}

}  // namespace shlight
