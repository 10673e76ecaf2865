#include "shlight/transfer/contacts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <span>

#include "shlight/core/parallel.h"
#include "shlight/scene/weld.h"
#include "shlight/transfer/point_tree.h"

namespace shlight {
namespace {

// The distance of origins from the surface, in units of the largest coordinate: sixteen times what rounding a float can
// move a vertex.
constexpr float kOffset = 0x1p-20f;

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

// A triangle and all that is nearer to it than `margin`.
class Touch {
 public:
  Touch(const WorldMesh& world, std::size_t triangle, float margin) : margin_(double{margin}) {
    for (std::size_t k = 0; k < 3; ++k)
      corners_[k] = vec_cast<double>(world.positions[world.indices[3 * triangle + k]]);
    const Vec3d a = corners_[1] - corners_[0], b = corners_[2] - corners_[0];
    const Vec3d normal = unit(cross(a, b));
    axes_ = {Vec3d{1, 0, 0},
             Vec3d{0, 1, 0},
             Vec3d{0, 0, 1},
             normal,
             unit(cross(a, normal)),
             unit(cross(b, normal)),
             unit(cross(b - a, normal))};
    for (std::size_t k = 0; k < kAxes; ++k) {
      const auto [low, high] =
          std::minmax({dot(axes_[k], corners_[0]), dot(axes_[k], corners_[1]), dot(axes_[k], corners_[2])});
      low_[k] = low, high_[k] = high;
    }
  }

  Vec3d normal() const { return axes_[3]; }
  // Of its box, the longest side.
  double size() const { return std::max({high_[0] - low_[0], high_[1] - low_[1], high_[2] - low_[2]}); }

  // False where nothing of the box is near: some plane, across an axis or along the triangle or one of its sides, parts
  // them. Boxes of their own alone say little of thin triangles that lie askew.
  bool may_hold(const Bounds& box) const {
    const Vec3d low = vec_cast<double>(box.min), high = vec_cast<double>(box.max);
    const Vec3d middle = 0.5 * (low + high), half = 0.5 * (high - low);
    for (std::size_t k = 0; k < kAxes; ++k) {
      const Vec3d axis = axes_[k];
      const double at = dot(axis, middle);
      // Twice the margin, so that rounding drops nothing.
      const double reach =
          std::abs(axis.x) * half.x + std::abs(axis.y) * half.y + std::abs(axis.z) * half.z + 2 * margin_;
      if (at + reach < low_[k] || at - reach > high_[k]) return false;
    }
    return true;
  }
  bool holds(Vec3d p) const {
    const Vec3d way = nearest_point(corners_, p) - p;
    return dot(way, way) <= margin_ * margin_;
  }

 private:
  static constexpr std::size_t kAxes = 7;
  double margin_ = 0;
  std::array<Vec3d, 3> corners_;
  std::array<Vec3d, kAxes> axes_;
  std::array<double, kAxes> low_ = {}, high_ = {};
};

// The sites of equal position, which the same triangles touch.
struct Places {
  std::vector<Vec3f> positions;
  std::vector<std::uint32_t> sites;       // place after place
  std::vector<std::uint32_t> first_site;  // of each place, and at the end the number of all
};

// Sorts numbers by a key below `keys` each: `first` of each key, and at the end their number; equal keys keep their
// sequence.
template <class KeyOf>
std::vector<std::uint32_t> sort_by_key(std::size_t count, std::size_t keys, const KeyOf& key_of,
                                       std::vector<std::uint32_t>& first) {
  first.assign(keys + 1, 0);
  for (std::size_t i = 0; i < count; ++i) ++first[key_of(i) + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<std::uint32_t> next(first.begin(), first.end() - 1), sorted(count);
  for (std::size_t i = 0; i < count; ++i) sorted[next[key_of(i)]++] = static_cast<std::uint32_t>(i);
  return sorted;
}

Places make_places(const Sites& sites) {
  const Weld weld = weld_positions(sites.positions);
  Places places;
  for (const std::uint32_t site : weld.first) places.positions.push_back(sites.positions[site]);
  places.sites = sort_by_key(
      sites.size(), weld.first.size(), [&](std::size_t site) { return weld.group[site]; }, places.first_site);
  return places;
}

// The triangles that touch each place.
struct Touching {
  std::vector<std::uint32_t> triangles;       // place after place, each in the mesh's sequence
  std::vector<std::uint32_t> first_triangle;  // of each place, and at the end the number of all
};

Touching find_touching(const WorldMesh& world, const Places& places, float offset, int threads) {
  struct Pair {
    std::uint32_t place = 0, triangle = 0;
  };
  const PointTree tree(places.positions);
  constexpr std::size_t kBlock = 4096;
  const std::size_t triangles = world.indices.size() / 3;
  std::vector<std::vector<Pair>> blocks((triangles + kBlock - 1) / kBlock);
  parallel_for(blocks.size(), threads, [&](std::size_t b) {
    for (std::size_t t = kBlock * b; t < std::min(triangles, kBlock * (b + 1)); ++t) {
      const Touch touch(world, t, offset);
      // What is smaller than the offset stands in no ray's way, since rays begin beyond it. Without this, everything
      // would touch everything where a scene is a million times as large as one of its models.
      if (touch.normal() == Vec3d{} || touch.size() < double{offset}) continue;
      tree.find([&](const Bounds& box) { return touch.may_hold(box); },
                [&](std::uint32_t place) {
                  if (touch.holds(vec_cast<double>(places.positions[place])))
                    blocks[b].push_back({place, static_cast<std::uint32_t>(t)});
                });
    }
  });
  std::vector<Pair> pairs;
  for (auto& block : blocks) pairs.insert(pairs.end(), block.begin(), block.end()), block = {};
  Touching touching;
  touching.triangles = sort_by_key(
      pairs.size(), places.positions.size(), [&](std::size_t i) { return pairs[i].place; }, touching.first_triangle);
  for (std::uint32_t& t : touching.triangles) t = pairs[t].triangle;
  return touching;
}

// The side of a triangle to be on, for a site that it touches, where it reaches into the half-space before the site.
std::optional<Vec3d> side_of(const WorldMesh& world, const Sites& sites, Vec3f own_way, std::uint32_t triangle,
                             std::uint32_t site, float offset) {
  const std::uint32_t* v = world.indices.data() + 3 * std::size_t{triangle};
  std::array<Vec3d, 3> corners;
  Vec3d normals;
  for (std::size_t k = 0; k < 3; ++k) {
    corners[k] = vec_cast<double>(world.positions[v[k]]);
    normals = normals + vec_cast<double>(world.normals[v[k]]);
  }
  const Vec3d geometric = unit(cross(corners[1] - corners[0], corners[2] - corners[0]));
  const Vec3d p = vec_cast<double>(sites.positions[site]), n = vec_cast<double>(sites.normals[site]);
  // What stays behind the site's horizon is in no ray's way: its own flat or convex surroundings above all.
  constexpr double kLeastRise = 1e-3;
  const bool rises = std::ranges::any_of(corners, [&](Vec3d c) {
    const Vec3d way = c - p;
    return dot(n, way) > double{offset} + kLeastRise * std::sqrt(dot(way, way));
  });
  if (!rises) return {};
  // The side of the site's own surface; the front where the triangle is part of that or has it in its plane.
  const bool is_own = std::any_of(v, v + 3, [&](std::uint32_t corner) { return sites.of_vertex[corner] == site; });
  const Vec3d way = vec_cast<double>(own_way);
  const double height = dot(geometric, way);
  const bool is_clear = !is_own && std::abs(height) > kLeastRise * std::sqrt(dot(way, way));
  const bool is_along = is_clear ? height > 0 : dot(geometric, normals) >= 0;
  const Vec3d side = is_along ? geometric : -geometric;
  // The offset along the normal is enough where it leads away from the triangle too.
  if (dot(side, n) >= 0.5) return {};
  return side;
}

// A short way that is at least about 1 long along the normal and along all sides: each that is too short is lengthened
// in turn until none is (Kaczmarz's method), which takes the more rounds the narrower the valley. The normal where they
// contradict each other, or leave only a way so long that it may lead through something.
Vec3d way_before(Vec3d normal, std::span<const Vec3d> sides) {
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
    for (const Vec3d side : sides) lengthen(side);
    lengthen(normal);
    if (shortest > kEnough) return way;
  }
  return normal;
}

}  // namespace

void place_origins(const WorldMesh& world, int threads, Sites& sites) {
  const float offset = kOffset * world.radius;
  const std::vector<Vec3f> ways = own_surface_ways(world, sites);
  const Places places = make_places(sites);
  const Touching touching = find_touching(world, places, offset, threads);
  // Where a crowd of triangles meets, as at the hub of a fan, so many of them, evenly picked, say where the rest are.
  // That keeps the work linear: such a hub may have as many sites as triangles.
  constexpr std::size_t kCrowd = 512;

  sites.origins.resize(sites.size());
  constexpr std::size_t kBlock = 1024;
  const std::size_t count = places.positions.size();
  parallel_for((count + kBlock - 1) / kBlock, threads, [&](std::size_t block) {
    std::vector<std::uint32_t> triangles;
    std::vector<Vec3d> sides;
    for (std::size_t place = kBlock * block; place < std::min(count, kBlock * (block + 1)); ++place) {
      const std::size_t first = touching.first_triangle[place], all = touching.first_triangle[place + 1] - first;
      triangles.clear();
      for (std::size_t k = 0; k < std::min(all, kCrowd); ++k)
        triangles.push_back(touching.triangles[first + (all <= kCrowd ? k : k * all / kCrowd)]);
      for (std::size_t k = places.first_site[place]; k < places.first_site[place + 1]; ++k) {
        const std::uint32_t site = places.sites[k];
        sides.clear();
        for (const std::uint32_t triangle : triangles)
          if (const auto side = side_of(world, sites, ways[site], triangle, site, offset)) sides.push_back(*side);
        const Vec3d way = way_before(vec_cast<double>(sites.normals[site]), sides);
        sites.origins[site] = sites.positions[site] + offset * vec_cast<float>(way);
      }
    }
  });
}

}  // namespace shlight
