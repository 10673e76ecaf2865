#pragma once

#include <array>

#include "shlight/scene/scene.h"

// A node's matrix must be a translation, a rotation and a scaling along the node's own axes [1, section 3.5.2]. Those
// of scenes may also shear: an unevenly scaled node with a turned one in it does. Two nodes, one in the other, can say
// every matrix.
//
// [1] Khronos Group: glTF 2.0 Specification, https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html

namespace shlight {

// First scaled, then turned, then moved.
struct Trs {
  Vec3d translation;
  std::array<double, 4> rotation = {0, 0, 0, 1};  // unit quaternion x, y, z, w
  Vec3d scale = {1, 1, 1};
};

// Whether the matrix neither shears nor is so large that its rounding looks like it. Its bottom row has no say.
bool is_trs(const Mat4f& m);

// `m` is the matrix of outer times that of inner. Of positive determinant.
struct TrsPair {
  Trs outer, inner;
};
TrsPair split_into_trs(const Mat4f& m);

}  // namespace shlight
