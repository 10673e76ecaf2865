#include "shlight/transfer/gltf_nodes.h"

#include <algorithm>
#include <cmath>

namespace shlight {
namespace {

using Columns = std::array<Vec3d, 3>;

double length(Vec3d v) {
  return std::sqrt(dot(v, v));
}

Columns columns_of(const Mat4f& m) {
  return {Vec3d{m[0], m[1], m[2]}, Vec3d{m[4], m[5], m[6]}, Vec3d{m[8], m[9], m[10]}};
}

Columns transpose(const Columns& c) {
  return {Vec3d{c[0].x, c[1].x, c[2].x}, Vec3d{c[0].y, c[1].y, c[2].y}, Vec3d{c[0].z, c[1].z, c[2].z}};
}

// Of a rotation. Divides by the largest of the four numbers, which is at least 1/2.
std::array<double, 4> quaternion_of(const Columns& c) {
  const double xx = c[0].x, yy = c[1].y, zz = c[2].z;
  // Four times the square of each number.
  const std::array<double, 4> squares = {1 + xx - yy - zz, 1 - xx + yy - zz, 1 - xx - yy + zz, 1 + xx + yy + zz};
  // Four times the products: of pairs of x, y and z, and of each with w.
  const double xy = c[0].y + c[1].x, xz = c[0].z + c[2].x, yz = c[1].z + c[2].y;
  const double xw = c[1].z - c[2].y, yw = c[2].x - c[0].z, zw = c[0].y - c[1].x;
  const std::array<double, 4> rows[4] = {
      {squares[0], xy, xz, xw}, {xy, squares[1], yz, yw}, {xz, yz, squares[2], zw}, {xw, yw, zw, squares[3]}};
  std::array<double, 4> q = rows[std::ranges::max_element(squares) - squares.begin()];
  double sum = 0;
  for (const double v : q) sum += v * v;
  for (double& v : q) v /= std::sqrt(sum);
  return q;
}

}  // namespace

bool is_trs(const Mat4f& m) {
  // Composed anew from its parts, a matrix may differ by 5e-5 before gltf-validator calls it no TRS. By how much it
  // does: an angle between two axes that is off by d · |a| |b| = a · b moves a by |a| d.
  constexpr double kTolerance = 2e-5;
  const Columns c = columns_of(m);
  for (int i = 0; i < 3; ++i) {
    const Vec3d a = c[i], b = c[(i + 1) % 3];
    if (std::abs(dot(a, b)) > kTolerance * std::min(length(a), length(b))) return false;
  }
  return true;
}

// Singular values by one-sided Jacobi rotations (Hestenes 1958): columns of W = A V are turned in pairs, and V with
// them, until they are perpendicular. Then A = W Vᵀ = U Σ Vᵀ. V is a rotation since it is made of rotations, and U is
// one where A does not mirror.
TrsPair split_into_trs(const Mat4f& m) {
  Columns w = columns_of(m), v = {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}};
  constexpr int kMaxSweeps = 30;  // convergence is quadratic: five or so
  constexpr double kPerpendicular = 1e-15;
  for (int sweep = 0, turned = 1; turned > 0 && sweep < kMaxSweeps; ++sweep) {
    turned = 0;
    for (int pair = 0; pair < 3; ++pair) {
      const int p = pair, q = (pair + 1) % 3;
      const double gamma = dot(w[p], w[q]);
      if (std::abs(gamma) <= kPerpendicular * length(w[p]) * length(w[q])) continue;
      ++turned;
      const double zeta = (dot(w[q], w[q]) - dot(w[p], w[p])) / (2 * gamma);
      const double t = std::copysign(1 / (std::abs(zeta) + std::sqrt(1 + zeta * zeta)), zeta);
      const double cosine = 1 / std::sqrt(1 + t * t), sine = t * cosine;
      for (Columns* c : {&w, &v}) {
        const Vec3d old = (*c)[p];
        (*c)[p] = cosine * old - sine * (*c)[q];
        (*c)[q] = sine * old + cosine * (*c)[q];
      }
    }
  }
  TrsPair pair;
  pair.outer.translation = {m[12], m[13], m[14]};
  pair.outer.scale = {length(w[0]), length(w[1]), length(w[2])};
  pair.outer.rotation =
      quaternion_of({1 / pair.outer.scale.x * w[0], 1 / pair.outer.scale.y * w[1], 1 / pair.outer.scale.z * w[2]});
  pair.inner.rotation = quaternion_of(transpose(v));
  return pair;
}

}  // namespace shlight
