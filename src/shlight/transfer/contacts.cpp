#include "shlight/transfer/contacts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include "shlight/core/parallel.h"

namespace shlight {
namespace {

// The distance of origins from the surface, in units of the largest coordinate: sixteen times what rounding a float can
// move a vertex.
constexpr float kOffset = 0x1p-20f;

// Sites in a balanced tree: the middle one of a range parts it along one axis. Finds those in a box.
class PointTree {
 public:
  explicit PointTree(std::span<const Vec3f> points) : points_(points), sequence_(points.size()) {
    std::iota(sequence_.begin(), sequence_.end(), 0u);
    split(0, sequence_.size(), 0);
  }
  // Calls f(point) for each point in the box.
  template <class F>
  void find(const Bounds& box, const F& f) const {
    find(0, sequence_.size(), 0, box, f);
  }

 private:
  static float component(Vec3f v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

  void split(std::size_t begin, std::size_t end, int axis) {
    if (end - begin < 2) return;
    const std::size_t middle = begin + (end - begin) / 2;
    const auto at = [&](std::size_t i) { return sequence_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(begin), at(middle), at(end), [&](std::uint32_t a, std::uint32_t b) {
      return std::pair(component(points_[a], axis), a) < std::pair(component(points_[b], axis), b);
    });
    split(begin, middle, (axis + 1) % 3);
    split(middle + 1, end, (axis + 1) % 3);
  }

  template <class F>
  void find(std::size_t begin, std::size_t end, int axis, const Bounds& box, const F& f) const {
    if (begin >= end) return;
    const std::size_t middle = begin + (end - begin) / 2;
    const Vec3f p = points_[sequence_[middle]];
    const float v = component(p, axis);
    if (component(box.min, axis) <= v) find(begin, middle, (axis + 1) % 3, box, f);
    if (p.x >= box.min.x && p.x <= box.max.x && p.y >= box.min.y && p.y <= box.max.y && p.z >= box.min.z &&
        p.z <= box.max.z)
      f(sequence_[middle]);
    if (component(box.max, axis) >= v) find(middle + 1, end, (axis + 1) % 3, box, f);
  }

  std::span<const Vec3f> points_;
  std::vector<std::uint32_t> sequence_;
};

// The point of a triangle nearest to p (Ericson 2005, Real-Time Collision Detection, section 5.1.5).
Vec3d nearest_point(const std::array<Vec3d, 3>& t, Vec3d p) {
  const Vec3d ab = t[1] - t[0], ac = t[2] - t[0], ap = p - t[0];
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return t[0];
  const Vec3d bp = p - t[1];
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return t[1];
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return t[0] + d1 / (d1 - d3) * ab;
  const Vec3d cp = p - t[2];
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return t[2];
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return t[0] + d2 / (d2 - d6) * ac;
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return t[1] + (d4 - d3) / (d4 - d3 + d5 - d6) * (t[2] - t[1]);
  const double scale = 1 / (va + vb + vc);
  return t[0] + vb * scale * ab + vc * scale * ac;
}

// A triangle that touches a site and reaches into the half-space before it, and the side of it to be on.
struct Contact {
  std::uint32_t site = 0;
  Vec3d side;
  bool operator==(const Contact&) const = default;
};

Vec3d unit(Vec3d v) {
  const double length = std::sqrt(dot(v, v));
  return length > 0 ? (1 / length) * v : Vec3d{};
}

// Where each site's own surface lies: the mean way to the middles of the triangles around it.
std::vector<Vec3f> own_surface_ways(const WorldMesh& world, const Sites& sites) {
  std::vector<Vec3f> ways(sites.size());
  for (std::size_t t = 0; t < world.indices.size(); t += 3) {
    const std::uint32_t* v = world.indices.data() + t;
    const Vec3f middle = 1.0f / 3 * (world.positions[v[0]] + world.positions[v[1]] + world.positions[v[2]]);
    for (std::size_t k = 0; k < 3; ++k) {
      Vec3f& way = ways[sites.of_vertex[v[k]]];
      way = way + (middle - world.positions[v[k]]);
    }
  }
  return ways;
}

void find_contacts(const WorldMesh& world, const Sites& sites, std::span<const Vec3f> ways, const PointTree& tree,
                   std::size_t triangle, float offset, std::vector<Contact>& contacts) {
  std::array<Vec3d, 3> corners;
  Bounds box;
  Vec3d normals;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint32_t v = world.indices[3 * triangle + k];
    const Vec3f p = world.positions[v];
    corners[k] = vec_cast<double>(p);
    normals = normals + vec_cast<double>(world.normals[v]);
    if (k == 0) box = {p, p};
    box.min = {std::min(box.min.x, p.x), std::min(box.min.y, p.y), std::min(box.min.z, p.z)};
    box.max = {std::max(box.max.x, p.x), std::max(box.max.y, p.y), std::max(box.max.z, p.z)};
  }
  const Vec3d geometric = unit(cross(corners[1] - corners[0], corners[2] - corners[0]));
  if (geometric == Vec3d{}) return;
  const Vec3f margin = {offset, offset, offset};
  tree.find({box.min - margin, box.max + margin}, [&](std::uint32_t site) {
    const Vec3d p = vec_cast<double>(sites.positions[site]), n = vec_cast<double>(sites.normals[site]);
    const Vec3d near = nearest_point(corners, p) - p;
    if (dot(near, near) > double{offset} * double{offset}) return;
    // What stays behind the site's horizon is in no ray's way: its own flat or convex surroundings above all.
    constexpr double kLeastRise = 1e-3;
    const bool rises = std::ranges::any_of(corners, [&](Vec3d c) {
      const Vec3d way = c - p;
      return dot(n, way) > double{offset} + kLeastRise * std::sqrt(dot(way, way));
    });
    if (!rises) return;
    // The side of the site's own surface; the front where the triangle is part of that or has it in its plane.
    const std::uint32_t* v = world.indices.data() + 3 * triangle;
    const bool is_own = std::any_of(v, v + 3, [&](std::uint32_t corner) { return sites.of_vertex[corner] == site; });
    const Vec3d way = vec_cast<double>(ways[site]);
    const double height = dot(geometric, way);
    const bool is_clear = !is_own && std::abs(height) > kLeastRise * std::sqrt(dot(way, way));
    const bool is_along = is_clear ? height > 0 : dot(geometric, normals) >= 0;
    const Vec3d side = is_along ? geometric : -geometric;
    // The offset along the normal is enough where it leads away from the triangle too.
    if (dot(side, n) < 0.5) contacts.push_back({site, side});
  });
}

// A short way that is at least about 1 long along the normal and along all sides: each that is too short is lengthened
// in turn until none is (Kaczmarz's method), which takes the more rounds the narrower the valley. The normal where they
// contradict each other, or leave only a way so long that it may lead through something.
Vec3d way_before(Vec3d normal, std::span<const Contact> contacts) {
  constexpr int kRounds = 1000;
  constexpr double kMost = 16, kEnough = 0.7;
  Vec3d way = normal;
  for (int round = 0; round < kRounds && dot(way, way) <= kMost * kMost; ++round) {
    double shortest = 1;
    const auto lengthen = [&](Vec3d side) {
      const double length = dot(side, way);
      shortest = std::min(shortest, length);
      if (length < 1) way = way + (1 - length) * side;
    };
    for (const Contact& contact : contacts) lengthen(contact.side);
    lengthen(normal);
    if (shortest > kEnough) return way;
  }
  return normal;
}

}  // namespace

void place_origins(const WorldMesh& world, int threads, Sites& sites) {
  const float offset = kOffset * world.radius;
  const PointTree tree(sites.positions);
  const std::vector<Vec3f> ways = own_surface_ways(world, sites);
  constexpr std::size_t kBlock = 4096;
  const std::size_t triangles = world.indices.size() / 3;
  std::vector<std::vector<Contact>> blocks((triangles + kBlock - 1) / kBlock);
  parallel_for(blocks.size(), threads, [&](std::size_t b) {
    for (std::size_t t = kBlock * b; t < std::min(triangles, kBlock * (b + 1)); ++t)
      find_contacts(world, sites, ways, tree, t, offset, blocks[b]);
  });
  std::vector<Contact> contacts;
  for (const auto& block : blocks) contacts.insert(contacts.end(), block.begin(), block.end());
  std::ranges::stable_sort(contacts, {}, &Contact::site);

  sites.origins.resize(sites.size());
  std::size_t next = 0;
  for (std::size_t site = 0; site < sites.size(); ++site) {
    const std::size_t first = next;
    while (next < contacts.size() && contacts[next].site == site) ++next;
    const Vec3d way =
        way_before(vec_cast<double>(sites.normals[site]), std::span(contacts).subspan(first, next - first));
    sites.origins[site] = sites.positions[site] + offset * vec_cast<float>(way);
  }
}

}  // namespace shlight
