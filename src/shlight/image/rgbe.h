#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "shlight/image/image_io.h"

namespace shlight {

// Radiance pictures (.hdr, .pic, .rgbe) [1]: a header of lines, a line that names the picture's size and the sequence
// of its pixels, and pixels of three mantissas that share an exponent: value = m · 2^(e−136), without the half that
// Radiance itself adds. Black where e is 0.
//
// - EXPOSURE and COLORCORR, of which all lines multiply, say by what radiance was multiplied before it was written: it
//   is divided by them. Zero, negative and non-finite ones are ignored, with a warning.
// - PRIMARIES that make a colour space are converted to Rec. 709 (chromaticities.h); all zeros, as Photoshop writes
//   them, say nothing; others are ignored, with a warning. None at all means Rec. 709, as every program but Radiance
//   has it.
// - Pixels in any of the eight sequences ("-Y 512 +X 1024": rows from the top, pixels from the left; "+X 1024 -Y 512":
//   columns from the left, pixels from the top; …), flat or with either run-length encoding.
// - FORMAT is 32-bit_rle_rgbe or 32-bit_rle_xyze; with no such line it is taken to be the first, with a warning.
//
// [1] Ward, Radiance File Formats, https://www.radiance-online.org, filefmts.pdf, "Picture file format".

// Throws Error, with `name` as its subject.
LoadedImage decode_rgbe(std::span<const std::byte> bytes, const std::string& name, std::uint64_t max_pixels);

// A flat picture, rows from the top, each mantissa rounded to the nearest: relative error at most 1/256 of the largest
// channel, without bias. Throws Error where a value is negative, not finite, or more than the format holds, 1.69e38.
std::vector<std::byte> encode_rgbe(const Image& image, const std::string& name);

}  // namespace shlight
