#pragma once

#include <span>

#include "shlight/sh/rotation.h"
#include "shlight/sh/vec.h"

namespace shlight {

// A frame whose +Z is a normal, turned by an angle about it: world = R_z(φ) R_y(θ) R_z(spin) local, with θ and φ the
// normal's polar angle and azimuth.
struct LocalFrame {
  Vec3d x, y, z;  // the frame's axes in the world
  double cos_theta = 1, sin_theta = 0, cos_phi = 1, sin_phi = 0, cos_spin = 1, sin_spin = 0;
};
LocalFrame make_local_frame(Vec3d normal, double spin);

// Takes coefficients from such frames to the world. A turn about y is a turn about z between two fixed quarter turns
// about x, so that nothing but multiples of angles changes from frame to frame: much less work than a RotationMatrix
// of each [1].
//
// [1] Kautz, Sloan, Snyder 2002, Fast, Arbitrary BRDF Shading for Low-Frequency Lighting Using Spherical Harmonics,
//     appendix.
class FrameRotation {
 public:
  explicit FrameRotation(int bands);
  // In place; num_coefficients(bands) values.
  void to_world(const LocalFrame& frame, std::span<double> coefficients) const;

 private:
  RotationMatrix quarter_turn_;  // about x, from y to z
};

}  // namespace shlight
