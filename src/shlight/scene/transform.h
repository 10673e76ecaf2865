#pragma once

#include "shlight/scene/scene.h"
#include "shlight/sh/rotation.h"

namespace shlight {

// Matrices that put things into the world: column vectors, stored by columns, so element (row, column) is
// m[4 · column + row]. Only affine ones are meant; the bottom row is not looked at.

Mat4f make_translation(Vec3f offset);
Mat4f make_scaling(Vec3f factors);
// Counter-clockwise seen from the tip of `axis`, which need not have unit length but must not be zero.
Mat4f make_rotation(Vec3f axis, float degrees);
Mat4f make_rotation(const Rotation& rotation);

// First `b`, then `a`.
Mat4f multiply(const Mat4f& a, const Mat4f& b);

// Of the upper left 3x3: how much volumes grow; negative where the matrix mirrors.
double determinant(const Mat4f& m);

Vec3f transform_point(const Mat4f& m, Vec3f p);
// Of a vector between two points, such as a tangent: the translation has no say.
Vec3f transform_vector(const Mat4f& m, Vec3f v);
// Of a surface's normal: by the inverse transpose, then made of unit length. Zero where the matrix flattens the
// surface.
Vec3f transform_normal(const Mat4f& m, Vec3f n);

}  // namespace shlight
