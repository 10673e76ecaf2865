#include "shlight/sh/area_light.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <optional>

#include "shlight/sh/basis.h"
#include "shlight/sh/rotation.h"
#include "shlight/sh/zonal.h"

namespace shlight {
namespace {

using std::numbers::pi;

double length(Vec3d v) {
  return std::sqrt(dot(v, v));
}

Vec3d normalized(Vec3d v) {
  return 1 / length(v) * v;
}

// Any unit vector at right angles to a unit vector.
Vec3d any_normal_to(Vec3d v) {
  return normalized(cross(v, std::abs(v.x) < 0.6 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0}));
}

// The rotation that takes the axes x, y, z to three orthonormal vectors.
Rotation rotation_to(Vec3d x, Vec3d y, Vec3d z) {
  return inverse(Rotation{{x, y, z}});
}

// The cosine coefficients of a function that is even in its frame's y, in the sequence of NormalizedLegendre, turned
// into the world and added.
void add_turned(const Rotation& rotation, std::span<const double> even, Rgb radiance, RgbCoefficients& coefficients) {
  const int bands = coefficients.bands();
  const RotationMatrix matrix(bands, rotation);
  for (int l = 0; l < bands; ++l)
    for (int m = -l; m <= l; ++m) {
      double sum = 0;
      for (int m2 = 0; m2 <= l; ++m2) sum += matrix.at(l, m, m2) * even[static_cast<std::size_t>(l * (l + 1) / 2 + m2)];
      coefficients.at(l, m) += sum * radiance;
    }
}

// A polygon as directions, the area to the left of its edges as one looks at the sphere from outside.
struct SphericalPolygon {
  std::vector<Vec3d> directions;
  Vec3d axis;  // of the hemisphere that it lies in
};

// Nothing where the polygon shows its back, or has no area.
std::optional<SphericalPolygon> to_sphere(std::span<const Vec3d> vertices, Sides sides) {
  // Newell's normal: of a planar polygon twice its area, toward its back. It points into the hemisphere behind the
  // front.
  Vec3d axis;
  for (std::size_t i = 0; i < vertices.size(); ++i)
    axis = axis + cross(vertices[(i + 1) % vertices.size()], vertices[i]);
  if (vertices.size() < 3 || axis == Vec3d{}) return {};
  SphericalPolygon polygon{{}, normalized(axis)};
  double side = 0;
  for (std::size_t i = vertices.size(); i-- > 0;) {
    // A vertex at the origin has no direction; the edges beside it are then seen edge-on.
    if (vertices[i] == Vec3d{}) continue;
    polygon.directions.push_back(normalized(vertices[i]));
    side += dot(polygon.axis, polygon.directions.back());
  }
  if (side >= 0) return polygon;
  if (sides == Sides::kFront) return {};
  std::reverse(polygon.directions.begin(), polygon.directions.end());
  polygon.axis = -polygon.axis;
  return polygon;
}

// The spherical ellipse of the directions (a cos t, b sin t, c), and what is inside of it: its coefficients in that
// frame, of cosines alone, in the sequence of NormalizedLegendre.
//
// With R = (a cos t, b sin t, c) the boundary integral is ∮ ∇Y(R/|R|) · (R' × R)/|R|² dt, and the solid angle, of
// which 1 − cos θ is the antiderivative, ∮ ab / (|R| (|R| + c)) dt. Both are analytic and periodic, so that the
// trapezoid rule leaves e^{−Nη} with N nodes, where η is the distance of the nearest singularity, |R|² = 0, from the
// real line. Long ellipses have it near: tan²t = −ρ², ρ² = (c² + a²)/(c² + b²). The substitution tan t = √ρ tan s moves
// it to tan s = i√ρ and brings in one at tan s = i/√ρ: η = atanh of the smaller of the two, about the square root of
// what it was.
std::vector<double> project_ellipse(int bands, double a, double b, double c) {
  const NormalizedLegendre legendre(bands);
  std::vector<double> sums(legendre.size()), polynomials(sums.size()), derivatives(sums.size());
  const double kappa = std::pow((c * c + a * a) / (c * c + b * b), 0.25);
  const double eta = std::atanh(std::min({kappa, 1 / kappa, 0.999}));
  constexpr double kDigits = 40;  // e^−40 = 4e-18
  constexpr double kMaxNodes = 1 << 17;
  const int nodes = static_cast<int>(std::min(kMaxNodes, 2 * bands + 8 + (kDigits + bands) / eta));
  for (int k = 0; k < nodes; ++k) {
    const double s = 2 * pi * (k + 0.5) / nodes;
    // cos t and sin t to a common factor, which dt/ds = κ / (cos²s + κ² sin²s) shares.
    const double stretched = std::hypot(std::cos(s), kappa * std::sin(s));
    const double cos_t = std::cos(s) / stretched, sin_t = kappa * std::sin(s) / stretched;
    const double dt = 2 * pi / nodes * kappa / (stretched * stretched);
    const Vec3d r = {a * cos_t, b * sin_t, c};
    const double distance = length(r);
    const Vec3d d = 1 / distance * r;
    const Vec3d outward = dt / (distance * distance) * Vec3d{b * c * cos_t, a * c * sin_t, -a * b};
    sums[0] += dt * a * b / (distance * (distance + c));
    // The gradient of Y_lm = q_lm(z) Re (x + iy)^m, dotted with `outward`.
    legendre.eval_with_derivative(d.z, polynomials, derivatives);
    double re = 1, im = 0, re_before = 0, im_before = 0;  // (x + iy)^m and ^(m−1)
    for (int m = 0; m < bands; ++m) {
      const double along = m * (re_before * outward.x - im_before * outward.y), up = re * outward.z;
      for (int l = std::max(1, m); l < bands; ++l) {
        const std::size_t at = static_cast<std::size_t>(l * (l + 1) / 2 + m);
        sums[at] += polynomials[at] * along + derivatives[at] * up;
      }
      re_before = re, im_before = im;
      re = d.x * re_before - d.y * im_before;
      im = d.x * im_before + d.y * re_before;
    }
  }
  sums[0] *= std::sqrt(1 / (4 * pi));
  for (int l = 1; l < bands; ++l)
    for (int m = 0; m <= l; ++m) sums[static_cast<std::size_t>(l * (l + 1) / 2 + m)] /= -l * (l + 1.0);
  return sums;
}

}  // namespace

// Along an edge of angle γ the outward normal is −Z of the frame whose equator the edge is, X in its middle, and
// ∂Y_lm/∂n = −q'_lm(0) cos(mφ) of Y_lm = q_lm(z) sin^m θ cos(mφ). Its integral is −q'_lm(0) 2 sin(mγ/2)/m; the sines
// have none.
void add_polygon(std::span<const Vec3d> vertices, Sides sides, Rgb radiance, RgbCoefficients& coefficients) {
  const int bands = coefficients.bands();
  const auto polygon = to_sphere(vertices, sides);
  if (!polygon || bands == 0) return;

  const NormalizedLegendre legendre(bands);
  std::vector<double> polynomials(legendre.size()), slopes(legendre.size()), edge(legendre.size());
  legendre.eval_with_derivative(0, polynomials, slopes);

  const Vec3d axis = polygon->axis;
  double solid_angle = 0;
  for (std::size_t i = 0; i < polygon->directions.size(); ++i) {
    const Vec3d a = polygon->directions[i], b = polygon->directions[(i + 1) % polygon->directions.size()];
    const Vec3d normal = cross(a, b);
    // The triangle of axis, a and b, with its sign [4].
    solid_angle += 2 * std::atan2(dot(axis, normal), 1 + dot(a, b) + dot(axis, a) + dot(axis, b));

    const double sine = length(normal), gamma = std::atan2(sine, dot(a, b));
    if (gamma == 0) continue;
    // Half a turn: the origin is on the edge, which is then seen through the axis.
    const Vec3d middle = length(a + b) > 1e-12 ? normalized(a + b) : axis;
    const Vec3d pole = normalized(sine > 1e-12 ? normal : cross(a, middle));
    for (int m = 0; m < bands; ++m) {
      const double integral = m == 0 ? gamma : 2 * std::sin(0.5 * m * gamma) / m;
      for (int l = std::max(1, m); l < bands; ++l) {
        const std::size_t at = static_cast<std::size_t>(l * (l + 1) / 2 + m);
        edge[at] = slopes[at] * integral / (l * (l + 1.0));
      }
    }
    // Right-handed to rounding, whatever became of `pole` on a short edge.
    const Vec3d y = normalized(cross(pole, middle));
    add_turned(rotation_to(middle, y, cross(middle, y)), edge, radiance, coefficients);
  }
  coefficients[0] += std::sqrt(1 / (4 * pi)) * solid_angle * radiance;
}

bool polygon_covers(std::span<const Vec3d> vertices, Sides sides, Vec3d direction) {
  const auto polygon = to_sphere(vertices, sides);
  if (!polygon) return false;
  // How often the boundary crosses the half of a great circle from the direction to its opposite, from right to left:
  // winding number here less that at the opposite, where it is 0 if it is not here.
  const Vec3d across = any_normal_to(direction), up = cross(direction, across);
  int winding = 0;
  for (std::size_t i = 0; i < polygon->directions.size(); ++i) {
    const Vec3d a = polygon->directions[i], b = polygon->directions[(i + 1) % polygon->directions.size()];
    const double ua = dot(up, a), ub = dot(up, b);
    if ((ua > 0) == (ub > 0)) continue;
    const Vec3d crossing = std::abs(ub) * a + std::abs(ua) * b;
    if (dot(across, crossing) > 0) winding += ub > 0 ? 1 : -1;
  }
  return winding > 0;
}

// Sutherland and Hodgman's algorithm for one plane.
std::vector<Vec3d> clip_polygon(std::span<const Vec3d> vertices, Vec3d normal) {
  std::vector<Vec3d> clipped;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Vec3d a = vertices[i], b = vertices[(i + 1) % vertices.size()];
    const double height_a = dot(normal, a), height_b = dot(normal, b);
    if (height_a >= 0) clipped.push_back(a);
    if ((height_a > 0 && height_b < 0) || (height_a < 0 && height_b > 0))
      clipped.push_back(1 / (height_b - height_a) * (height_b * a - height_a * b));
  }
  return clipped;
}

void add_flat_disc(Vec3d centre, Vec3d normal, double radius, Sides sides, Rgb radiance,
                   RgbCoefficients& coefficients) {
  assert(radius >= 0 && dot(normal, normal) > 0);
  // From the origin to the disc's plane, and from there to the centre: height · foot + offset · e.
  const Vec3d n = normalized(normal);
  const double behind = -dot(n, centre);  // > 0 where the origin sees the front
  if (behind < 0 && sides == Sides::kFront) return;
  const double height = std::abs(behind);
  const Vec3d foot = behind >= 0 ? -n : n;
  const Vec3d in_plane = centre + behind * n;
  const double offset = length(in_plane);
  if (height == 0) {
    if (offset < radius) add_disc(foot, pi / 2, radiance, coefficients);
    return;
  }
  const Vec3d e = offset > 0 ? normalized(in_plane - dot(in_plane, foot) * foot) : any_normal_to(foot);

  // Both ends of the diameter along e, as angles from the foot, and the direction z half-way between them.
  const double low = std::atan2(offset - radius, height), high = std::atan2(offset + radius, height);
  const double half = 0.5 * (high - low), middle = 0.5 * (high + low);
  const Vec3d z = std::cos(middle) * foot + std::sin(middle) * e;
  const Vec3d x = std::cos(middle) * e - std::sin(middle) * foot;
  // Across, the tangent of the ellipse's half angle is that of the chord through z, √((r − s)(r + s)) at the distance
  // height/cos ψ, s being where z meets the plane: r ∓ s = height sin α / (cos ψ± cos ψ). Both tangents, times cos α
  // √(cos ψ₋ cos ψ₊):
  const double q =
      std::sqrt(height / std::hypot(height, offset - radius) * height / std::hypot(height, offset + radius));
  const std::vector<double> even =
      project_ellipse(coefficients.bands(), std::sin(half) * q, std::cos(half) * std::sin(half), std::cos(half) * q);
  add_turned(rotation_to(x, cross(z, x), z), even, radiance, coefficients);
}

void add_sphere(Vec3d centre, double radius, Rgb radiance, RgbCoefficients& coefficients) {
  assert(radius >= 0);
  const double distance = length(centre);
  if (distance > radius)
    add_disc(1 / distance * centre, std::asin(radius / distance), radiance, coefficients);
  else if (coefficients.bands() > 0)
    coefficients[0] += std::sqrt(4 * pi) * radiance;
}

}  // namespace shlight
