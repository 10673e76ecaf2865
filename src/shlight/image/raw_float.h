#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "shlight/image/image_io.h"

namespace shlight {

// Light probes as Debevec published them [1]: a square of N x N pixels of three 32-bit floats, rows from the top,
// without a header; angular maps. Nothing in the file tells the sequence of the bytes: it is the one in which nearly
// all values that are not 0 are finite and between 1e-12 and 1e12, while in the other many are not.
//
// [1] http://www.pauldebevec.com/Probes, "float" files.

// Throws Error, with `name` as its subject.
LoadedImage decode_raw_float(std::span<const std::byte> bytes, const std::string& name, std::uint64_t max_pixels);

}  // namespace shlight
