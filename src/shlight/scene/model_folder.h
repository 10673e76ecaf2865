#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace shlight {

// A model file may come from a stranger and names other files: textures, material libraries, buffers. Only those are
// read that lie in the model's own folder or below it, symbolic links followed.
class ModelFolder {
 public:
  explicit ModelFolder(const std::filesystem::path& model);

  // Whether `path` (relative to the current folder or absolute) is a regular file that may be read: the model itself or
  // one in its folder.
  bool may_read(const std::filesystem::path& path) const;

  // The file that `name`, as a model has it, stands for: relative to the folder, with either kind of slash, plain or
  // percent-encoded; else the last part of the name alone, since many models carry their authors' paths. Nothing where
  // there is no such file.
  std::optional<std::filesystem::path> find(std::string_view name) const;

 private:
  std::filesystem::path model_;  // both absolute, without symbolic links
  std::filesystem::path folder_;
};

// Text from a file as it may be shown: control characters and what ends a terminal's line become '?'.
std::string printable(std::string_view text);

}  // namespace shlight
