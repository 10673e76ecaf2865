#pragma once

#include <vector>

#include "shlight/image/layout.h"
#include "shlight/sh/project.h"

// Pixels as areas of the sphere.

namespace shlight {

struct Pixel {
  int x = 0, y = 0;
  bool operator==(const Pixel&) const = default;
};

// The image point of a pixel's centre, and the pixel that covers an image point.
ImagePoint pixel_centre(Layout layout, PictureSize size, Pixel pixel);
Pixel pixel_at(Layout layout, PictureSize size, ImagePoint point);

// A direction and the solid angle, in steradians, that it stands for.
struct WeightedDirection {
  Vec3d direction;
  double solid_angle = 0;
};

// What a pixel covers along one side of its face (of the whole picture, where that is not one of faces), in [−1, 1] to
// the right or downward.
struct PixelSide {
  double from = 0, to = 0;
  int face = 0;  // counted along the same side
};

// Quadrature over the pixels of a picture: the integral over a pixel of a smooth function of the direction is the sum
// over its nodes. A pixel that is cut by a disc's circle has nodes in the part inside; one that lies across the creases
// of the octahedron has them piece by piece.
class PixelQuadrature {
 public:
  enum class Nodes {
    kGauss,   // for smooth functions
    kEvenly,  // for what has pixels of its own
  };
  // A pixel at a disc's edge has two nodes a side more.
  PixelQuadrature(Layout layout, PictureSize size, int nodes_a_side, Nodes kind = Nodes::kGauss);

  // The nodes of a pixel, none for pixels outside of a disc's circle or of a cross's faces. `nodes` is overwritten.
  void nodes(Pixel pixel, std::vector<WeightedDirection>& nodes) const;

  // Whether a pixel stands for any direction.
  bool covers(Pixel pixel) const;

  // The solid angle of a pixel in steradians: in closed form, but for pixels of the angular map and the octahedral map
  // and those at the edge of the mirror ball. All pixels together have 4π.
  double solid_angle(Pixel pixel) const;

 private:
  Layout layout_;
  GaussLegendre rule_, edge_rule_;
  double disc_edge_;
  std::vector<PixelSide> columns_, rows_;
  FaceGrid grid_;
  std::vector<const CubeFace*> faces_;  // by row and column; null where a cross has none
};

// How many nodes a side it takes for functions of so many bands to be right to 1e-8 of their largest value in each
// pixel.
int nodes_a_side_for(Layout layout, PictureSize size, int bands);

// The same for a single pixel, to 1e-7 in pictures of 7 pixels and more.
double pixel_solid_angle(Layout layout, PictureSize size, Pixel pixel);

}  // namespace shlight
