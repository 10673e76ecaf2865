#include "shlight/image/picture_reader.h"

#include <fmt/format.h>

#include <algorithm>

namespace shlight {

Error malformed_picture(const std::string& name, std::string why) {
  std::replace(why.begin(), why.end(), '\n', ' ');
  if (why.size() > 200) why.resize(200);
  return Error(name, why.empty() ? "is not a picture" : "is not a readable picture (" + why + ")", kAcceptedPictures);
}

void check_picture_size(const std::string& name, std::int64_t width, std::int64_t height, std::uint64_t max_pixels) {
  if (width <= 0 || height <= 0)
    throw Error(name, fmt::format("has {} x {} pixels", width, height), "a picture with at least one pixel");
  if (static_cast<std::uint64_t>(width) > max_pixels / static_cast<std::uint64_t>(height))
    throw Error(name, fmt::format("has {} x {} pixels", width, height), fmt::format("at most {} pixels", max_pixels));
}

}  // namespace shlight
