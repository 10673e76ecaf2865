#pragma once

#include <array>
#include <optional>

#include "shlight/scene/scene.h"
#include "shlight/sh/vec.h"

namespace shlight {

// Turns around the point looked at, `target`. Azimuth 0 and elevation 0 look down -Z; azimuth turns the camera toward
// +X, so that azimuth 90 looks down -X; elevation raises it.
struct Camera {
  double azimuth = 30;       // degrees
  double elevation = 15;     // degrees, in [-90, 90]
  double zoom = 1;           // above 0; 1 frames the whole model, 2 is twice as near
  double vertical_fov = 35;  // degrees, in (0, 180)
  Vec3d target = {};         // from the centre of what is framed, in its radii, the world's axes
};

// What a camera frames. The scene is inside the ball around `center` and inside the upright cylinder around it, so that
// a camera may turn about +Y without the distance changing.
struct Extent {
  Vec3d center;
  double radius = 1;           // of the ball; above 0
  double cylinder_radius = 1;  // about the vertical through center
  double half_height = 1;      // of the cylinder, up and down from center
};

// The extent of all instances in the world. A unit ball around the origin where the scene has no vertex, around the
// point where all vertices are one point. Transforms every vertex once.
Extent scene_extent(const Scene& scene);

// Column-major 4x4 matrix.
using Mat4d = std::array<double, 16>;

// The two matrices of a picture, as OpenGL has them: the view looks down -Z and is measured in radii of the extent,
// whatever the world's unit is; clip space has y up. Double, so that a model far from the origin keeps its detail.
struct View {
  Mat4d world_to_view;
  Mat4d view_to_clip;
};

// Frames `extent` in a picture of `aspect` = width / height: at zoom 1 the ball or the cylinder, whichever takes more
// of the picture, just fits with a small margin. Near and far planes hold all of the ball that is
// before the camera.
View make_view(const Camera& camera, const Extent& extent, double aspect);

// Where a point of the world is in the picture: to the right and up from the middle, its sides at ±1; nothing for what
// is not before the eye.
struct PicturePlace {
  double x = 0, y = 0;
};
std::optional<PicturePlace> place_in_picture(const View& view, Vec3d point);

// Moves the target so that what is at its depth moves to the right and up by these parts of the picture's height, as if
// it were held by a pointer.
void pan_camera(Camera& camera, const Extent& extent, double aspect, double right, double up);

}  // namespace shlight
