#include "script.h"

#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <sstream>
#include <string_view>

#include "shlight/core/error.h"
#include "shlight/core/file.h"

namespace shlight::viewer {
namespace {

struct Command {
  std::string_view name;
  std::size_t least, most;  // words after it
  std::string_view use;
};
constexpr std::array kCommands = {
    Command{"set", 2, 99, "set NAME VALUE"},
    Command{"open", 1, 99, "open FILE"},
    Command{"drag", 5, 6, "drag left|middle|right X0 Y0 X1 Y1 [unfocus]"},
    Command{"click", 2, 2, "click X Y"},
    Command{"press", 1, 1, "press KEY"},
    Command{"wheel", 1, 1, "wheel STEPS"},
    Command{"resize", 2, 2, "resize WIDTH HEIGHT"},
    Command{"frames", 1, 1, "frames COUNT"},
    Command{"spin", 1, 1, "spin FRAMES"},
    Command{"wait", 0, 1, "wait [PATHS]"},
    Command{"cancel", 0, 0, "cancel"},
    Command{"reset", 0, 0, "reset"},
    Command{"screenshot", 1, 99, "screenshot FILE.png"},
    Command{"picture", 1, 99, "picture FILE.png|.exr"},
    Command{"command", 1, 99, "command FILE"},
    Command{"export", 1, 99, "export FILE.json"},
    Command{"report", 1, 99, "report FILE.json"},
};

std::string all_commands() {
  std::string text;
  for (const Command& command : kCommands) text += (text.empty() ? "" : "; ") + std::string(command.use);
  return text;
}

}  // namespace

Script::Script(const std::filesystem::path& file) : name_(file.string()) {
  constexpr std::uint64_t kMaxBytes = 1 << 20;
  const std::vector<std::byte> bytes = read_file(file, kMaxBytes);
  std::istringstream stream(std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
  int number = 0;
  for (std::string text; std::getline(stream, text);) {
    ScriptLine line = {++number, {}, {}};
    std::istringstream words(text);
    for (std::string word; words >> word;) line.words.push_back(word);
    if (line.words.empty() || line.words[0].starts_with('#')) continue;
    const std::size_t after = text.find(line.words[0]) + line.words[0].size();
    const std::size_t first = text.find_first_not_of(" \t", after), last = text.find_last_not_of(" \t\r");
    if (first != std::string::npos) line.rest = text.substr(first, last - first + 1);

    const std::string where = fmt::format("{}:{}", name_, number);
    const auto command = std::ranges::find(kCommands, line.words[0], &Command::name);
    if (command == kCommands.end()) throw Error(where, "'" + line.words[0] + "' is no command", all_commands());
    const std::size_t count = line.words.size() - 1;
    if (count < command->least || count > command->most)
      throw Error(where, fmt::format("'{}' with {} words", command->name, count), command->use);
    lines_.push_back(std::move(line));
  }
}

double to_number(const std::string& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value) || std::abs(value) > 1e6)
    throw Error("'" + text + "'", "is no number", "a number from -1000000 to 1000000");
  return value;
}

int to_pixels(const std::string& text) {
  const double value = to_number(text);
  if (value < 1 || value > 16384 || value != std::floor(value))
    throw Error("'" + text + "'", "is no side of a window", "a whole number from 1 to 16384");
  return static_cast<int>(value);
}

int to_key(const std::string& name) {
  if (name == "Tab") return GLFW_KEY_TAB;
  if (name.size() == 1 && std::isalnum(static_cast<unsigned char>(name[0])))
    return std::toupper(static_cast<unsigned char>(name[0]));  // GLFW's names of keys are their capital letters
  throw Error("'" + name + "'", "is no key", "a letter, a digit or Tab");
}

std::string Script::where() const {
  return fmt::format("{}:{}", name_, lines_.front().number);
}

}  // namespace shlight::viewer
