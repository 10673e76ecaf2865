#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "shlight/image/image_io.h"

namespace shlight {

// DDS files [1], single pictures and cube maps:
//
// - half and float: A16B16G16R16F, A32B32G32R32F; R16G16B16A16, R32G32B32A32, R32G32B32, R11G11B10, R9G9B9E5
// - 8 bits a channel, taken to be sRGB: RGB(A) and BGR(A), with masks or as a DXGI format
// - block-compressed: BC1 to BC3, BC6H (both), BC7
//
// A cube map becomes a vertical strip of its six faces, level 0, in the file's sequence: +X −X +Y −Y +Z −Z, with
// Layout::kCube. Incomplete cubes, arrays of cubes and volumes are refused.
//
// [1] Microsoft, Programming Guide for DDS; Reference for DDS. https://learn.microsoft.com/windows/win32/direct3ddds

// Reads the blocks of a picture from a DDS file in memory that holds nothing else.
using ReadBlocks = std::function<Image(std::span<const std::byte> dds)>;

// Nothing where the file is no cube map and of another kind, which OpenImageIO may know. Throws Error, with `name` as
// its subject.
std::optional<LoadedImage> decode_dds(std::span<const std::byte> bytes, const std::string& name,
                                      std::uint64_t max_pixels, const ReadBlocks& read_blocks);

}  // namespace shlight
