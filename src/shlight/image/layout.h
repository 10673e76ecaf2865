#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "shlight/sh/vec.h"

// How a picture is laid out over the directions of an environment.
//
// In every layout the centre, or the front face, is what a camera looking down −Z sees: image right = +X, image top =
// +Y, and no face is mirrored. Image coordinates (u, v) run over [0, 1]², u to the right, v down.
//
//   lat-long (equirectangular), 2:1                angular-map ("light probe" [1]), 1:1
//
//    +---------- +Y ----------+                          . - +Y - .
//    |                        |                        /           \      angle from −Z = π · radius,
//   +Z   -X     -Z    +X     +Z                      -X     -Z     +X     radius 1 at the circle,
//    |                        |                        \           /      which is all +Z
//    +---------- -Y ----------+                          ' - -Y - '
//
//   mirror-ball, 1:1: as the angular map, but the angle from −Z is 2 asin(radius), as an orthographic camera sees it in
//   a ball. Pixels have equal solid angles. A photograph of a ball shows the camera in its middle and its world
//   mirrored: flip it left to right, and it is this layout after half a turn about Y.
//
//   octahedral [2], 1:1                 vertical-cross, 3:4       horizontal-cross, 4:3
//
//   +Z ------ +Y ------ +Z                   +----+                    +----+
//    |      /  |  \      |                   | +Y |                    | +Y |
//    |    /    |    \    |              +----+----+----+          +----+----+----+----+
//   -X ------ -Z ------ +X              | -X | -Z | +X |          | -X | -Z | +X | +Z |
//    |    \    |    /    |              +----+----+----+          +----+----+----+----+
//    |      \  |  /      |                   | -Y |                    | -Y |
//   +Z ------ -Y ------ +Z                   +----+                    +----+
//                                            | +Z |  upside down
//                                            +----+
//
//   horizontal-strip, 6:1; vertical-strip, 1:6; and cube, the same six faces as files or in one DDS file. Names follow
//   the tools and the graphics interfaces, whose cubes are left-handed: their +Z, "pz", is the front.
//
//    +------+------+------+------+------+------+
//    |  px  |  nx  |  py  |  ny  |  pz  |  nz  |     names
//    |  +X  |  -X  |  +Y  |  -Y  |  -Z  |  +Z  |     the world's axis in the middle of the face
//    |right | left | top  |bottom|front | back |
//    +------+------+------+------+------+------+
//     top: +Y            +Z     -Z    +Y
//     right: +Z   -Z     +X     +X    +X     -X
//
//   openexr-lat-long, openexr-cube [3]: lat-long, and a vertical strip of +X −X +Y −Y +Z −Z in OpenEXR's frame, which
//   is ours after half a turn about Y. The centres of the outermost pixels lie on the border, so that those pixels are
//   half as wide, and (u, v) runs between them.
//
// [1] Debevec 1998, Rendering Synthetic Objects into Real Scenes: Bridging Traditional and Image-Based Graphics with
//     Global Illumination and High Dynamic Range Photography, SIGGRAPH.
// [2] Cigolle, Donow, Evangelakos, Mara, McGuire & Meyer 2014, A Survey of Efficient Representations for Independent
//     Unit Vectors, JCGT 3(2); Engelhardt & Dachsbacher 2008, Octahedron Environment Maps, VMV.
// [3] Kainz & Bogart, Technical Introduction to OpenEXR, "Environment Maps".

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

// The names that the tool and its files use: "lat-long", "angular-map", …
std::string_view layout_name(Layout layout);
std::optional<Layout> layout_from_name(std::string_view name);
std::span<const Layout> all_layouts();

// One face of a cube map: its place in the picture, counted in faces, and the world's axes of its middle, its right and
// its bottom.
struct CubeFace {
  int column = 0, row = 0;
  Vec3d forward, right, down;
};

// The six faces of a cube layout; empty for others.
std::span<const CubeFace> cube_faces(Layout layout);

// How many faces a cube layout's picture is wide and high; 1 x 1 for others.
struct FaceGrid {
  int columns = 1, rows = 1;
};
FaceGrid face_grid(Layout layout);

// lat-long and openexr-lat-long.
bool is_lat_long(Layout layout);

// Whether the centres of the outermost pixels lie on the border, as OpenEXR's do.
bool centres_on_border(Layout layout);

struct PictureSize {
  int width = 0, height = 0;
  bool operator==(const PictureSize&) const = default;
};

// The picture of a layout with a given width of a face of a cube, diameter of a disc, or width of another.
PictureSize picture_size(Layout layout, int size);

// The `size` with which a layout resolves about as much as a lat-long map of so many pixels round the horizon, and
// back.
int size_from_horizon(Layout layout, int horizon);
int horizon_from_size(Layout layout, int size);

// Whether a picture's shape is possible: square faces, a circle that is one; a lat-long map may have any.
bool fits(Layout layout, PictureSize size);
// The shape that `fits` wants, in words: "4:3".
std::string_view shape_name(Layout layout);

struct ImagePoint {
  double u = 0, v = 0;
};

// The unit direction at an image point; nothing outside of a disc's circle and a cross's faces.
std::optional<Vec3d> direction_at(Layout layout, ImagePoint point);

// The image point of a unit direction, in [0, 1]².
ImagePoint point_of(Layout layout, Vec3d direction);

}  // namespace shlight
