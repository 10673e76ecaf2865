#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "shlight/core/fence.h"
#include "shlight/image/image.h"
#include "shlight/image/layout.h"

namespace shlight {

// Reading and writing pictures, through OpenImageIO.

struct LoadImageParams {
  std::uint64_t max_pixels = 256ull << 20;  // 16384 x 16384; a bigger picture is refused before memory is taken
  FenceLimits fence;                        // pictures are decoded in a process of their own
};

// A picture and what else its file tells.
struct LoadedImage {
  Image image;
  std::optional<Layout> layout;       // where the file states one, not where its shape suggests it
  std::vector<std::string> warnings;  // a line each: what was odd, and what was made of it
};

// Reads a picture into linear Rec. 709: Radiance pictures (rgbe.h), OpenEXR, DDS cube maps (dds.h), raw light probes
// (raw_float.h), and whatever else OpenImageIO knows. Float and half-float formats are taken to be linear, formats of
// integers to be sRGB. A picture of one channel is grey; alpha is left out. Of an OpenEXR file: level 0 of the first
// part with R, G and B, else Y, else a layer's R, G and B, all float or half; what its display window shows, black
// where there is no data, but an environment map whole; its chromaticities are converted to Rec. 709
// (chromaticities.h). Values are as the file has them, NaN, infinite and negative ones too: see pixel_report.h. Throws
// Error.
LoadedImage load_image(const std::filesystem::path& path, const LoadImageParams& params = {});

// Reads a picture as eight-bit sRGB with alpha, from a file or from the bytes of one. `name` is used in errors and, by
// its ending, to tell the format where the bytes do not. Throws Error.
Image8 load_image8(const std::filesystem::path& path, const LoadImageParams& params = {});
Image8 load_image8(std::span<const std::byte> bytes, const std::string& name, const LoadImageParams& params = {});

// Writes linear values as .exr, in 16-bit floats unless a value is too large for them, or as .hdr (encode_rgbe in
// rgbe.h), which refuses negative values and those that are not finite. An .exr file says where its layout is one of
// OpenEXR's own. Whole or not at all; throws Error.
void save_image(const std::filesystem::path& path, const Image& image, std::optional<Layout> layout = {});

// Writes an sRGB picture as .png. Whole or not at all; throws Error.
void save_image8(const std::filesystem::path& path, const Image8& image);

// The bytes of that file. Throws Error, with `name` as its subject.
std::vector<std::byte> encode_png(const Image8& image, const std::string& name);

}  // namespace shlight
