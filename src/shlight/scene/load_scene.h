#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

#include "shlight/core/fence.h"
#include "shlight/scene/scene.h"

namespace shlight {

struct LoadSceneParams {
  std::uint64_t max_file_bytes = 4ull << 30;
  float crease_degrees = 60;  // where a file has no normals: edges sharper than this stay sharp
  FenceLimits fence;          // files are parsed in a process of their own
};

// Reads a model or scene of any format that assimp knows (.x text, binary and bzip'd, .obj, .ply, .stl, .off, .gltf,
// .glb, …) with its materials, textures and world matrices. Missing normals are made, degenerate triangles and bad
// values left out with a warning. Throws Error where nothing is left to draw.
Scene load_scene(const std::filesystem::path& path, const LoadSceneParams& params = {});

// `model` is a path, or builtin:sphere, builtin:knot, builtin:scene. Throws Error, which lists the built-in names.
Scene make_scene(std::string_view model, const LoadSceneParams& params = {});

}  // namespace shlight
