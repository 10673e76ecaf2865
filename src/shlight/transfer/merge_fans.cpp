#include "shlight/transfer/merge_fans.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace shlight {
namespace {

// No more triangles become one, so that the search for them stays short.
constexpr std::size_t kMostMerged = 256;

struct Triangles {
  std::span<const Vec3f> positions;
  std::span<const std::uint32_t> indices;

  std::size_t size() const { return indices.size() / 3; }
  Vec3f corner(std::size_t triangle, std::size_t k) const { return positions[indices[3 * triangle + k % 3]]; }
};

// Triangles of a fan: each shares its hub and one rim vertex with the next. Seen from the hub, its last corner lies
// ahead, or its second one.
struct Fan {
  std::size_t first = 0;
  bool is_last_ahead = true;
  std::vector<std::uint8_t> hubs;  // which corner of each triangle is the hub

  std::size_t size() const { return hubs.size(); }
  // Rim vertex k of 0 … size(): a corner of triangle k, or of the one before it.
  std::uint32_t rim(const Triangles& t, std::size_t k) const {
    const std::size_t last = k == size() ? 1 : 0, behind = is_last_ahead ? 1 : 2;
    const std::size_t corner = hubs[k - last] + (last ? 3 - behind : behind);
    return t.indices[3 * (first + k - last) + corner % 3];
  }
};

// The corner of triangle `next` that is the hub where `hub` is that of the triangle before; 3 where it is no part of
// the fan.
std::size_t next_hub(const Triangles& t, std::size_t next, std::size_t hub, bool is_last_ahead) {
  const std::size_t ahead = is_last_ahead ? 2 : 1;
  std::size_t k = 0;
  while (k < 3 && !(t.corner(next, k) == t.corner(next - 1, hub) &&
                    t.corner(next, k + 3 - ahead) == t.corner(next - 1, hub + ahead)))
    ++k;
  return k;
}

// The longest of the fans that begin at a triangle; only the number of its triangles where that is below kLeastFan.
std::pair<std::size_t, Fan> find_fan(const Triangles& t, std::size_t first) {
  std::pair<std::size_t, Fan> longest;
  for (const bool is_last_ahead : {true, false})
    for (std::uint8_t hub = 0; hub < 3; ++hub) {
      std::size_t end = first + 1;
      for (std::size_t k = hub; end < t.size() && (k = next_hub(t, end, k, is_last_ahead)) < 3;) ++end;
      if (end - first <= longest.first) continue;
      longest = {end - first, {first, is_last_ahead, {hub}}};
    }
  Fan& fan = longest.second;
  if (longest.first >= kLeastFan)
    for (std::size_t k = first + 1; k < first + longest.first; ++k)
      fan.hubs.push_back(static_cast<std::uint8_t>(next_hub(t, k, fan.hubs.back(), fan.is_last_ahead)));
  return longest;
}

// How far along the chord from a to b, from 0 to 1, the foot of p lies.
double along_chord(Vec3d a, Vec3d b, Vec3d p) {
  return dot(p - a, b - a) / dot(b - a, b - a);
}

// Whether rim vertices begin … end lie on the chord from the first to the last, one after the other.
bool is_straight(const Triangles& t, const Fan& fan, std::size_t begin, std::size_t end, double tolerance) {
  const auto rim = [&](std::size_t k) { return vec_cast<double>(t.positions[fan.rim(t, k)]); };
  const Vec3d a = rim(begin), b = rim(end);
  if (a == b) return false;
  double before = 0;
  for (std::size_t k = begin + 1; k < end; ++k) {
    const double s = along_chord(a, b, rim(k));
    const Vec3d off = rim(k) - (a + s * (b - a));
    if (s <= before || s >= 1 || dot(off, off) > tolerance * tolerance) return false;
    before = s;
  }
  return true;
}

}  // namespace

std::optional<MergedFans> merge_fans(std::span<const Vec3f> positions, std::span<const std::uint32_t> indices,
                                     float tolerance) {
  const Triangles t = {positions, indices};
  MergedFans merged;
  std::size_t kept = 0;  // triangles before it are in `merged`
  const auto keep_up_to = [&](std::size_t end) {
    for (; kept < end; ++kept) {
      const auto corners = indices.subspan(3 * kept, 3);
      merged.indices.insert(merged.indices.end(), corners.begin(), corners.end());
      merged.first_triangle.push_back(static_cast<std::uint32_t>(kept));
    }
  };
  for (std::size_t first = 0; first < t.size();) {
    const auto [length, fan] = find_fan(t, first);
    if (length < kLeastFan) {
      // The next fan may begin with the last triangle of this one.
      first += std::max(std::size_t{1}, length - 1);
      continue;
    }
    keep_up_to(first);
    for (std::size_t begin = 0; begin < fan.size();) {
      std::size_t end = begin + 1;
      while (end < fan.size() && end - begin < kMostMerged && is_straight(t, fan, begin, end + 1, double{tolerance}))
        ++end;
      if (end == begin + 1) {
        keep_up_to(first + end);
      } else {
        const std::uint32_t hub = indices[3 * (first + begin) + fan.hubs[begin]];
        const std::uint32_t behind = fan.rim(t, begin), ahead = fan.rim(t, end);
        merged.indices.insert(merged.indices.end(),
                              {hub, fan.is_last_ahead ? behind : ahead, fan.is_last_ahead ? ahead : behind});
        merged.first_triangle.push_back(static_cast<std::uint32_t>(kept));
        kept = first + end;
      }
      begin = end;
    }
    first += fan.size();
  }
  if (merged.indices.empty()) return {};
  keep_up_to(t.size());
  merged.first_triangle.push_back(static_cast<std::uint32_t>(t.size()));
  return merged;
}

Hit unmerge_hit(const MergedFans& fans, std::span<const Vec3f> positions, std::span<const std::uint32_t> indices,
                const Hit& hit) {
  if (hit.triangle == Hit::kNone) return hit;
  const std::uint32_t begin = fans.first_triangle[hit.triangle], end = fans.first_triangle[hit.triangle + 1];
  if (end - begin == 1) return {begin, hit.u, hit.v};

  // The piece in whose share of the chord the hit lies, seen from the hub.
  const Triangles t = {positions, indices};
  const std::uint32_t* left = fans.indices.data() + 3 * std::size_t{hit.triangle};
  const Vec3f hub = positions[left[0]];
  const Vec3d a = vec_cast<double>(positions[left[1]]), b = vec_cast<double>(positions[left[2]]);
  const double out = double{hit.u} + double{hit.v}, at = out > 0 ? double{hit.v} / out : 0;
  Hit result;
  double nearest = 2;
  for (std::uint32_t piece = begin; piece < end; ++piece) {
    std::size_t k = 0;
    while (k < 2 && !(t.corner(piece, k) == hub)) ++k;
    const double from = along_chord(a, b, vec_cast<double>(t.corner(piece, k + 1))),
                 to = along_chord(a, b, vec_cast<double>(t.corner(piece, k + 2)));
    const double miss = std::max({0.0, from - at, at - to});
    if (miss >= nearest) continue;
    nearest = miss;
    const double share = std::clamp((at - from) / (to - from), 0.0, 1.0);
    std::array<double, 3> weights;
    weights[k] = 1 - out;
    weights[(k + 1) % 3] = out * (1 - share);
    weights[(k + 2) % 3] = out * share;
    result = {piece, static_cast<float>(weights[1]), static_cast<float>(weights[2])};
  }
  return result;
}

}  // namespace shlight
