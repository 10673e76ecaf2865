#include "shlight/transfer/sites.h"

#include <algorithm>
#include <numeric>
#include <span>

#include "shlight/scene/weld.h"
#include "shlight/transfer/contacts.h"

namespace shlight {
namespace {

// Spreads the 21 low bits of v so that two free ones follow each.
std::uint64_t spread_bits(std::uint64_t v) {
  v = (v | v << 32) & 0x001f00000000ffffu;
  v = (v | v << 16) & 0x001f0000ff0000ffu;
  v = (v | v << 8) & 0x100f00f00f00f00fu;
  v = (v | v << 4) & 0x10c30c30c30c30c3u;
  return (v | v << 2) & 0x1249249249249249u;
}

// The place of a point on a Morton curve through a cube from -radius to radius.
std::uint64_t morton_code(Vec3f p, float radius) {
  const auto digits = [&](float v) {
    const double unit = radius > 0 ? 0.5 + 0.5 * double{v} / double{radius} : 0;
    return spread_bits(static_cast<std::uint64_t>(std::clamp(unit, 0.0, 1.0) * 0x1fffff));
  };
  return digits(p.x) | digits(p.y) << 1 | digits(p.z) << 2;
}

}  // namespace

Sites make_sites(const WorldMesh& world, int threads) {
  std::vector<float> rows(6 * world.positions.size());
  for (std::size_t v = 0; v < world.positions.size(); ++v) {
    const Vec3f p = world.positions[v], n = world.normals[v];
    std::ranges::copy(std::initializer_list<float>{p.x, p.y, p.z, n.x, n.y, n.z},
                      rows.begin() + 6 * static_cast<std::ptrdiff_t>(v));
  }
  Weld weld = weld_rows(rows, 6);
  rows = {};

  std::vector<std::uint64_t> codes(weld.first.size());
  for (std::size_t g = 0; g < codes.size(); ++g) codes[g] = morton_code(world.positions[weld.first[g]], world.radius);
  std::vector<std::uint32_t> groups(codes.size());
  std::iota(groups.begin(), groups.end(), 0u);
  std::ranges::stable_sort(groups, {}, [&](std::uint32_t g) { return codes[g]; });

  Sites sites;
  std::vector<std::uint32_t> site_of_group(groups.size());
  for (const std::uint32_t g : groups) {
    site_of_group[g] = static_cast<std::uint32_t>(sites.positions.size());
    sites.positions.push_back(world.positions[weld.first[g]]);
    sites.normals.push_back(world.normals[weld.first[g]]);
  }
  sites.of_vertex = std::move(weld.group);
  for (std::uint32_t& site : sites.of_vertex) site = site_of_group[site];
  place_origins(world, threads, sites);
  return sites;
}

}  // namespace shlight
