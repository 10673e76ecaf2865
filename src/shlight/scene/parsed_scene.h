#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shlight/core/fence.h"
#include "shlight/scene/scene.h"

namespace shlight {

// A picture that a model names or holds: as texels, as the bytes of a picture file, or else as the name of a file.
struct ParsedTexture {
  std::string name;
  Image8 texels;
  std::vector<std::byte> file_bytes;
};

// What a model file says, as it says it: positions may be NaN, normals missing, triangles without area, matrices may
// mirror. Only its references and lengths hold: every index is below the length of what it points into, a mesh's
// normals, texcoords and colors are none or as many as its positions. Material::texture points into `textures`, not
// into a Scene's.
struct ParsedScene {
  std::vector<Mesh> meshes;
  std::vector<Instance> instances;
  std::vector<Material> materials;
  std::vector<ParsedTexture> textures;
  std::vector<std::string> warnings;
};

// How a scene passes the fence: appended to `bytes` on one side, read on the other. Whatever the bytes, reading them
// either gives a scene whose references and lengths hold or throws Error, with `subject` and `accepted` as run_fenced
// has them.
void write_parsed_scene(const ParsedScene& scene, FencedBytes& bytes);
ParsedScene read_parsed_scene(std::span<const std::byte> bytes, std::string_view subject, std::string_view accepted);

// Parses a model file with assimp; to be called inside a fence. Polygons come out as triangles; points and lines are
// left out with a warning. Colours come out linear: those of glTF are linear by its specification, those of all other
// formats are taken to be sRGB-encoded, as the tools that write them mean them. Throws Error.
ParsedScene parse_scene(const std::filesystem::path& path, std::string_view accepted);

}  // namespace shlight
