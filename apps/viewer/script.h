#pragma once

#include <deque>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace shlight::viewer {

// What a line of a script says: a command and its words.
struct ScriptLine {
  int number = 0;  // of the line, from 1
  std::vector<std::string> words;
  std::string rest;  // all after the command, as it was written
};

// What a script does, line by line.
class Script {
 public:
  Script() = default;
  // Throws Error where the file cannot be read, where a line is no command, or where it has too few or too many words.
  explicit Script(const std::filesystem::path& file);

  bool ended() const { return lines_.empty(); }
  const ScriptLine& line() const { return lines_.front(); }
  void advance() { lines_.pop_front(); }
  // "FILE:12"
  std::string where() const;

 private:
  std::string name_;
  std::deque<ScriptLine> lines_;
};

// What words of a line stand for: a number, a side of the window in pixels, GLFW's number of a key. Throw Error.
double to_number(const std::string& text);
int to_pixels(const std::string& text);
int to_key(const std::string& name);

}  // namespace shlight::viewer
