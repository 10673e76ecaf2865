#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "shlight/scene/scene.h"

namespace shlight {

// Points in a balanced tree of boxes: the middle of a range, along the longest side of its box, parts it. Every box is
// as small as it can be, so that whoever knows more of what he looks for than a box around it passes by the rest.
class PointTree {
 public:
  // The points outlive the tree.
  explicit PointTree(std::span<const Vec3f> points) : sequence_(points.size()) {
    std::iota(sequence_.begin(), sequence_.end(), 0u);
    std::size_t nodes = 1;
    for (std::size_t size = points.size(); size > kLeaf; size = (size + 1) / 2) nodes *= 2;
    boxes_.resize(2 * nodes);
    if (!points.empty()) split(points, 0, points.size(), 1);
  }

  // Calls f(point) for each point of every smallest box for which, as for all boxes around it, may_hold(box) is true.
  template <class MayHold, class F>
  void find(const MayHold& may_hold, const F& f) const {
    if (!sequence_.empty()) find(0, sequence_.size(), 1, may_hold, f);
  }

 private:
  static constexpr std::size_t kLeaf = 4;

  // Node k's halves are nodes 2k and 2k + 1. The first half is the larger one.
  static std::size_t middle_of(std::size_t begin, std::size_t end) { return begin + (end - begin + 1) / 2; }

  void split(std::span<const Vec3f> points, std::size_t begin, std::size_t end, std::size_t node) {
    Bounds box = {points[sequence_[begin]], points[sequence_[begin]]};
    for (std::size_t i = begin + 1; i < end; ++i) {
      const Vec3f p = points[sequence_[i]];
      box.min = {std::min(box.min.x, p.x), std::min(box.min.y, p.y), std::min(box.min.z, p.z)};
      box.max = {std::max(box.max.x, p.x), std::max(box.max.y, p.y), std::max(box.max.z, p.z)};
    }
    boxes_[node] = box;
    if (end - begin <= kLeaf) return;
    const Vec3f size = box.max - box.min;
    float Vec3f::*const axis = size.x >= size.y && size.x >= size.z ? &Vec3f::x
                               : size.y >= size.z                   ? &Vec3f::y
                                                                    : &Vec3f::z;
    const std::size_t middle = middle_of(begin, end);
    const auto at = [&](std::size_t i) { return sequence_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(begin), at(middle), at(end), [&](std::uint32_t a, std::uint32_t b) {
      return std::pair(points[a].*axis, a) < std::pair(points[b].*axis, b);
    });
    split(points, begin, middle, 2 * node);
    split(points, middle, end, 2 * node + 1);
  }

  template <class MayHold, class F>
  void find(std::size_t begin, std::size_t end, std::size_t node, const MayHold& may_hold, const F& f) const {
    if (!may_hold(boxes_[node])) return;
    if (end - begin <= kLeaf) {
      for (std::size_t i = begin; i < end; ++i) f(sequence_[i]);
      return;
    }
    const std::size_t middle = middle_of(begin, end);
    find(begin, middle, 2 * node, may_hold, f);
    find(middle, end, 2 * node + 1, may_hold, f);
  }

  std::vector<std::uint32_t> sequence_;
  std::vector<Bounds> boxes_;
};

}  // namespace shlight
