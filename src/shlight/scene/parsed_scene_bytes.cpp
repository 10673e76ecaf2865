// The bytes are the scene's fields in their order in ParsedScene and its parts: numbers as the machine has them, a list
// as its length and its items. Both sides are the same program, so there is no version and no byte order.

#include <algorithm>
#include <concepts>
#include <cstring>
#include <type_traits>

#include "shlight/core/error.h"
#include "shlight/scene/parsed_scene.h"

namespace shlight {
namespace {

struct Malformed {};

class Writer {
 public:
  explicit Writer(FencedBytes& bytes) : bytes_(bytes) {}

  template <class T>
  requires std::is_arithmetic_v<T>
  void field(const T& value) { bytes_.append(std::as_bytes(std::span(&value, 1))); }
  // Of items without pointers: all at once.
  template <class T>
  requires std::is_trivially_copyable_v<T>
  void list(const std::vector<T>& items) {
    field(std::uint64_t{items.size()});
    bytes_.append(std::as_bytes(std::span(items)));
  }
  void text(const std::string& text) {
    field(std::uint64_t{text.size()});
    bytes_.append(std::as_bytes(std::span(text)));
  }
  template <class T, class EachItem>
  void list(const std::vector<T>& items, EachItem&& each) {
    field(std::uint64_t{items.size()});
    for (const T& item : items) each(item);
  }

 private:
  FencedBytes& bytes_;
};

// The same verbs the other way round; throws Malformed where the bytes end too early.
class Reader {
 public:
  explicit Reader(std::span<const std::byte> bytes) : left_(bytes) {}

  template <class T>
  requires std::is_arithmetic_v<T>
  void field(T& value) { std::memcpy(&value, take(sizeof(T)).data(), sizeof(T)); }
  template <class T>
  requires std::is_trivially_copyable_v<T>
  void list(std::vector<T>& items) {
    items.resize(count(sizeof(T)));
    const auto bytes = take(items.size() * sizeof(T));
    if (!bytes.empty()) std::memcpy(items.data(), bytes.data(), bytes.size());
  }
  void text(std::string& text) {
    const auto bytes = take(count(1));
    text.assign(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  }
  template <class T, class EachItem>
  void list(std::vector<T>& items, EachItem&& each) {
    // One by one, so that a false length ends with the bytes and not with the memory.
    const std::size_t size = count(1);
    for (std::size_t i = 0; i < size; ++i) each(items.emplace_back());
  }
  bool at_end() const { return left_.empty(); }

 private:
  // A length of items of `item_bytes` bytes at least, all of which must be there.
  std::size_t count(std::size_t item_bytes) {
    std::uint64_t count = 0;
    field(count);
    if (count > left_.size() / item_bytes) throw Malformed{};
    return count;
  }
  std::span<const std::byte> take(std::size_t size) {
    if (size > left_.size()) throw Malformed{};
    const auto taken = left_.first(size);
    left_ = left_.subspan(size);
    return taken;
  }

  std::span<const std::byte> left_;
};

// The one description of the layout, for both directions: `Io` is Writer with const things, or Reader.
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
    if constexpr (std::same_as<Io, Reader>) {
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
  Writer writer(bytes);
  pass_scene(writer, scene);
}

ParsedScene read_parsed_scene(std::span<const std::byte> bytes, std::string_view subject, std::string_view accepted) {
  try {
    ParsedScene scene;
    Reader reader(bytes);
    pass_scene(reader, scene);
    if (reader.at_end() && is_valid(scene)) return scene;
  } catch (const Malformed&) {
  }
  throw Error(subject, "is malformed (it refers to what it does not hold)", accepted);
}

}  // namespace shlight
