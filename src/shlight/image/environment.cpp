#include "shlight/image/environment.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "shlight/image/pixels.h"

namespace shlight {
namespace {

// The pixel (x, y) of a lat-long map continued over its borders: round about, and over a pole to the other side.
Rgb beyond_lat_long(const Image& image, int x, int y) {
  if (y < 0 || y >= image.height) {
    y = y < 0 ? -1 - y : 2 * image.height - 1 - y;
    x += image.width / 2;
  }
  return image.rgb((x % image.width + image.width) % image.width, std::clamp(y, 0, image.height - 1));
}

// Each edge of an octahedral map is folded about its middle.
Rgb beyond_octahedral(const Image& image, int x, int y) {
  if (x < 0 || x >= image.width) {
    x = std::clamp(x, 0, image.width - 1);
    y = image.height - 1 - y;
  }
  if (y < 0 || y >= image.height) {
    y = std::clamp(y, 0, image.height - 1);
    x = image.width - 1 - x;
  }
  return image.rgb(x, y);
}

// Where a position between pixel centres lies, in pixels: x + 1/2 is the centre of pixel x.
struct Position {
  double x = 0, y = 0;
};

Position position_of(const Environment& environment, ImagePoint point) {
  const auto [width, height] = environment.size();
  if (!centres_on_border(environment.layout)) return {point.u * width, point.v * height};
  const auto [columns, rows] = face_grid(environment.layout);
  const auto along = [](double coordinate, int faces, int pixels) {
    const int face = std::clamp(static_cast<int>(coordinate * faces), 0, faces - 1);
    return face * pixels + (coordinate * faces - face) * (pixels - 1) + 0.5;
  };
  return {along(point.u, columns, width / columns), along(point.v, rows, height / rows)};
}

// The pixel (x, y) of the face in which (home) lies, continued over the face's borders in its own plane.
Rgb beyond_face(const Environment& environment, Pixel home, int x, int y) {
  const auto [columns, rows] = face_grid(environment.layout);
  const int n = environment.image.width / columns;
  const int column = home.x / n, row = home.y / n;
  if (x / n == column && y / n == row && x >= 0 && y >= 0) return environment.image.rgb(x, y);
  for (const CubeFace& face : cube_faces(environment.layout))
    if (face.column == column && face.row == row) {
      const double s = (2 * (x - column * n) + 1.0) / n - 1, t = (2 * (y - row * n) + 1.0) / n - 1;
      const Vec3d direction = face.forward + s * face.right + t * face.down;
      return eval_nearest(environment, 1 / std::sqrt(dot(direction, direction)) * direction);
    }
  return environment.image.rgb(home.x, home.y);
}

// Nothing where the pixel's centre lies outside of the circle.
std::optional<Rgb> within_disc(const Environment& environment, int x, int y) {
  const auto [width, height] = environment.size();
  const Pixel pixel = {std::clamp(x, 0, width - 1), std::clamp(y, 0, height - 1)};
  if (!direction_at(environment.layout, pixel_centre(environment.layout, environment.size(), pixel))) return {};
  return environment.image.rgb(pixel.x, pixel.y);
}

// OpenEXR's outermost centres lie on the border: there is nothing to continue.
Rgb clamped(const Image& image, int x, int y) {
  return image.rgb(std::clamp(x, 0, image.width - 1), std::clamp(y, 0, image.height - 1));
}

// The pixel (x, y), which need not be one of the picture's, as seen from `home`.
std::optional<Rgb> pixel_beyond(const Environment& environment, Pixel home, int x, int y) {
  switch (environment.layout) {
    case Layout::kLatLong:
      return beyond_lat_long(environment.image, x, y);
    case Layout::kOctahedral:
      return beyond_octahedral(environment.image, x, y);
    case Layout::kAngularMap:
    case Layout::kMirrorBall:
      return within_disc(environment, x, y);
    case Layout::kOpenExrLatLong:
      return clamped(environment.image, x, y);
    default:
      return beyond_face(environment, home, x, y);
  }
}

// Whether the four pixels around a position are all of the same face and the same disc as it: nearly always.
bool is_inside(const Environment& environment, double x, double y) {
  const auto [columns, rows] = face_grid(environment.layout);
  const double width = environment.image.width / columns, height = environment.image.height / rows;
  const double u = x - width * std::floor(x / width), v = y - height * std::floor(y / height);
  if (u < 0.5 || u >= width - 0.5 || v < 0.5 || v >= height - 0.5) return false;
  if (environment.layout != Layout::kAngularMap && environment.layout != Layout::kMirrorBall) return true;
  const double right = std::abs(u - width / 2) + 1, down = std::abs(v - height / 2) + 1;
  return right * right + down * down < width * width / 4;
}

}  // namespace

Rgb eval_nearest(const Environment& environment, Vec3d direction) {
  const Pixel pixel = pixel_at(environment.layout, environment.size(), point_of(environment.layout, direction));
  return environment.image.rgb(pixel.x, pixel.y);
}

Rgb eval_bilinear(const Environment& environment, Vec3d direction) {
  const Image& image = environment.image;
  const ImagePoint point = point_of(environment.layout, direction);
  const auto [px, py] = position_of(environment, point);
  const int x0 = static_cast<int>(std::floor(px - 0.5)), y0 = static_cast<int>(std::floor(py - 0.5));
  const double right = px - 0.5 - x0, down = py - 0.5 - y0;
  if (is_inside(environment, px, py)) {
    const Rgb top = (1 - right) * image.rgb(x0, y0) + right * image.rgb(x0 + 1, y0);
    const Rgb bottom = (1 - right) * image.rgb(x0, y0 + 1) + right * image.rgb(x0 + 1, y0 + 1);
    return (1 - down) * top + down * bottom;
  }
  const Pixel home = pixel_at(environment.layout, environment.size(), point);
  Rgb sum;
  double weights = 0;
  for (const int dy : {0, 1})
    for (const int dx : {0, 1}) {
      const double weight = (dx == 0 ? 1 - right : right) * (dy == 0 ? 1 - down : down);
      if (weight == 0) continue;
      if (const auto pixel = pixel_beyond(environment, home, x0 + dx, y0 + dy)) {
        sum += weight * *pixel;
        weights += weight;
      }
    }
  return weights > 0 ? 1 / weights * sum : image.rgb(home.x, home.y);
}

void clear_unused(Environment& environment) {
  const Layout layout = environment.layout;
  const PictureSize size = environment.size();
  if (layout != Layout::kAngularMap && layout != Layout::kMirrorBall && cube_faces(layout).empty()) return;
  const PixelQuadrature quadrature(layout, size, 1);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x)
      if (!quadrature.covers({x, y})) environment.image.set_rgb(x, y, {});
}

}  // namespace shlight
