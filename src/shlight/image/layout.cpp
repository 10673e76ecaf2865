#include "shlight/image/layout.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

namespace shlight {
namespace {

using std::numbers::pi;

// --- the faces of cubes

constexpr Vec3d kX = {1, 0, 0}, kY = {0, 1, 0}, kZ = {0, 0, 1};

// The faces as every layout but OpenEXR's shows them, in the sequence of strips and files.
constexpr CubeFace kRight = {0, 0, kX, kZ, -kY};
constexpr CubeFace kLeft = {0, 0, -kX, -kZ, -kY};
constexpr CubeFace kTop = {0, 0, kY, kX, -kZ};
constexpr CubeFace kBottom = {0, 0, -kY, kX, kZ};
constexpr CubeFace kFront = {0, 0, -kZ, kX, -kY};
constexpr CubeFace kBack = {0, 0, kZ, -kX, -kY};

constexpr CubeFace at(int column, int row, CubeFace face) {
  return {column, row, face.forward, face.right, face.down};
}
constexpr CubeFace upside_down(CubeFace face) {
  return {face.column, face.row, face.forward, -face.right, -face.down};
}
// Half a turn about Y.
constexpr CubeFace half_turned(CubeFace face) {
  const auto turn = [](Vec3d a) { return Vec3d{-a.x, a.y, -a.z}; };
  return {face.column, face.row, turn(face.forward), turn(face.right), turn(face.down)};
}

using SixFaces = std::array<CubeFace, 6>;
constexpr SixFaces kVerticalStrip = {at(0, 0, kRight),  at(0, 1, kLeft),  at(0, 2, kTop),
                                     at(0, 3, kBottom), at(0, 4, kFront), at(0, 5, kBack)};
constexpr SixFaces kHorizontalStrip = {at(0, 0, kRight),  at(1, 0, kLeft),  at(2, 0, kTop),
                                       at(3, 0, kBottom), at(4, 0, kFront), at(5, 0, kBack)};
constexpr SixFaces kVerticalCross = {at(2, 1, kRight),  at(0, 1, kLeft),  at(1, 0, kTop),
                                     at(1, 2, kBottom), at(1, 1, kFront), at(1, 3, upside_down(kBack))};
constexpr SixFaces kHorizontalCross = {at(2, 1, kRight),  at(0, 1, kLeft),  at(1, 0, kTop),
                                       at(1, 2, kBottom), at(1, 1, kFront), at(3, 1, kBack)};
// OpenEXR's faces are those of a right-handed frame.
constexpr SixFaces kOpenExrCube = {at(0, 0, half_turned(kRight)), at(0, 1, half_turned(kLeft)),
                                   at(0, 2, half_turned(kTop)),   at(0, 3, half_turned(kBottom)),
                                   at(0, 4, half_turned(kBack)),  at(0, 5, half_turned(kFront))};

// --- what sets the layouts apart

struct Traits {
  Layout layout;
  std::string_view name;
  std::span<const CubeFace> faces;
  FaceGrid grid;
  std::string_view shape;
  double sizes_a_horizon;  // `size` over the pixels round the horizon
};
constexpr Traits kTraits[] = {
    {Layout::kLatLong, "lat-long", {}, {}, "2:1", 1},
    {Layout::kAngularMap, "angular-map", {}, {}, "1:1", 1},
    {Layout::kMirrorBall, "mirror-ball", {}, {}, "1:1", 1},
    {Layout::kCube, "cube", kVerticalStrip, {1, 6}, "six square files", 0.25},
    {Layout::kVerticalCross, "vertical-cross", kVerticalCross, {3, 4}, "3:4", 0.25},
    {Layout::kHorizontalCross, "horizontal-cross", kHorizontalCross, {4, 3}, "4:3", 0.25},
    {Layout::kHorizontalStrip, "horizontal-strip", kHorizontalStrip, {6, 1}, "6:1", 0.25},
    {Layout::kVerticalStrip, "vertical-strip", kVerticalStrip, {1, 6}, "1:6", 0.25},
    {Layout::kOctahedral, "octahedral", {}, {}, "1:1", 0.5},
    {Layout::kOpenExrLatLong, "openexr-lat-long", {}, {}, "2:1", 1},
    {Layout::kOpenExrCube, "openexr-cube", kOpenExrCube, {1, 6}, "1:6", 0.25},
};

const Traits& traits(Layout layout) {
  const Traits& found = kTraits[static_cast<std::size_t>(layout)];
  assert(found.layout == layout);
  return found;
}

constexpr auto kAll = [] {
  std::array<Layout, std::size(kTraits)> all{};
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = kTraits[i].layout;
  return all;
}();

// --- discs: (x, y) in the unit circle, x right, y up

Vec3d direction_in_angular_map(double x, double y) {
  const double r = std::hypot(x, y);
  const double scale = r < 1e-12 ? pi : std::sin(pi * r) / r;
  return {scale * x, scale * y, -std::cos(pi * r)};
}

// sin θ = 2 r √(1−r²) and cos θ = 1 − 2r² for the angle θ = 2 asin r.
Vec3d direction_in_mirror_ball(double x, double y) {
  const double r2 = x * x + y * y, scale = 2 * std::sqrt(std::max(0.0, 1 - r2));
  return {scale * x, scale * y, 2 * r2 - 1};
}

// --- octahedral: (x, y) in [−1, 1]²; beyond the diamond |x| + |y| = 1 the back's four faces are folded out.

Vec3d direction_in_octahedron(double x, double y) {
  const double beyond = std::abs(x) + std::abs(y) - 1;
  Vec3d p = {x, y, beyond};
  if (beyond > 0) p = {std::copysign(1 - std::abs(y), x), std::copysign(1 - std::abs(x), y), beyond};
  return 1 / std::sqrt(dot(p, p)) * p;
}

ImagePoint point_in_octahedron(Vec3d d) {
  const double sum = std::abs(d.x) + std::abs(d.y) + std::abs(d.z);
  double x = d.x / sum, y = d.y / sum;
  if (d.z > 0) {
    const double folded = std::copysign(1 - std::abs(y), x);
    y = std::copysign(1 - std::abs(x), y);
    x = folded;
  }
  return {0.5 + 0.5 * x, 0.5 - 0.5 * y};
}

}  // namespace

std::string_view layout_name(Layout layout) {
  return traits(layout).name;
}

std::optional<Layout> layout_from_name(std::string_view name) {
  for (const Traits& entry : kTraits)
    if (entry.name == name) return entry.layout;
  return std::nullopt;
}

std::span<const Layout> all_layouts() {
  return kAll;
}

std::span<const CubeFace> cube_faces(Layout layout) {
  return traits(layout).faces;
}

FaceGrid face_grid(Layout layout) {
  return traits(layout).grid;
}

bool is_lat_long(Layout layout) {
  return layout == Layout::kLatLong || layout == Layout::kOpenExrLatLong;
}

bool centres_on_border(Layout layout) {
  return layout == Layout::kOpenExrLatLong || layout == Layout::kOpenExrCube;
}

PictureSize picture_size(Layout layout, int size) {
  if (is_lat_long(layout)) return {size, std::max(1, size / 2)};
  const auto [columns, rows] = face_grid(layout);
  return {columns * size, rows * size};
}

int size_from_horizon(Layout layout, int horizon) {
  return std::max(1, static_cast<int>(std::lround(horizon * traits(layout).sizes_a_horizon)));
}

int horizon_from_size(Layout layout, int size) {
  return static_cast<int>(std::lround(size / traits(layout).sizes_a_horizon));
}

bool fits(Layout layout, PictureSize size) {
  if (size.width < 1 || size.height < 1) return false;
  if (is_lat_long(layout)) return true;
  const auto [columns, rows] = face_grid(layout);
  return size.width % columns == 0 && size.height % rows == 0 && size.width / columns == size.height / rows;
}

std::string_view shape_name(Layout layout) {
  return traits(layout).shape;
}

std::optional<Vec3d> direction_at(Layout layout, ImagePoint point) {
  if (is_lat_long(layout)) {
    const double phi = 2 * pi * (point.u - 0.5), theta = pi * point.v;
    return Vec3d{std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi)};
  }
  if (const auto faces = cube_faces(layout); !faces.empty()) {
    const auto [columns, rows] = face_grid(layout);
    const double u = point.u * columns, v = point.v * rows;
    const int column = std::clamp(static_cast<int>(u), 0, columns - 1),
              row = std::clamp(static_cast<int>(v), 0, rows - 1);
    for (const CubeFace& face : faces)
      if (face.column == column && face.row == row) {
        const double s = 2 * (u - column) - 1, t = 2 * (v - row) - 1;
        return 1 / std::sqrt(1 + s * s + t * t) * (face.forward + s * face.right + t * face.down);
      }
    return std::nullopt;
  }
  const double x = 2 * point.u - 1, y = 1 - 2 * point.v;
  if (layout == Layout::kOctahedral) return direction_in_octahedron(x, y);
  if (x * x + y * y > 1) return std::nullopt;
  return layout == Layout::kAngularMap ? direction_in_angular_map(x, y) : direction_in_mirror_ball(x, y);
}

ImagePoint point_of(Layout layout, Vec3d d) {
  if (is_lat_long(layout)) {
    // atan2 twice: acos loses half of its digits toward the poles.
    return {0.5 + std::atan2(d.x, -d.z) / (2 * pi), std::atan2(std::hypot(d.x, d.z), d.y) / pi};
  }
  if (const auto faces = cube_faces(layout); !faces.empty()) {
    const auto face = std::max_element(faces.begin(), faces.end(), [&](const CubeFace& a, const CubeFace& b) {
      return dot(d, a.forward) < dot(d, b.forward);
    });
    const double depth = dot(d, face->forward);
    // Its edge would be the next face's in the picture.
    constexpr double kInside = 1 - 1e-12;
    const auto [columns, rows] = face_grid(layout);
    const double s = std::clamp(dot(d, face->right) / depth, -kInside, kInside);
    const double t = std::clamp(dot(d, face->down) / depth, -kInside, kInside);
    return {(face->column + 0.5 + 0.5 * s) / columns, (face->row + 0.5 + 0.5 * t) / rows};
  }
  if (layout == Layout::kOctahedral) return point_in_octahedron(d);
  const double sine = std::hypot(d.x, d.y), theta = std::atan2(sine, -d.z);
  const double r = layout == Layout::kAngularMap ? theta / pi : std::sin(theta / 2);
  if (sine == 0) return {0.5 + 0.5 * r, 0.5};
  return {0.5 + 0.5 * r * d.x / sine, 0.5 - 0.5 * r * d.y / sine};
}

}  // namespace shlight
