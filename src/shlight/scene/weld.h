#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shlight/sh/vec.h"

namespace shlight {

// Which of many rows of numbers are equal.
struct Weld {
  std::vector<std::uint32_t> group;  // of each row; groups are numbered in the order of their first rows
  std::vector<std::uint32_t> first;  // the first row of each group
};

// `values` holds rows of `stride` floats, at most 2^32 - 1 rows. Rows are equal where all their floats are (so +0 is
// -0), or have the same bits (so a NaN may equal itself). Expected time is linear.
Weld weld_rows(std::span<const float> values, std::size_t stride);

Weld weld_positions(std::span<const Vec3f> positions);

}  // namespace shlight
