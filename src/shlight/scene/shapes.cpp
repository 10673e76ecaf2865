#include "shlight/scene/shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "shlight/core/assert.h"
#include "shlight/scene/weld.h"

namespace shlight {
namespace {

constexpr double kPi = std::numbers::pi;

// A vertex of a lathe's outline: distance from the axis, height, and its normal in that plane.
struct OutlineVertex {
  double radius, height;
  double normal_radius, normal_height;
};

// Quad of vertices, counter-clockwise from the lower left.
void add_quad(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  mesh.indices.insert(mesh.indices.end(), {a, b, c, a, c, d});
}

int num_steps(double length, double max_step) {
  return std::max(1, static_cast<int>(std::ceil(length / max_step - 1e-6)));
}

// Turns an outline from pole to pole around the Y axis, counter-clockwise seen from above, starting at +Z.
Mesh turn(std::span<const OutlineVertex> outline, int segments) {
  Mesh mesh;
  const auto add_vertex = [&](const OutlineVertex& v, double angle) {
    const double x = std::sin(angle), z = std::cos(angle);
    mesh.positions.push_back(vec_cast<float>(Vec3d{v.radius * x, v.height, v.radius * z}));
    mesh.normals.push_back(vec_cast<float>(Vec3d{v.normal_radius * x, v.normal_height, v.normal_radius * z}));
  };
  // Vertex 0 is the lower pole, then come the rings, then the upper pole.
  const auto n = static_cast<std::uint32_t>(segments);
  const auto rings = static_cast<std::uint32_t>(outline.size() - 2);
  add_vertex(outline.front(), 0);
  for (const OutlineVertex& v : outline.subspan(1, rings))
    for (int j = 0; j < segments; ++j) add_vertex(v, 2 * kPi * j / segments);
  add_vertex(outline.back(), 0);

  const std::uint32_t top = 1 + rings * n;
  for (std::uint32_t j = 0; j < n; ++j) {
    const std::uint32_t left = 1 + j, right = 1 + (j + 1) % n;
    mesh.indices.insert(mesh.indices.end(), {0, right, left});
    for (std::uint32_t ring = 0; ring + 1 < rings; ++ring)
      add_quad(mesh, left + ring * n, right + ring * n, right + (ring + 1) * n, left + (ring + 1) * n);
    mesh.indices.insert(mesh.indices.end(), {left + (rings - 1) * n, right + (rings - 1) * n, top});
  }
  return mesh;
}

struct Vec2d {
  double r = 0, h = 0;
};
Vec2d operator+(Vec2d a, Vec2d b) {
  return {a.r + b.r, a.h + b.h};
}
Vec2d operator-(Vec2d a, Vec2d b) {
  return {a.r - b.r, a.h - b.h};
}
Vec2d operator*(double s, Vec2d a) {
  return {s * a.r, s * a.h};
}
double length(Vec2d a) {
  return std::hypot(a.r, a.h);
}

// Where on one axis a rounded box's vertices lie before they are rounded: from -half to half, such that the rounded
// part is cut at equal angles. A vertex d beyond the flat part goes to the angle atan(d / rounding), so d is a tangent.
std::vector<double> box_cuts(double half, double rounding, int steps, double max_step) {
  const double flat = half - rounding;
  const int flat_steps = num_steps(2 * flat, max_step);
  std::vector<double> cuts;
  for (int i = 0; i < steps; ++i) cuts.push_back(-flat - rounding * std::tan(kPi / 4 * (steps - i) / steps));
  for (int i = 0; i <= flat_steps; ++i) cuts.push_back(flat * (2.0 * i / flat_steps - 1));
  for (int i = 1; i <= steps; ++i) cuts.push_back(flat + rounding * std::tan(kPi / 4 * i / steps));
  // Neighbouring sides must agree to the last bit about the edge they share.
  cuts.front() = -half, cuts.back() = half;
  return cuts;
}

}  // namespace

Mesh make_sphere(float radius, int rings) {
  SHLIGHT_ASSERT_GE(rings, 2);
  std::vector<OutlineVertex> outline;
  for (int i = 0; i <= rings; ++i) {
    const double angle = kPi * i / rings;  // from the lower pole
    const double s = i == rings ? 0 : std::sin(angle), c = -std::cos(angle);
    outline.push_back({radius * s, radius * c, s, c});
  }
  Mesh mesh = turn(outline, 2 * rings);
  mesh.name = "sphere";
  return mesh;
}

Mesh make_rounded_box(Vec3f size, float rounding, int steps, float max_step) {
  const std::array<double, 3> half = {size.x / 2, size.y / 2, size.z / 2};
  std::array<std::vector<double>, 3> cuts;
  for (int axis = 0; axis < 3; ++axis) {
    SHLIGHT_ASSERT_LE(double{rounding}, half[axis]);
    cuts[axis] = box_cuts(half[axis], rounding, steps, max_step);
  }

  // Each of six sides is a grid; each of its points p goes to where the sphere around the nearest point of the inner
  // box lies in p's direction.
  std::vector<Vec3f> positions, normals;
  std::vector<std::uint32_t> indices;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      const int right = (axis + (side > 0 ? 1 : 2)) % 3, up = (axis + (side > 0 ? 2 : 1)) % 3;
      const auto first = static_cast<std::uint32_t>(positions.size());
      const auto columns = static_cast<std::uint32_t>(cuts[right].size());
      for (std::size_t row = 0; row < cuts[up].size(); ++row)
        for (std::uint32_t column = 0; column < columns; ++column) {
          std::array<double, 3> p, inner;
          p[axis] = side * half[axis], p[right] = cuts[right][column], p[up] = cuts[up][row];
          for (int k = 0; k < 3; ++k) inner[k] = std::clamp(p[k], rounding - half[k], half[k] - rounding);
          const Vec3d center = {inner[0], inner[1], inner[2]};
          const Vec3d away = Vec3d{p[0], p[1], p[2]} - center;
          const Vec3d normal = (1 / std::sqrt(dot(away, away))) * away;
          positions.push_back(vec_cast<float>(center + double{rounding} * normal));
          normals.push_back(vec_cast<float>(normal));
          if (row == 0 || column == 0) continue;
          const std::uint32_t here = first + static_cast<std::uint32_t>(row) * columns + column;
          indices.insert(indices.end(), {here - columns - 1, here - columns, here, here - columns - 1, here, here - 1});
        }
    }

  // The sides' borders coincide.
  const Weld weld = weld_positions(positions);
  Mesh mesh;
  mesh.name = "rounded box";
  for (const std::uint32_t i : weld.first) {
    mesh.positions.push_back(positions[i]);
    mesh.normals.push_back(normals[i]);
  }
  for (const std::uint32_t i : indices) mesh.indices.push_back(weld.group[i]);
  return mesh;
}

Mesh make_torus_knot(const TorusKnotParams& params) {
  // The curve c(t) = ((R + r cos 3t) cos 2t, (R + r cos 3t) sin 2t, r sin 3t) lies on the torus, whose normal
  // n(t) = (cos 3t cos 2t, cos 3t sin 2t, sin 3t) is therefore perpendicular to the curve's tangent c'(t): n and c' x n
  // span the plane of the tube's circle there, and come back to themselves after a whole turn of t.
  Mesh mesh;
  mesh.name = "torus knot";
  const double major = params.major, minor = params.minor;
  for (int i = 0; i < params.along; ++i) {
    const double t = 2 * kPi * i / params.along;
    const double c2 = std::cos(2 * t), s2 = std::sin(2 * t), c3 = std::cos(3 * t), s3 = std::sin(3 * t);
    const double distance = major + minor * c3;
    const Vec3d center = {distance * c2, distance * s2, minor * s3};
    const Vec3d tangent = {-3 * minor * s3 * c2 - 2 * distance * s2, -3 * minor * s3 * s2 + 2 * distance * c2,
                           3 * minor * c3};
    const Vec3d n = {c3 * c2, c3 * s2, s3};
    const Vec3d b = (1 / std::sqrt(dot(tangent, tangent))) * cross(tangent, n);
    for (int j = 0; j < params.around; ++j) {
      const double angle = 2 * kPi * j / params.around;
      const Vec3d normal = std::cos(angle) * n + std::sin(angle) * b;
      mesh.positions.push_back(vec_cast<float>(center + double{params.tube} * normal));
      mesh.normals.push_back(vec_cast<float>(normal));
    }
  }
  const auto along = static_cast<std::uint32_t>(params.along), around = static_cast<std::uint32_t>(params.around);
  for (std::uint32_t i = 0; i < along; ++i)
    for (std::uint32_t j = 0; j < around; ++j) {
      const std::uint32_t ring = i * around, next_ring = (i + 1) % along * around, next = (j + 1) % around;
      add_quad(mesh, ring + j, ring + next, next_ring + next, next_ring + j);
    }
  return mesh;
}

Mesh make_turned(std::span<const OutlineCorner> outline, int segments, float max_step) {
  SHLIGHT_ASSERT_GE(outline.size(), 3u);
  SHLIGHT_ASSERT_EQ(outline.front().radius, 0.0f);
  SHLIGHT_ASSERT_EQ(outline.back().radius, 0.0f);
  SHLIGHT_ASSERT_EQ(outline[0].height, outline[1].height);
  SHLIGHT_ASSERT_EQ(outline[outline.size() - 2].height, outline.back().height);
  // The outside is on the right hand of the outline's direction d, so the normal is (d.h, -d.r).
  const auto corner = [&](std::size_t i) { return Vec2d{outline[i].radius, outline[i].height}; };
  const auto direction = [&](std::size_t i) {
    const Vec2d d = corner(i + 1) - corner(i);
    return (1 / length(d)) * d;
  };

  std::vector<OutlineVertex> vertices;
  Vec2d start = corner(0);  // of the straight piece that comes next
  for (std::size_t i = 1; i < outline.size(); ++i) {
    const Vec2d d = direction(i - 1);
    const Vec2d normal = {d.h, -d.r};
    const bool is_last = i + 1 == outline.size();
    const Vec2d e = is_last ? d : direction(i);
    // A circle that touches both pieces touches them at rounding · tan(turn / 2) from the corner.
    const double turn_angle = std::atan2(d.r * e.h - d.h * e.r, d.r * e.r + d.h * e.h);
    const double rounding = outline[i].rounding;
    const Vec2d end = corner(i) - rounding * std::tan(std::abs(turn_angle) / 2) * d;

    // The straight piece, with its end only where no arc begins there.
    const int steps = num_steps(length(end - start), max_step);
    for (int k = 0; k < steps + (is_last ? 1 : 0); ++k) {
      const Vec2d p = start + (1.0 * k / steps) * (end - start);
      vertices.push_back({p.r, p.h, normal.r, normal.h});
    }
    if (is_last) break;

    // The arc, with its beginning and without its end, which begins the next piece. Turning right, the circle's centre
    // is outside.
    const double side = turn_angle > 0 ? 1 : -1;
    const Vec2d center = end - side * rounding * normal;
    constexpr double kMaxTurn = kPi / 12;
    const int arc_steps =
        std::max(num_steps(rounding * std::abs(turn_angle), max_step), num_steps(std::abs(turn_angle), kMaxTurn));
    const auto on_arc = [&](int k) {
      const double a = turn_angle * k / arc_steps, c = std::cos(a), s = std::sin(a);
      const Vec2d n = {c * normal.r - s * normal.h, s * normal.r + c * normal.h};
      const Vec2d p = center + side * rounding * n;
      return OutlineVertex{p.r, p.h, n.r, n.h};
    };
    for (int k = 0; k < arc_steps; ++k) vertices.push_back(on_arc(k));
    const OutlineVertex last = on_arc(arc_steps);
    start = {last.radius, last.height};
  }
  return turn(vertices, segments);
}

}  // namespace shlight
