#include <bit>
#include <cstring>
#include <span>

#include "shlight/transfer/sobol.h"
#include "shlight/transfer/transfer.h"

namespace shlight {
namespace {

// To be counted up where the same scene and params come to give other coefficients.
constexpr std::uint64_t kVersion = 3;

class Hash {
 public:
  void add(std::uint64_t v) { value_ = mix_bits(value_ ^ v); }
  void add(float v) { add(std::uint64_t{std::bit_cast<std::uint32_t>(v)}); }
  void add(Vec3f v) { add(v.x), add(v.y), add(v.z); }
  template <class T>
  void add(std::span<const T> values) {
    add(std::uint64_t{values.size()});
    const std::span<const std::byte> bytes = std::as_bytes(values);
    for (std::size_t i = 0; i < bytes.size(); i += sizeof(std::uint64_t)) {
      std::uint64_t word = 0;
      std::memcpy(&word, bytes.data() + i, std::min(sizeof(word), bytes.size() - i));
      add(word);
    }
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = kVersion;
};

}  // namespace

std::uint64_t hash_bake(const Scene& scene, const BakeParams& params) {
  Hash hash;
  hash.add(static_cast<std::uint64_t>(params.kind));
  hash.add(static_cast<std::uint64_t>(params.method));
  hash.add(static_cast<std::uint64_t>(params.bands));
  hash.add(static_cast<std::uint64_t>(params.samples));
  hash.add(params.error);
  hash.add(static_cast<std::uint64_t>(params.bounces));
  hash.add(params.seed);

  hash.add(std::uint64_t{scene.meshes.size()});
  for (const Mesh& mesh : scene.meshes) {
    hash.add(std::span(mesh.positions));
    hash.add(std::span(mesh.normals));
    hash.add(std::span(mesh.texcoords));
    hash.add(std::span(mesh.colors));
    hash.add(std::span(mesh.indices));
    hash.add(std::uint64_t{mesh.material});
  }
  hash.add(std::uint64_t{scene.instances.size()});
  for (const Instance& instance : scene.instances) {
    hash.add(std::uint64_t{instance.mesh});
    hash.add(std::span<const float>(instance.to_world));
  }
  hash.add(std::uint64_t{scene.materials.size()});
  for (const Material& material : scene.materials) {
    hash.add(material.base_color);
    hash.add(material.texture ? std::uint64_t{*material.texture} + 1 : 0);
  }
  hash.add(std::uint64_t{scene.textures.size()});
  for (const Image8& texture : scene.textures) {
    hash.add(static_cast<std::uint64_t>(texture.width));
    hash.add(static_cast<std::uint64_t>(texture.height));
    hash.add(std::span(texture.values));
  }
  return hash.value();
}

}  // namespace shlight
