#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <utility>

#include "shlight/core/assert.h"
#include "shlight/core/error.h"
#include "shlight/core/file.h"
#include "shlight/image/image_io.h"
#include "shlight/sh/coefficients.h"
#include "shlight/transfer/baked_format.h"
#include "shlight/transfer/glb.h"
#include "shlight/transfer/gltf_nodes.h"
#include "shlight/transfer/quantise.h"

namespace shlight {
namespace {

using nlohmann::ordered_json;

ordered_json json_of(Vec3f v) {
  return {v.x, v.y, v.z};
}
ordered_json json_of(Vec3d v) {
  return {v.x, v.y, v.z};
}

// With braces alone, a list of one thing may be taken for the thing.
ordered_json list_of(ordered_json item) {
  return ordered_json::array({std::move(item)});
}

// The bytes of buffer 0, with what says where each row of them lies: a view and an accessor of its own.
class Rows {
 public:
  std::size_t add_view(std::span<const std::byte> bytes, int target = 0) {
    binary.resize((binary.size() + 3) / 4 * 4);
    ordered_json view = {{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", bytes.size()}};
    if (target != 0) view["target"] = target;
    views.push_back(std::move(view));
    binary.insert(binary.end(), bytes.begin(), bytes.end());
    return views.size() - 1;
  }

  template <class T>
  std::size_t add(std::span<const T> values, const char* type, int component_type = kGltfFloat,
                  int target = kGltfArrayBuffer) {
    accessors.push_back({{"bufferView", add_view(std::as_bytes(values), target)},
                         {"componentType", component_type},
                         {"count", values.size()},
                         {"type", type}});
    return accessors.size() - 1;
  }

  ordered_json views = ordered_json::array(), accessors = ordered_json::array();
  std::vector<std::byte> binary;
};

// Positions alone must have their bounds told.
std::size_t add_positions(Rows& rows, const std::vector<Vec3f>& positions) {
  const std::size_t accessor = rows.add(std::span(positions), "VEC3");
  Vec3f low = positions[0], high = positions[0];
  for (const Vec3f p : positions) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  rows.accessors[accessor]["min"] = json_of(low);
  rows.accessors[accessor]["max"] = json_of(high);
  return accessor;
}

// What all instances of a mesh have in common. Meshes that no instance shows are left out.
struct SharedMesh {
  ordered_json attributes;
  std::size_t indices = 0;
};
std::map<std::uint32_t, SharedMesh> add_meshes(Rows& rows, const Scene& scene, const std::string& name) {
  std::map<std::uint32_t, SharedMesh> shared;
  for (const Instance& instance : scene.instances) shared[instance.mesh];
  for (auto& [index, entry] : shared) {
    const Mesh& mesh = scene.meshes[index];
    if (mesh.indices.empty()) throw Error(name, fmt::format("mesh {} has no triangles", index), "meshes to draw");
    entry.attributes["POSITION"] = add_positions(rows, mesh.positions);
    entry.attributes["NORMAL"] = rows.add(std::span(mesh.normals), "VEC3");
    if (!mesh.texcoords.empty()) entry.attributes["TEXCOORD_0"] = rows.add(std::span(mesh.texcoords), "VEC2");
    if (!mesh.colors.empty()) entry.attributes["COLOR_0"] = rows.add(std::span(mesh.colors), "VEC3");
    entry.indices = rows.add(std::span(mesh.indices), "SCALAR", kGltfUnsignedInt, kGltfElementBuffer);
  }
  return shared;
}

// How a coefficient lies in the file: as Number, made of it by `encode` with its scale.
template <class Number, class Encode>
void add_transfer(Rows& rows, const Transfer& transfer, std::span<const float> scales, std::size_t instance,
                  int component_type, ordered_json& attributes, Encode&& encode) {
  const std::size_t first = transfer.first_vertex[instance];
  const std::size_t count = transfer.first_vertex[instance + 1] - first;
  const auto n = static_cast<std::size_t>(num_coefficients(transfer.bands));
  const auto channels = static_cast<std::size_t>(transfer.channels);
  std::vector<std::array<Number, 4>> row(count);
  for (int c = 0; c < transfer.channels; ++c)
    for (int k = 0; k < num_transfer_attributes(transfer.bands); ++k) {
      const auto from = 4 * static_cast<std::size_t>(k), size = std::min<std::size_t>(4, n - from);
      for (std::size_t v = 0; v < count; ++v) {
        const float* a = &transfer.coefficients[((first + v) * channels + static_cast<std::size_t>(c)) * n + from];
        row[v] = {};
        for (std::size_t i = 0; i < size; ++i)
          row[v][i] = encode(a[i], scales[static_cast<std::size_t>(c) * n + from + i]);
      }
      attributes[transfer_attribute(transfer.channels, c, k)] =
          rows.add(std::span(std::as_const(row)), "VEC4", component_type);
      if (component_type != kGltfFloat) rows.accessors.back()["normalized"] = true;
    }
}

void add_transfer(Rows& rows, const Transfer& transfer, int bits, std::span<const float> scales, std::size_t instance,
                  ordered_json& attributes) {
  const auto encode = [bits](float a, float scale) { return quantise(a, scale, bits); };
  if (bits == 8)
    add_transfer<std::int8_t>(rows, transfer, scales, instance, kGltfByte, attributes,
                              [&](float a, float scale) { return static_cast<std::int8_t>(encode(a, scale)); });
  else if (bits == 16)
    add_transfer<std::int16_t>(rows, transfer, scales, instance, kGltfShort, attributes,
                               [&](float a, float scale) { return static_cast<std::int16_t>(encode(a, scale)); });
  else
    add_transfer<float>(rows, transfer, scales, instance, kGltfFloat, attributes, [](float a, float) { return a; });
}

// Clusters and weights of an instance's vertices, as whole numbers.
void add_pca_codes(Rows& rows, const Transfer& transfer, const ClusteredPca& pca, std::size_t instance,
                   ordered_json& attributes) {
  const std::size_t first = transfer.first_vertex[instance], n = pca.rows_per_cluster();
  std::vector<std::array<std::int16_t, 4>> row(transfer.first_vertex[instance + 1] - first);
  for (int k = 0; k < num_pca_attributes(pca.components); ++k) {
    const auto from = 4 * static_cast<std::size_t>(k), size = std::min<std::size_t>(4, n - from);
    std::ranges::fill(row, std::array<std::int16_t, 4>{});
    for (std::size_t v = 0; v < row.size(); ++v) std::copy_n(&pca.codes[(first + v) * n + from], size, row[v].begin());
    attributes[pca_attribute(k)] = rows.add(std::span(std::as_const(row)), "VEC4", kGltfShort);
  }
}

void add_openness(Rows& rows, const Transfer& transfer, std::size_t instance, ordered_json& attributes) {
  const std::size_t first = transfer.first_vertex[instance];
  const std::size_t count = transfer.first_vertex[instance + 1] - first;
  attributes[kOcclusionAttribute] = rows.add(std::span(transfer.ambient_occlusion).subspan(first, count), "SCALAR");
  attributes[kBentNormalAttribute] = rows.add(std::span(transfer.bent_normals).subspan(first, count), "VEC3");
}

ordered_json json_of(const Material& material, bool textured) {
  const Vec3f c = material.base_color;
  const MetallicRoughness gloss = material.gloss.value_or(MetallicRoughness{});
  ordered_json surface = {{"baseColorFactor", {c.x, c.y, c.z, 1}},
                          {"metallicFactor", gloss.metallic},
                          {"roughnessFactor", gloss.roughness}};
  if (textured && material.texture) surface["baseColorTexture"] = {{"index", *material.texture}};
  // Both sides are drawn here too.
  ordered_json json = {{"name", material.name}, {"pbrMetallicRoughness", surface}, {"doubleSided", true}};
  // glTF's surfaces have a highlight however rough they are, unless they say that they have none.
  if (!material.gloss) json["extensions"] = {{kSpecularExtension, {{"specularFactor", 0}}}};
  return json;
}

// A primitive without texture coordinates must not have a textured material [1, section 3.9.2]: it gets a twin of it.
class Materials {
 public:
  explicit Materials(const Scene& scene) : scene_(scene) {
    for (const Material& material : scene.materials) json.push_back(json_of(material, true));
  }
  std::size_t index_for(const Mesh& mesh) {
    const Material& material = scene_.materials[mesh.material];
    if (!material.texture || !mesh.texcoords.empty()) return mesh.material;
    const auto [twin, is_new] = twins_.try_emplace(mesh.material, json.size());
    if (is_new) {
      json.push_back(json_of(material, false));
      json.back()["extras"] = {{"shlight", {{"twin_of", mesh.material}}}};
    }
    return twin->second;
  }
  ordered_json json = ordered_json::array();

 private:
  const Scene& scene_;
  std::map<std::uint32_t, std::size_t> twins_;
};

// Adds the node of an instance, or two where one cannot say its matrix; then the outer one has it in its extras, where
// it keeps its bits. Returns the outer one's index.
std::size_t add_node(ordered_json& nodes, const Mat4f& to_world, std::size_t mesh) {
  ordered_json node = {{"mesh", mesh}};
  if (is_trs(to_world)) {
    // Viewers are told when a matrix is there for nothing.
    if (to_world != kIdentity) {
      node["matrix"] = to_world;
      for (const int row : {3, 7, 11}) node["matrix"][row] = 0;
      node["matrix"][15] = 1;
    }
    nodes.push_back(std::move(node));
    return nodes.size() - 1;
  }
  const auto [outer, inner] = split_into_trs(to_world);
  node["rotation"] = inner.rotation;
  nodes.push_back(std::move(node));
  nodes.push_back({{"translation", json_of(outer.translation)},
                   {"rotation", outer.rotation},
                   {"scale", json_of(outer.scale)},
                   {"children", list_of(nodes.size() - 1)},
                   {"extras", {{"shlight", {{"to_world", to_world}}}}}});
  return nodes.size() - 1;
}

// What all vertices' numbers are decoded with.
ordered_json add_decoding(Rows& rows, const Transfer& transfer, const BakeInfo& info) {
  if (info.pca)
    return {{"clusters", info.pca->clusters},
            {"components", info.pca->components},
            {"table", rows.add(std::span(info.pca->table), "SCALAR", kGltfFloat, 0)}};
  return info.bits == 32 ? std::vector<float>() : quantisation_scales(transfer);
}

ordered_json json_of(const Transfer& transfer, const BakeInfo& info, const ordered_json& decoding) {
  const BakeParams& params = info.params;
  return {{"version", kBakedVersion},
          {"checksum", kEmptyChecksum},
          {"kind", to_text(transfer.kind)},
          {"bands", transfer.bands},
          {"channels", transfer.channels},
          {"bits", info.bits},
          {info.pca ? "pca" : "scales", decoding},
          {"hash", fmt::format("{:016x}", transfer.hash)},
          {"rays", transfer.rays},
          {"estimated_error", transfer.estimated_error},
          {"settings",
           {{"method", to_text(params.method)},
            {"samples", params.samples},
            {"error", params.error},
            {"bounces", params.bounces},
            {"seed", params.seed}}},
          {"convention", baked_convention()},
          {"model", info.model}};
}

// Without assertions there is nothing to do.
void check_fits([[maybe_unused]] const Scene& scene, [[maybe_unused]] const Transfer& transfer) {
  SHLIGHT_ASSERT_EQ(transfer.first_vertex.size(), scene.instances.size() + 1);
  for (std::size_t i = 0; i < scene.instances.size(); ++i)
    SHLIGHT_ASSERT_EQ(transfer.first_vertex[i] + scene.meshes[scene.instances[i].mesh].positions.size(),
                      transfer.first_vertex[i + 1]);
  SHLIGHT_ASSERT_EQ(transfer.first_vertex.back(), transfer.num_vertices());
  SHLIGHT_ASSERT_EQ(transfer.bent_normals.size(), transfer.num_vertices());
  SHLIGHT_ASSERT_EQ(
      transfer.coefficients.size(),
      transfer.num_vertices() * static_cast<std::size_t>(transfer.channels * num_coefficients(transfer.bands)));
}

}  // namespace

std::vector<std::byte> format_baked(const Scene& scene, const Transfer& transfer, const BakeInfo& info,
                                    const std::string& name) {
  check_fits(scene, transfer);
  SHLIGHT_ASSERT_EQ(is_transfer_bits(info.bits), true);
  if (info.pca) {
    SHLIGHT_ASSERT_EQ(info.bits, 16);
    SHLIGHT_ASSERT_EQ(info.pca->num_vertices(), transfer.num_vertices());
    SHLIGHT_ASSERT_EQ(info.pca->row_size() * transfer.num_vertices(), transfer.coefficients.size());
  }
  const std::vector<float> scales = quantisation_scales(transfer);
  if (scene.instances.empty()) throw Error(name, "would hold no instances", "a scene that shows something");
  Rows rows;
  Materials materials(scene);
  std::map<std::uint32_t, SharedMesh> shared = add_meshes(rows, scene, name);
  ordered_json meshes = ordered_json::array(), nodes = ordered_json::array(), roots = ordered_json::array();
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    const Mesh& mesh = scene.meshes[instance.mesh];
    ordered_json attributes = shared[instance.mesh].attributes;
    if (info.pca)
      add_pca_codes(rows, transfer, *info.pca, i, attributes);
    else
      add_transfer(rows, transfer, info.bits, scales, i, attributes);
    add_openness(rows, transfer, i, attributes);
    meshes.push_back({{"name", mesh.name},
                      {"primitives", list_of({{"attributes", attributes},
                                              {"indices", shared[instance.mesh].indices},
                                              {"material", materials.index_for(mesh)}})}});
    roots.push_back(add_node(nodes, instance.to_world, i));
  }

  const ordered_json decoding = add_decoding(rows, transfer, info);
  ordered_json root = {
      {"asset",
       {{"extras", {{"shlight", json_of(transfer, info, decoding)}}}, {"generator", "shlight"}, {"version", "2.0"}}},
      {"scene", 0},
      {"scenes", list_of({{"nodes", roots}})},
      {"nodes", std::move(nodes)},
      {"meshes", std::move(meshes)},
      {"materials", std::move(materials.json)}};
  if (!std::ranges::all_of(scene.materials, [](const Material& material) { return material.gloss.has_value(); }))
    root["extensionsUsed"] = list_of(kSpecularExtension);
  for (std::size_t i = 0; i < scene.textures.size(); ++i) {
    const auto png = encode_png(scene.textures[i], fmt::format("{}: texture {}", name, i));
    root["textures"].push_back({{"source", i}});
    root["images"].push_back({{"bufferView", rows.add_view(png)}, {"mimeType", "image/png"}});
  }
  root["accessors"] = std::move(rows.accessors);
  root["bufferViews"] = std::move(rows.views);
  root["buffers"] = list_of({{"byteLength", rows.binary.size()}});
  return make_glb(root.dump(-1, ' ', false, ordered_json::error_handler_t::replace), rows.binary, name);
}

void save_baked(const std::filesystem::path& path, const Scene& scene, const Transfer& transfer, const BakeInfo& info) {
  write_file(path, format_baked(scene, transfer, info, path.string()));
}

}  // namespace shlight
