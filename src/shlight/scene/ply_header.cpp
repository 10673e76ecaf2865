#include "shlight/scene/ply_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <istream>
#include <sstream>
#include <string>
#include <vector>

#include "shlight/core/error.h"
#include "shlight/scene/model_folder.h"

namespace shlight {
namespace {

constexpr std::size_t kMaxLineLength = 1024;
constexpr std::size_t kMaxLines = 10'000;

bool is_type(std::string_view word) {
  constexpr std::array<std::string_view, 16> kTypes = {"char",  "uchar",  "short",   "ushort", "int",   "uint",
                                                       "float", "double", "int8",    "uint8",  "int16", "uint16",
                                                       "int32", "uint32", "float32", "float64"};
  return std::ranges::find(kTypes, word) != kTypes.end();
}

bool is_count(std::string_view word) {
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size();
}

bool is_header_line(const std::vector<std::string>& words) {
  const std::string& keyword = words[0];
  if (keyword == "comment" || keyword == "obj_info") return true;
  if (keyword == "element") return words.size() == 3 && is_count(words[2]);
  if (keyword == "property" && words.size() == 3) return is_type(words[1]);
  if (keyword == "property" && words.size() == 5) return words[1] == "list" && is_type(words[2]) && is_type(words[3]);
  return false;
}

bool is_format_line(const std::vector<std::string>& words) {
  return words.size() == 3 && words[0] == "format" && words[2] == "1.0" &&
         (words[1] == "ascii" || words[1] == "binary_little_endian" || words[1] == "binary_big_endian");
}

// One line without its end; false at the end of the file or where the line is too long for a header.
bool read_line(std::istream& file, std::string& line) {
  line.clear();
  for (char c; line.size() < kMaxLineLength && file.get(c);) {
    if (c == '\n') return true;
    line += c;
  }
  return false;
}

}  // namespace

void check_ply_header(std::istream& file, std::string_view subject) {
  constexpr std::string_view kAccepted = "PLY 1.0 with elements vertex and face";
  std::string line;
  bool has_format = false;
  for (std::size_t number = 1; number <= kMaxLines && read_line(file, line); ++number) {
    std::istringstream stream(line);
    std::vector<std::string> words;
    for (std::string word; stream >> word;) words.push_back(word);
    if (words.empty()) continue;
    const bool is_first = number == 1;
    if (words[0] == "end_header" && has_format) return;
    if (words[0] == "element" && words.size() > 1 && words[1] == "tristrips")
      throw Error(subject, "holds triangle strips", kAccepted);
    if (is_first     ? words[0] == "ply"
        : has_format ? is_header_line(words)
                     : is_format_line(words) || words[0] == "comment") {
      has_format = has_format || words[0] == "format";
      continue;
    }
    throw Error(subject, fmt::format("has a malformed header (line {}: \"{}\")", number, printable(line)), kAccepted);
  }
  throw Error(subject, "has a header without an end", kAccepted);
}

}  // namespace shlight
