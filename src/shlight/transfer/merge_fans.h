#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "shlight/sh/vec.h"
#include "shlight/transfer/tracer.h"

namespace shlight {

// Triangles that a tracer is given in the place of others: huge fans, of thousands of triangles about one vertex, are
// the one thing on which trees of boxes fail, since the boxes of such slivers all lie in each other, and every ray
// near a fan meets most of them. Neighbours whose rim is straight to within `tolerance` become one triangle, everything
// else stays as it is.
struct MergedFans {
  std::vector<std::uint32_t> indices;         // three for each triangle that is left
  std::vector<std::uint32_t> first_triangle;  // the first of the triangles that each stands for, and at the end the
                                              // number of all; several where they were merged
};

// Fans count where their triangles, kLeastFan or more, follow each other in `indices`; their vertices are the same
// where their positions are. Nothing where there is none such, which is what there is in all but odd models.
inline constexpr std::size_t kLeastFan = 4096;
std::optional<MergedFans> merge_fans(std::span<const Vec3f> positions, std::span<const std::uint32_t> indices,
                                     float tolerance);

// From a hit of a triangle that is left to one of those that it stands for.
Hit unmerge_hit(const MergedFans& fans, std::span<const Vec3f> positions, std::span<const std::uint32_t> indices,
                const Hit& hit);

}  // namespace shlight
