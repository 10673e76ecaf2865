#pragma once

#include <cstdint>
#include <string>

#include "shlight/core/error.h"

// What the readers of pictures share; not installed.

namespace shlight {

inline constexpr const char* kAcceptedPictures = "a picture such as .hdr, .exr, .png, .jpg or .tif";

// "is not a readable picture (why)", in one line whatever a library says.
Error malformed_picture(const std::string& name, std::string why);

// Throws Error unless a picture of this size has pixels, and no more than it may. Call before memory is taken.
void check_picture_size(const std::string& name, std::int64_t width, std::int64_t height, std::uint64_t max_pixels);

}  // namespace shlight
