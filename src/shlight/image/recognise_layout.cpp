#include "shlight/image/recognise_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string>
#include <vector>

#include "shlight/core/error.h"
#include "shlight/image/pixels.h"

namespace shlight {
namespace {

// Files of these say so in their header.
bool is_stated(Layout layout) {
  return layout == Layout::kCube || layout == Layout::kOpenExrLatLong || layout == Layout::kOpenExrCube;
}

bool has_shape(Layout layout, PictureSize size) {
  return is_lat_long(layout) ? size.width == 2 * size.height : fits(layout, size);
}

bool name_tells(const std::string& name, Layout layout) {
  const auto has = [&](std::string_view word) { return name.find(word) != std::string::npos; };
  if (has(layout_name(layout))) return true;
  if (layout == Layout::kAngularMap) return has("probe") || has("angular");
  if (layout == Layout::kMirrorBall) return has("mirror") || has("ball");
  if (layout == Layout::kOctahedral) return has("octa");
  return false;
}

// What lies beside a cross's faces is of one colour, near enough for a compressed picture.
bool has_plain_corners(Layout layout, const Image& image) {
  constexpr float kTolerance = 0.02f;
  const PictureSize size = {image.width, image.height};
  const PixelQuadrature pixels(layout, size, 1);
  const auto corner = image.pixel(image.width - 1, 0);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x)
      if (!pixels.covers({x, y}))
        for (std::size_t c = 0; c < 3; ++c)
          if (std::abs(image.pixel(x, y)[c] - corner[c]) > kTolerance) return false;
  return true;
}

std::string joined(const std::vector<Layout>& layouts) {
  std::string names;
  for (const Layout layout : layouts) names += (names.empty() ? "" : ", ") + std::string(layout_name(layout));
  return names;
}

}  // namespace

Layout recognise_layout(const std::filesystem::path& path, const Image& image) {
  const PictureSize size = {image.width, image.height};
  std::string name = path.stem().string();
  for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));

  std::vector<Layout> candidates, named;
  for (const Layout layout : all_layouts())
    if (!is_stated(layout) && has_shape(layout, size)) {
      candidates.push_back(layout);
      if (name_tells(name, layout)) named.push_back(layout);
    }
  if (candidates.empty())
    throw Error(path.string(), fmt::format("{} x {} pixels tell no layout", size.width, size.height),
                "2:1 for lat-long, 1:1 for angular-map, mirror-ball or octahedral, 3:4 or 4:3 for a cross, 6:1 or 1:6 "
                "for a strip, the six files of a cube, or a layout named with --layout");
  if (named.size() == 1) return named[0];
  if (candidates.size() > 1)
    throw Error(path.string(), fmt::format("{} x {} pixels may be of several layouts", size.width, size.height),
                "one of them named with --layout: " + joined(candidates));
  const Layout layout = candidates[0];
  if (!has_plain_corners(layout, image))
    throw Error(path.string(), fmt::format("has the shape of a {}, but its corners are not empty", layout_name(layout)),
                fmt::format("--layout {} if it is one", layout_name(layout)));
  return layout;
}

}  // namespace shlight
