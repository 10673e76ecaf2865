#include "shlight/scene/transform.h"

#include <cmath>
#include <numbers>

namespace shlight {
namespace {

// The first three columns: where the matrix takes the axes.
struct Axes {
  Vec3d x, y, z;
};

Axes axes_of(const Mat4f& m) {
  return {{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}};
}

}  // namespace

Mat4f make_translation(Vec3f offset) {
  Mat4f m = kIdentity;
  m[12] = offset.x, m[13] = offset.y, m[14] = offset.z;
  return m;
}

Mat4f make_scaling(Vec3f factors) {
  Mat4f m = kIdentity;
  m[0] = factors.x, m[5] = factors.y, m[10] = factors.z;
  return m;
}

Mat4f make_rotation(Vec3f axis, float degrees) {
  const Vec3d long_axis = vec_cast<double>(axis);
  const Vec3d k = (1 / std::sqrt(dot(long_axis, long_axis))) * long_axis;
  const double angle = degrees * std::numbers::pi / 180;
  const double c = std::cos(angle), s = std::sin(angle);

  // Rodrigues: e turns into c e + s k x e + (1 - c)(k · e) k.
  Mat4f m = kIdentity;
  const Vec3d units[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (int column = 0; column < 3; ++column) {
    const Vec3d e = units[column];
    const Vec3f turned = vec_cast<float>(c * e + s * cross(k, e) + ((1 - c) * dot(k, e)) * k);
    m[4 * column] = turned.x, m[4 * column + 1] = turned.y, m[4 * column + 2] = turned.z;
  }
  return m;
}

Mat4f make_rotation(const Rotation& rotation) {
  Mat4f m = kIdentity;
  for (std::size_t row = 0; row < 3; ++row) {
    const Vec3f r = vec_cast<float>(rotation.rows[row]);
    m[row] = r.x, m[4 + row] = r.y, m[8 + row] = r.z;
  }
  return m;
}

Mat4f multiply(const Mat4f& a, const Mat4f& b) {
  Mat4f product = {};
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row) {
      double sum = 0;
      for (int k = 0; k < 4; ++k) sum += double{a[4 * k + row]} * double{b[4 * column + k]};
      product[4 * column + row] = static_cast<float>(sum);
    }
  return product;
}

double determinant(const Mat4f& m) {
  const Axes a = axes_of(m);
  return dot(a.x, cross(a.y, a.z));
}

Vec3f transform_point(const Mat4f& m, Vec3f p) {
  return transform_vector(m, p) + Vec3f{m[12], m[13], m[14]};
}

Vec3f transform_vector(const Mat4f& m, Vec3f v) {
  return {m[0] * v.x + m[4] * v.y + m[8] * v.z, m[1] * v.x + m[5] * v.y + m[9] * v.z,
          m[2] * v.x + m[6] * v.y + m[10] * v.z};
}

Vec3f transform_normal(const Mat4f& m, Vec3f n) {
  // The inverse transpose is the matrix of cofactors over the determinant, of which only the sign matters here. The
  // cofactors' columns are cross products of the matrix's.
  const Axes a = axes_of(m);
  const double sign = dot(a.x, cross(a.y, a.z)) < 0 ? -1 : 1;
  const Vec3d v =
      sign * (double{n.x} * cross(a.y, a.z) + double{n.y} * cross(a.z, a.x) + double{n.z} * cross(a.x, a.y));
  const double length = std::sqrt(dot(v, v));
  return length > 0 ? vec_cast<float>((1 / length) * v) : Vec3f{};
}

}  // namespace shlight
