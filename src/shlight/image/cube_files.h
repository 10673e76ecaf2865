#pragma once

#include <array>
#include <filesystem>
#include <optional>

#include "shlight/image/image_io.h"

// Cube maps as six files, in the sequence of Layout::kCube. Their names end in
//
//     px nx py ny pz nz     posx negx posy negy posz negz     right left top bottom front back     right left up down …
//
// after nothing or a character that is no letter or digit: "px.hdr", "sky_negy.exr", "Harbour-Front.hdr".

namespace shlight {

using CubeFiles = std::array<std::filesystem::path, 6>;

// The six files that a path means: that of any one of them, or of a folder that holds one such cube. Nothing where the
// path is that of a file whose name is not a face's, or that has no other face beside it. Throws Error where some are
// missing, or where a folder holds none or several cubes.
std::optional<CubeFiles> find_cube_files(const std::filesystem::path& path);

// The six faces as one picture. Each file is one square face; the limit on pixels is for all together. Throws Error.
LoadedImage load_cube_files(const CubeFiles& files, const LoadImageParams& params = {});

// What six files to write for a name: "sky.exr" means "sky_px.exr", "sky_nx.exr", …
CubeFiles cube_files_for(const std::filesystem::path& path);

// The faces of a picture in Layout::kCube, in that sequence.
std::array<Image, 6> split_cube(const Image& cube);

}  // namespace shlight
