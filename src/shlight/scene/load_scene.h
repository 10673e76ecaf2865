#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

#include "shlight/core/fence.h"
#include "shlight/scene/scene.h"

namespace shlight {

struct LoadSceneParams {
  std::uint64_t max_file_bytes = 4ull << 30;
  std::uint64_t max_triangles = 1ull << 28;  // as drawn, every instance counted
  float crease_degrees = 60;                 // where a file has no normals: edges sharper than this stay sharp
  FenceLimits fence;                         // files are parsed in a process of their own
};

// Reads a model or scene of any format that assimp knows (.x text, binary and bzip'd, .obj, .ply, .stl, .off, .gltf,
// .glb, …) with its materials, textures and world matrices, skinned and animated ones as they stand in the file.
// - Colours: glTF's are linear; those of other formats are taken to be sRGB-encoded and made linear.
// - What cannot be drawn (triangles without area or with NaN in them, points, lines) is left out, and what is missing
// or
//   bad (normals, colours, textures) is made, each with a line in Scene::warnings. STL's normals, one a triangle, count
//   as missing.
// - Matrices come out with positive determinants: an instance that mirrors its mesh gets a mirrored copy of it.
// - Textures and other parts are read only from the model's own folder and below.
// Throws Error where the file cannot be read or nothing is left to draw.
Scene load_scene(const std::filesystem::path& path, const LoadSceneParams& params = {});

// `model` is a path, or builtin:sphere, builtin:knot, builtin:scene. Throws Error, which lists the built-in names.
Scene make_scene(std::string_view model, const LoadSceneParams& params = {});

// Whether make_scene knows the built-in model of that name.
bool is_builtin_scene(std::string_view model);

// Whether a file's ending is one of a model format.
bool is_model_file(const std::filesystem::path& path);

}  // namespace shlight
