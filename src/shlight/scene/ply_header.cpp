#include "shlight/scene/ply_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <istream>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "shlight/core/error.h"
#include "shlight/scene/model_folder.h"

namespace shlight {
namespace {

constexpr std::size_t kMaxLineLength = 1024;
constexpr std::size_t kMaxLines = 10'000;

// Bytes of a type in binary files; 0: no type.
std::uint64_t size_of_type(std::string_view word) {
  constexpr std::array<std::pair<std::string_view, int>, 16> kTypes = {{{"char", 1},
                                                                        {"uchar", 1},
                                                                        {"short", 2},
                                                                        {"ushort", 2},
                                                                        {"int", 4},
                                                                        {"uint", 4},
                                                                        {"float", 4},
                                                                        {"double", 8},
                                                                        {"int8", 1},
                                                                        {"uint8", 1},
                                                                        {"int16", 2},
                                                                        {"uint16", 2},
                                                                        {"int32", 4},
                                                                        {"uint32", 4},
                                                                        {"float32", 4},
                                                                        {"float64", 8}}};
  for (const auto& [name, size] : kTypes)
    if (word == name) return static_cast<std::uint64_t>(size);
  return 0;
}
bool is_type(std::string_view word) {
  return size_of_type(word) > 0;
}

std::optional<std::uint32_t> parse_count(std::string_view word) {
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

bool is_header_line(const std::vector<std::string>& words) {
  const std::string& keyword = words[0];
  if (keyword == "comment" || keyword == "obj_info") return true;
  if (keyword == "element") return words.size() == 3 && parse_count(words[2]);
  if (keyword == "property" && words.size() == 3) return is_type(words[1]);
  if (keyword == "property" && words.size() == 5) return words[1] == "list" && is_type(words[2]) && is_type(words[3]);
  return false;
}

bool is_format_line(const std::vector<std::string>& words) {
  return words.size() == 3 && words[0] == "format" && words[2] == "1.0" &&
         (words[1] == "ascii" || words[1] == "binary_little_endian" || words[1] == "binary_big_endian");
}

// The least that the data after a header can take: of each element a byte, of its properties their size, which for a
// list is that of its length; in text a digit and what separates it.
class LeastBytes {
 public:
  void add(const std::vector<std::string>& words) {
    if (words[0] == "format") is_text_ = words[1] == "ascii";
    if (words[0] == "element") finish_element(), count_ = *parse_count(words[2]);
    if (words[0] == "property") each_ += is_text_ ? 2 : size_of_type(words[words.size() == 5 ? 2 : 1]);
  }
  // What separates the last number from the end of a text may be missing.
  std::uint64_t sum() {
    finish_element();
    return is_text_ && sum_ > 0 ? sum_ - 1 : sum_;
  }

 private:
  // 32 bits of elements times 10'000 lines of 8 bytes are far from 64 bits.
  void finish_element() {
    sum_ += count_ * std::max<std::uint64_t>(each_, 1);
    count_ = each_ = 0;
  }

  bool is_text_ = false;
  std::uint64_t count_ = 0, each_ = 0, sum_ = 0;
};

std::uint64_t bytes_left(std::istream& file) {
  const auto here = file.tellg();
  file.seekg(0, std::ios::end);
  const auto end = file.tellg();
  file.seekg(here);
  return static_cast<std::uint64_t>(end - here);
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
  LeastBytes promised;
  for (std::size_t number = 1; number <= kMaxLines && read_line(file, line); ++number) {
    std::istringstream stream(line);
    std::vector<std::string> words;
    for (std::string word; stream >> word;) words.push_back(word);
    if (words.empty()) continue;
    const bool is_first = number == 1;
    if (words[0] == "end_header" && has_format) {
      const std::uint64_t least = promised.sum(), left = bytes_left(file);
      if (least <= left) return;
      throw Error(subject, fmt::format("has {} bytes after its header, which promises at least {}", left, least),
                  "a whole file");
    }
    if (words[0] == "element" && words.size() > 1 && words[1] == "tristrips")
      throw Error(subject, "holds triangle strips", kAccepted);
    if (is_first     ? words[0] == "ply"
        : has_format ? is_header_line(words)
                     : is_format_line(words) || words[0] == "comment") {
      has_format = has_format || words[0] == "format";
      promised.add(words);
      continue;
    }
    throw Error(subject, fmt::format("has a malformed header (line {}: \"{}\")", number, printable(line)), kAccepted);
  }
  throw Error(subject, "has a header without an end", kAccepted);
}

}  // namespace shlight
