#include "shlight/sh/minimum.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>
#include <vector>

#include "shlight/sh/basis.h"

// The bound M on second derivatives. Along a great circle, with s and t two points on it, Σ_m Y_lm(s) Y_lm(t) =
// (2l+1)/4π P_l(cos(s − t)) (the addition theorem). Differentiating twice in s and twice in t and setting s = t gives
// Σ_m (Y_lm'')² = (2l+1)/4π · d⁴/du⁴ P_l(cos u) at u = 0. Legendre's equation yields P_l(cos u) = 1 − λu²/4 +
// λ(3λ − 2)u⁴/192 − …, λ = l(l+1), and so that derivative is λ(3λ − 2)/8. By Cauchy and Schwarz
//
//     |f''| <= M = Σ_l √(Σ_m c_lm²) √((2l+1)/4π · λ(3λ − 2)/8).

namespace shlight {
namespace {

using std::numbers::pi;

double second_derivative_bound(std::span<const double> coefficients, int bands) {
  double bound = 0;
  for (int l = 1; l < bands; ++l) {
    double power = 0;
    for (int m = -l; m <= l; ++m) {
      const double c = coefficients[static_cast<std::size_t>(coefficient_index(l, m))];
      power += c * c;
    }
    const double lambda = l * (l + 1.0);
    bound += std::sqrt(power * (2 * l + 1) / (4 * pi) * lambda * (3 * lambda - 2) / 8);
  }
  return bound;
}

Vec3d normalized(Vec3d v) {
  return 1 / std::sqrt(dot(v, v)) * v;
}

double angle_between(Vec3d a, Vec3d b) {
  const Vec3d c = cross(a, b);
  return std::atan2(std::sqrt(dot(c, c)), dot(a, b));
}

// A square of a cube's face, seen from the cube's centre.
struct Patch {
  int face;
  double u, v, half;  // the square [u − half, u + half] x [v − half, v + half] in [−1, 1]²
  double bound;       // of f on it, from below
  bool operator<(const Patch& other) const { return bound > other.bound; }  // the queue's top has the least bound
};

Vec3d on_face(int face, double u, double v) {
  const double w = face % 2 == 0 ? 1 : -1;
  switch (face / 2) {
    case 0:
      return normalized({w, u, v});
    case 1:
      return normalized({v, w, u});
    default:
      return normalized({u, v, w});
  }
}

// The angle from the centre to the farthest corner; the square lies inside the cap of that radius, because great
// circles are straight on the face and a cap is convex.
double patch_radius(const Patch& patch, Vec3d centre) {
  double radius = 0;
  for (const double du : {-patch.half, patch.half})
    for (const double dv : {-patch.half, patch.half})
      radius = std::max(radius, angle_between(centre, on_face(patch.face, patch.u + du, patch.v + dv)));
  return radius;
}

}  // namespace

GradientEvaluator::GradientEvaluator(std::span<const double> coefficients, int bands)
    : coefficients_(coefficients), legendre_(bands), polynomials_(legendre_.size()), derivatives_(legendre_.size()) {
  assert(static_cast<int>(coefficients.size()) == num_coefficients(bands));
}

ValueAndGradient GradientEvaluator::operator()(Vec3d d) {
  // Y_lm = q_lm(z) Re or Im (x + iy)^m with polynomials q: the normalised Legendre functions over s^m.
  legendre_.eval_with_derivative(d.z, polynomials_, derivatives_);
  const int bands = legendre_.bands();
  double value = 0;
  Vec3d gradient;
  double c = 1, s = 0, c_before = 0, s_before = 0;  // (x + iy)^m and ^(m−1)
  for (int m = 0; m < bands; ++m) {
    for (int l = m; l < bands; ++l) {
      const std::size_t at = static_cast<std::size_t>(l * (l + 1) / 2 + m);
      const double cosine = coefficients_[static_cast<std::size_t>(coefficient_index(l, m))];
      const double sine = m > 0 ? coefficients_[static_cast<std::size_t>(coefficient_index(l, -m))] : 0;
      value += polynomials_[at] * (cosine * c + sine * s);
      gradient.x += polynomials_[at] * m * (cosine * c_before + sine * s_before);
      gradient.y += polynomials_[at] * m * (sine * c_before - cosine * s_before);
      gradient.z += derivatives_[at] * (cosine * c + sine * s);
    }
    c_before = c, s_before = s;
    c = d.x * c_before - d.y * s_before;
    s = d.x * s_before + d.y * c_before;
  }
  // The polynomial changes off the sphere as well; only what is tangent counts.
  return {value, gradient - dot(gradient, d) * d};
}

namespace {

// Branch and bound until done(best, lower bound of the whole sphere).
template <class Done>
CertifiedMinimum search_minimum(std::span<const double> coefficients, int bands, Done&& done) {
  assert(bands >= 1);
  GradientEvaluator evaluate(coefficients, bands);
  const double second = second_derivative_bound(coefficients, bands);
  CertifiedMinimum best{0, std::numeric_limits<double>::infinity(), {0, 1, 0}};
  std::priority_queue<Patch> queue;
  const auto add = [&](Patch patch) {
    const Vec3d centre = on_face(patch.face, patch.u, patch.v);
    const auto [value, gradient] = evaluate(centre);
    if (value < best.value) best.value = value, best.direction = centre;
    const double r = patch_radius(patch, centre);
    patch.bound = value - std::sqrt(dot(gradient, gradient)) * r - 0.5 * second * r * r;
    queue.push(patch);
  };
  for (int face = 0; face < 6; ++face) add({face, 0, 0, 1, 0});
  // Best first: the top of the queue bounds the whole sphere.
  while (!done(best.value, queue.top().bound)) {
    const Patch patch = queue.top();
    queue.pop();
    const double half = patch.half / 2;
    for (const double du : {-half, half})
      for (const double dv : {-half, half}) add({patch.face, patch.u + du, patch.v + dv, half, 0});
  }
  best.lower_bound = std::min(queue.top().bound, best.value);
  return best;
}

double norm_of(std::span<const double> coefficients) {
  double sum = 0;
  for (const double c : coefficients) sum += c * c;
  return std::sqrt(sum);
}

}  // namespace

CertifiedMinimum find_minimum(std::span<const double> coefficients, int bands, double tolerance) {
  const double gap = tolerance * norm_of(coefficients);
  return search_minimum(coefficients, bands, [&](double value, double bound) { return bound >= value - gap; });
}

CertifiedMinimum find_sign_of_minimum(std::span<const double> coefficients, int bands, double tolerance) {
  const double gap = tolerance * norm_of(coefficients);
  return search_minimum(coefficients, bands,
                        [&](double value, double bound) { return value < 0 || bound >= 0 || bound >= value - gap; });
}

}  // namespace shlight
