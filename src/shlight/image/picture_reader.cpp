#include "shlight/image/picture_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>

namespace shlight {

Error malformed_picture(const std::string& name, std::string why) {
  std::replace_if(
      why.begin(), why.end(), [](unsigned char c) { return c < ' '; }, ' ');
  if (why.size() > 200) why.resize(200);
  return Error(name, why.empty() ? "is not a picture" : "is not a readable picture (" + why + ")", kAcceptedPictures);
}

void check_picture_size(const std::string& name, std::int64_t width, std::int64_t height, std::uint64_t max_pixels) {
  if (width <= 0 || height <= 0)
    throw Error(name, fmt::format("has {} x {} pixels", width, height), "a picture with at least one pixel");
  if (static_cast<std::uint64_t>(width) > max_pixels / static_cast<std::uint64_t>(height))
    throw Error(name, fmt::format("has {} x {} pixels", width, height), fmt::format("at most {} pixels", max_pixels));
}

bool has_ending(const std::string& name, std::initializer_list<std::string_view> endings) {
  std::string ending = std::filesystem::path(name).extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return std::ranges::count(endings, ending) > 0;
}

float linear_from_srgb(float value) {
  return value <= 0.04045f ? value / 12.92f : std::pow((value + 0.055f) / 1.055f, 2.4f);
}

}  // namespace shlight
