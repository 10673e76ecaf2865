#include "shlight/scene/normals.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>

#include "shlight/core/assert.h"
#include "shlight/scene/weld.h"

namespace shlight {
namespace {

// Where more than two triangles share an edge, each is held against this many others. Two would do for every sound
// mesh; the bound keeps the time linear where a file has a million triangles on one edge.
constexpr std::size_t kMaxMates = 8;

double length(Vec3d v) {
  return std::sqrt(dot(v, v));
}

Vec3d normalized_or_zero(Vec3d v) {
  const double l = length(v);
  return l > 0 ? (1 / l) * v : Vec3d{};
}

// One side of a triangle: from corner `from` to corner `to`, between the positions of `key`.
struct HalfEdge {
  std::uint64_t key;
  std::uint32_t from, to;
};

constexpr std::size_t next_corner(std::size_t corner) {
  return corner % 3 == 2 ? corner - 2 : corner + 1;
}

// Sets of corners that share a normal: union-find with path halving.
class CornerSets {
 public:
  explicit CornerSets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }
  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  // The smaller root stays one, so that the outcome does not depend on the order of joins.
  void join(std::uint32_t a, std::uint32_t b) {
    a = find(a), b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

// All sides of all triangles, those between the same two positions next to each other.
std::vector<HalfEdge> sorted_half_edges(std::span<const std::uint32_t> position_of_corner) {
  std::vector<HalfEdge> edges(position_of_corner.size());
  for (std::size_t corner = 0; corner < edges.size(); ++corner) {
    const std::size_t next = next_corner(corner);
    const std::uint64_t a = position_of_corner[corner], b = position_of_corner[next];
    edges[corner] = {std::min(a, b) << 32 | std::max(a, b), static_cast<std::uint32_t>(corner),
                     static_cast<std::uint32_t>(next)};
  }
  std::ranges::sort(
      edges, [](const HalfEdge& x, const HalfEdge& y) { return x.key != y.key ? x.key < y.key : x.from < y.from; });
  return edges;
}

// Joins the corners on both sides of every edge that is no crease.
CornerSets join_across_edges(std::span<const std::uint32_t> position_of_corner, std::span<const Vec3d> face_normals,
                             float crease_degrees) {
  // The slack takes rounding: flat stays flat at 0 degrees, opposite normals are joined at 180.
  const double min_cosine = std::cos(crease_degrees * std::numbers::pi / 180) - 1e-9;
  const std::vector<HalfEdge> edges = sorted_half_edges(position_of_corner);
  CornerSets sets(position_of_corner.size());
  for (std::size_t i = 0; i < edges.size(); ++i)
    for (std::size_t j = i + 1; j < edges.size() && j <= i + kMaxMates && edges[j].key == edges[i].key; ++j) {
      const HalfEdge &a = edges[i], &b = edges[j];
      if (dot(face_normals[a.from / 3], face_normals[b.from / 3]) < min_cosine) continue;
      const bool opposite = position_of_corner[a.from] == position_of_corner[b.to];
      sets.join(a.from, opposite ? b.to : b.from);
      sets.join(a.to, opposite ? b.from : b.to);
    }
  return sets;
}

}  // namespace

std::vector<Vec3f> make_corner_normals(std::span<const Vec3f> positions, std::span<const std::uint32_t> indices,
                                       float crease_degrees) {
  SHLIGHT_ASSERT_EQ(indices.size() % 3, 0u);
  const Weld weld = weld_positions(positions);
  std::vector<std::uint32_t> position_of_corner(indices.size());
  std::ranges::transform(indices, position_of_corner.begin(), [&](std::uint32_t i) { return weld.group[i]; });

  const auto point = [&](std::size_t corner) { return vec_cast<double>(positions[indices[corner]]); };
  std::vector<Vec3d> face_normals(indices.size() / 3);
  for (std::size_t face = 0; face < face_normals.size(); ++face) {
    const Vec3d a = point(3 * face), b = point(3 * face + 1), c = point(3 * face + 2);
    face_normals[face] = normalized_or_zero(cross(b - a, c - a));
  }

  // Each set of corners gets its sum at its root. atan2 is exact for the thinnest of angles.
  CornerSets sets = join_across_edges(position_of_corner, face_normals, crease_degrees);
  std::vector<Vec3d> sums(indices.size());
  for (std::size_t corner = 0; corner < indices.size(); ++corner) {
    const std::size_t next = next_corner(corner), last = next_corner(next);
    const Vec3d to_next = point(next) - point(corner), to_last = point(last) - point(corner);
    const double angle = std::atan2(length(cross(to_next, to_last)), dot(to_next, to_last));
    Vec3d& sum = sums[sets.find(static_cast<std::uint32_t>(corner))];
    sum = sum + angle * face_normals[corner / 3];
  }

  // Normals that cancel each other, as those of a sheet's two sides do at 180 degrees, leave the triangle its own.
  constexpr double kCancelled = 1e-9;
  std::vector<Vec3f> normals(indices.size());
  for (std::size_t corner = 0; corner < indices.size(); ++corner) {
    const Vec3d sum = sums[sets.find(static_cast<std::uint32_t>(corner))];
    Vec3d normal = length(sum) > kCancelled ? normalized_or_zero(sum) : face_normals[corner / 3];
    if (normal == Vec3d{}) normal = {0, 1, 0};
    normals[corner] = vec_cast<float>(normal);
  }
  return normals;
}

}  // namespace shlight
