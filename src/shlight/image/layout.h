#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "shlight/image/image.h"
#include "shlight/sh/vec.h"

// How the pixels of a picture are laid out over the directions of an environment.
//
// In every layout the centre is what a camera looking down −Z sees: image right = +X, image top = +Y. Image coordinates
// (u, v) run over [0, 1]², u to the right, v down.
//
//   lat-long (equirectangular), 2:1                angular map ("light probe" [1]), 1:1
//
//    +---------- +Y ----------+                          . - +Y - .
//    |                        |                        /           \      angle from −Z = π · radius,
//   +Z   -X     -Z    +X     +Z                      -X     -Z     +X     radius 1 at the circle,
//    |                        |                        \           /      which is all +Z
//    +---------- -Y ----------+                          ' - -Y - '
//
//   u = 1/2 + atan2(x, −z)/2π                      (u, v) − 1/2 = (x, −y)/√(x²+y²) · acos(−z)/2π
//   v = acos(y)/π
//
// [1] Debevec 1998, Rendering Synthetic Objects into Real Scenes: Bridging Traditional and Image-Based Graphics with
// Global
//     Illumination and High Dynamic Range Photography, SIGGRAPH.

namespace shlight {

enum class Layout {
  kLatLong,
  kAngularMap,
  kMirrorBall,
  kCube,  // six files or a DDS file; in memory a vertical strip
  kVerticalCross,
  kHorizontalCross,
  kHorizontalStrip,
  kVerticalStrip,
  kOctahedral,
  kOpenExrLatLong,
  kOpenExrCube
};

// The names that the tool and its files use: "lat-long", "angular-map".
std::string_view layout_name(Layout layout);
std::optional<Layout> layout_from_name(std::string_view name);
std::span<const Layout> all_layouts();

// The layout that a picture's shape tells: 2:1 is lat-long, 1:1 an angular map; nothing for others.
std::optional<Layout> layout_from_shape(int width, int height);

struct ImagePoint {
  double u = 0, v = 0;
};

// The unit direction at an image point; nothing outside of the angular map's circle.
std::optional<Vec3d> direction_at(Layout layout, ImagePoint point);

// The image point of a unit direction, in [0, 1]².
ImagePoint point_of(Layout layout, Vec3d direction);

// A direction and the solid angle, in steradians, that it stands for.
struct WeightedDirection {
  Vec3d direction;
  double solid_angle = 0;
};

// Quadrature nodes of pixel (x, y): the integral over the pixel of a smooth function of the direction is the sum over
// the nodes. None for pixels outside of an angular map's circle; for those on it, nodes of the part inside. For
// functions of 10 bands, maps of 64 pixels and more are right to 1e-10. `nodes` is overwritten.
void pixel_nodes(Layout layout, int width, int height, int x, int y, std::vector<WeightedDirection>& nodes);

// The solid angle of pixel (x, y) in steradians, exact: in closed form for lat-long, by its nodes for the angular map
// (to 1e-7 for maps of 7 pixels and more). All pixels together have 4π.
double pixel_solid_angle(Layout layout, int width, int height, int x, int y);

// A picture that covers all directions.
struct Environment {
  Image image;
  Layout layout = Layout::kLatLong;
};

// The radiance of the pixel that covers a direction: pixels are areas of constant radiance.
Rgb eval_nearest(const Environment& environment, Vec3d direction);

// Bilinear between the four pixel centres around; goes on across the seam and over the poles of a lat-long map.
Rgb eval_bilinear(const Environment& environment, Vec3d direction);

}  // namespace shlight
