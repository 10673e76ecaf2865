// The bytes are the scene's fields in their order in ParsedScene and its parts. Both sides are the same program, so
// there is no version and no byte order.

#include <algorithm>

#include "shlight/core/byte_stream.h"
#include "shlight/core/error.h"
#include "shlight/scene/parsed_scene.h"

namespace shlight {
namespace {

// The one description of the layout, for both directions: `Io` is ByteWriter with const things, or
// ByteReader.
template <class Io, class SceneType>
void pass_scene(Io& io, SceneType& scene) {
  io.list(scene.meshes, [&](auto& mesh) {
    io.text(mesh.name);
    io.list(mesh.positions);
    io.list(mesh.normals);
    io.list(mesh.texcoords);
    io.list(mesh.colors);
    io.list(mesh.indices);
    io.field(mesh.material);
  });
  io.list(scene.instances);
  io.list(scene.materials, [&](auto& material) {
    io.text(material.name);
    io.field(material.base_color.x);
    io.field(material.base_color.y);
    io.field(material.base_color.z);
    std::uint8_t textured = material.texture.has_value();
    std::uint32_t texture = material.texture.value_or(0);
    io.field(textured);
    io.field(texture);
    std::uint8_t glossy = material.gloss.has_value();
    MetallicRoughness gloss = material.gloss.value_or(MetallicRoughness{});
    io.field(glossy);
    io.field(gloss.metallic);
    io.field(gloss.roughness);
    if constexpr (Io::kIsReader) {
      if (textured) material.texture = texture;
      if (glossy) material.gloss = gloss;
    }
  });
  io.list(scene.textures, [&](auto& texture) {
    io.text(texture.name);
    io.field(texture.texels.width);
    io.field(texture.texels.height);
    io.list(texture.texels.values);
    io.list(texture.file_bytes);
  });
  io.list(scene.warnings, [&](auto& warning) { io.text(warning); });
}

bool is_valid(const Mesh& mesh, const ParsedScene& scene) {
  const std::size_t n = mesh.positions.size();
  const auto fits = [&](std::size_t size) { return size == 0 || size == n; };
  return fits(mesh.normals.size()) && fits(mesh.texcoords.size()) && fits(mesh.colors.size()) &&
         mesh.indices.size() % 3 == 0 && mesh.material < scene.materials.size() &&
         std::ranges::all_of(mesh.indices, [&](std::uint32_t i) { return i < n; });
}

bool is_valid(const Image8& texels) {
  if (texels.width < 0 || texels.height < 0) return false;
  // Neither product can overflow: both factors are below 2^31, and the second is compared by division.
  const std::uint64_t pixels = static_cast<std::uint64_t>(texels.width) * static_cast<std::uint64_t>(texels.height);
  return texels.values.size() % 4 == 0 && texels.values.size() / 4 == pixels;
}

bool is_valid(const ParsedScene& scene) {
  return std::ranges::all_of(scene.meshes, [&](const Mesh& mesh) { return is_valid(mesh, scene); }) &&
         std::ranges::all_of(scene.instances, [&](const Instance& i) { return i.mesh < scene.meshes.size(); }) &&
         std::ranges::all_of(scene.materials,
                             [&](const Material& m) { return !m.texture || *m.texture < scene.textures.size(); }) &&
         std::ranges::all_of(scene.textures, [](const ParsedTexture& t) { return is_valid(t.texels); });
}

}  // namespace

void write_parsed_scene(const ParsedScene& scene, FencedBytes& bytes) {
  ByteWriter writer(bytes);
  pass_scene(writer, scene);
}

ParsedScene read_parsed_scene(std::span<const std::byte> bytes, std::string_view subject, std::string_view accepted) {
  try {
    ParsedScene scene;
    ByteReader reader(bytes);
    pass_scene(reader, scene);
    if (reader.at_end() && is_valid(scene)) return scene;
  } catch (const ByteReader::Malformed&) {
  }
  throw Error(subject, "is malformed (it refers to what it does not hold)", accepted);
}

}  // namespace shlight
