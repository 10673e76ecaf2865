#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>

#include "shlight/core/error.h"
#include "shlight/image/image.h"
#include "shlight/image/image_io.h"

// What the readers of pictures share; not installed.

namespace shlight {

inline constexpr const char* kAcceptedPictures = "a picture such as .hdr, .exr, .png, .jpg or .tif";

// The name of a file, or its bytes and what to call them.
struct PictureSource {
  std::string name;
  std::span<const std::byte> bytes;  // empty: read the file of that name
};

// "is not a readable picture (why)", in one line whatever a library says.
Error malformed_picture(const std::string& name, std::string why);

// Throws Error unless a picture of this size has pixels, and no more than it may. Call before memory is taken.
void check_picture_size(const std::string& name, std::int64_t width, std::int64_t height, std::uint64_t max_pixels);

// Whether a name has one of these endings, ".hdr", in capitals or not.
bool has_ending(const std::string& name, std::initializer_list<std::string_view> endings);

// IEC 61966-2-1, for values in [0, 1].
float linear_from_srgb(float value);

// OpenImageIO's and OpenEXR's own threads would not survive a fork, on either side of the fence.
void without_library_threads();

// What OpenImageIO makes of a picture; call behind the fence. Of OpenEXR files, the colours of the first part that has
// any, within its display window; environment maps whole, with their layout.
LoadedImage read_by_library(const PictureSource& source, std::uint64_t max_pixels);
Image8 read8_by_library(const PictureSource& source, std::uint64_t max_pixels);

}  // namespace shlight
