// What a stranger may have written is read with these rules: every number is checked before it is used; bytes of the
// binary chunk are handed out no more often than there are, so that a short file cannot ask for much memory; and
// nothing but numbers is repeated in errors.

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

#include "shlight/core/error.h"
#include "shlight/core/file.h"
#include "shlight/image/image_io.h"
#include "shlight/scene/transform.h"
#include "shlight/sh/coefficients.h"
#include "shlight/transfer/baked_format.h"
#include "shlight/transfer/glb.h"
#include "shlight/transfer/quantise.h"

namespace shlight {
namespace {

using nlohmann::json;

// Deeper than save_baked ever nests.
constexpr int kMaxDepth = 16;
constexpr std::size_t kMaxJsonBytes = 256 << 20;

class Reader {
 public:
  Reader(const json& root, std::span<const std::byte> binary, const std::string& name)
      : root_(root), binary_(binary), bytes_left_(binary.size()), name_(name) {}

  [[noreturn]] void fail(const std::string& wrong) const {
    throw Error(name_, "is malformed: " + wrong, kAcceptedBaked);
  }

  // The member of an object, which must be there.
  const json& member(const json& object, const char* key) const {
    const auto found = object.find(key);
    if (!object.is_object() || found == object.end()) fail(fmt::format("{} is missing", key));
    return *found;
  }
  std::uint64_t whole(const json& object, const char* key, std::uint64_t low, std::uint64_t high) const {
    return as_whole(member(object, key), key, low, high);
  }
  std::uint64_t as_whole(const json& value, std::string_view what, std::uint64_t low, std::uint64_t high) const {
    if (!value.is_number_unsigned()) fail(fmt::format("{} is no whole number", what));
    const auto number = value.get<std::uint64_t>();
    if (number < low || number > high) fail(fmt::format("{} is {} and not {} to {}", what, number, low, high));
    return number;
  }
  double number(const json& value, std::string_view what) const {
    // Compared as it is false for NaN, which JSON cannot say anyway.
    const double number = value.is_number() ? value.get<double>() : std::nan("");
    if (!(std::abs(number) <= std::numeric_limits<float>::max())) fail(fmt::format("{} is no number", what));
    return number;
  }
  std::string text(const json& object, const char* key) const {
    const json& value = member(object, key);
    if (!value.is_string()) fail(fmt::format("{} is no text", key));
    return value.get<std::string>();
  }
  // 64 bits in hexadecimal.
  std::uint64_t hexadecimal(const json& object, const char* key) const {
    const std::string digits = text(object, key);
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
    if (digits.size() != 16 || error != std::errc() || end != digits.data() + digits.size())
      fail(fmt::format("{} is not of 16 hexadecimal digits", key));
    return value;
  }
  // An array of the root by its name; empty where it is not there.
  const json& list(const char* key) const {
    static const json empty = json::array();
    const auto found = root_.find(key);
    if (found == root_.end()) return empty;
    if (!found->is_array()) fail(fmt::format("{} is no list", key));
    return *found;
  }
  // What an index stands for.
  std::size_t index(const json& value, const char* list_name) const {
    const std::size_t size = list(list_name).size();
    if (size == 0) fail(fmt::format("{} are missing", list_name));
    return as_whole(value, fmt::format("an index into {}", list_name), 0, size - 1);
  }
  const json& item(const json& index_value, const char* list_name) const {
    return list(list_name)[index(index_value, list_name)];
  }

  // Bytes that nobody had yet.
  std::span<const std::byte> take_view(const json& index_value) {
    const json& view = item(index_value, "bufferViews");
    whole(view, "buffer", 0, 0);
    if (view.contains("byteStride")) fail("a byteStride");
    const std::uint64_t offset = view.contains("byteOffset") ? whole(view, "byteOffset", 0, binary_.size()) : 0;
    const std::uint64_t size = whole(view, "byteLength", 1, binary_.size() - std::min(offset, binary_.size()));
    if (size > bytes_left_) fail("parts of it are used more than once");
    bytes_left_ -= size;
    return binary_.subspan(offset, size);
  }

  // Before memory is taken for what so many bytes are to fill.
  void expect_left(std::uint64_t bytes) const {
    if (bytes > bytes_left_) fail(fmt::format("{} bytes are to come, and {} are left", bytes, bytes_left_));
  }

  // The values of an accessor, all finite where they are floats. T is what one of `type` lies in memory as.
  template <class T>
  std::vector<T> take(const json& index_value, std::string_view type, int component_type = kGltfFloat,
                      bool normalized = false) {
    const json& accessor = item(index_value, "accessors");
    if (text(accessor, "type") != type) fail(fmt::format("an accessor that is no {}", type));
    whole(accessor, "componentType", component_type, component_type);
    if (accessor.contains("sparse") || accessor.contains("byteOffset"))
      fail("an accessor that is sparse or has a byteOffset");
    if (accessor.contains("normalized") ? accessor["normalized"] != normalized : normalized)
      fail("an accessor that is normalized, or is not");
    const auto bytes = take_view(member(accessor, "bufferView"));
    const std::uint64_t count = whole(accessor, "count", 1, bytes.size() / sizeof(T));
    if (bytes.size() != count * sizeof(T)) fail("an accessor that is shorter than its bufferView");
    std::vector<T> values(count);
    std::memcpy(values.data(), bytes.data(), bytes.size());
    if (component_type == kGltfFloat)
      for (std::size_t i = 0; i < bytes.size(); i += sizeof(float)) {
        float value = 0;
        std::memcpy(&value, bytes.data() + i, sizeof(value));
        if (!std::isfinite(value)) fail(fmt::format("a value that is not finite, of {}", type));
      }
    return values;
  }
  template <class T>
  std::vector<T> take_rows(const json& attributes, const char* key, std::string_view type, std::size_t vertices,
                           int component_type = kGltfFloat, bool normalized = false) {
    std::vector<T> values = take<T>(member(attributes, key), type, component_type, normalized);
    if (values.size() != vertices) fail(fmt::format("{} {} for {} vertices", values.size(), key, vertices));
    return values;
  }

 private:
  const json& root_;
  std::span<const std::byte> binary_;
  std::uint64_t bytes_left_;
  std::string name_;
};

Mat4f read_matrix(const Reader& reader, const json& values) {
  if (!values.is_array() || values.size() != 16) reader.fail("a matrix that is none");
  Mat4f m;
  for (std::size_t i = 0; i < m.size(); ++i) m[i] = static_cast<float>(reader.number(values[i], "part of a matrix"));
  if (!(determinant(m) > 0)) reader.fail("a matrix that flattens or mirrors");
  return m;
}

// A node of the scene: where it puts which glTF mesh.
struct Placed {
  Mat4f to_world = kIdentity;
  std::size_t mesh = 0;
};
Placed read_node(const Reader& reader, const json& node) {
  Placed placed;
  if (node.contains("children")) {
    const json& children = reader.member(node, "children");
    if (!children.is_array() || children.size() != 1) reader.fail("a node with other than one child");
    placed.to_world =
        read_matrix(reader, reader.member(reader.member(reader.member(node, "extras"), "shlight"), "to_world"));
    placed.mesh = reader.index(reader.member(reader.item(children[0], "nodes"), "mesh"), "meshes");
  } else {
    if (node.contains("matrix")) placed.to_world = read_matrix(reader, node["matrix"]);
    placed.mesh = reader.index(reader.member(node, "mesh"), "meshes");
  }
  return placed;
}

const json& primitive_of(const Reader& reader, std::size_t mesh) {
  const json& primitives = reader.member(reader.list("meshes")[mesh], "primitives");
  if (!primitives.is_array() || primitives.size() != 1) reader.fail("a mesh with other than one primitive");
  return primitives[0];
}

// A number that is a share of something.
float read_share(const Reader& reader, const json& value, std::string_view what) {
  const auto share = static_cast<float>(reader.number(value, what));
  if (share < 0 || share > 1) reader.fail(fmt::format("a {} outside of 0 to 1", what));
  return share;
}

// Materials, and which of them each of the file's is: twins without texture are the same material here.
std::vector<std::uint32_t> read_materials(const Reader& reader, Scene& scene) {
  std::vector<std::uint32_t> indices;
  for (const json& source : reader.list("materials")) {
    if (source.contains("extras")) {
      const json& extras = reader.member(reader.member(source, "extras"), "shlight");
      if (scene.materials.empty()) reader.fail("a twin of no material");
      indices.push_back(static_cast<std::uint32_t>(reader.whole(extras, "twin_of", 0, scene.materials.size() - 1)));
      continue;
    }
    Material material;
    material.name = reader.text(source, "name");
    const json& surface = reader.member(source, "pbrMetallicRoughness");
    const json& color = reader.member(surface, "baseColorFactor");
    if (!color.is_array() || color.size() != 4) reader.fail("a baseColorFactor that is none");
    float* const channels[] = {&material.base_color.x, &material.base_color.y, &material.base_color.z};
    for (std::size_t c = 0; c < 3; ++c) *channels[c] = read_share(reader, color[c], "baseColorFactor");
    // Only what has no gloss says anything of its highlight.
    if (!source.contains("extensions"))
      material.gloss = {read_share(reader, reader.member(surface, "metallicFactor"), "metallicFactor"),
                        read_share(reader, reader.member(surface, "roughnessFactor"), "roughnessFactor")};
    if (surface.contains("baseColorTexture")) {
      const json& texture = reader.item(reader.member(surface["baseColorTexture"], "index"), "textures");
      material.texture = static_cast<std::uint32_t>(reader.index(reader.member(texture, "source"), "images"));
    }
    indices.push_back(static_cast<std::uint32_t>(scene.materials.size()));
    scene.materials.push_back(std::move(material));
  }
  return indices;
}

void check_mesh(const Reader& reader, const Mesh& mesh) {
  for (const std::uint32_t i : mesh.indices)
    if (i >= mesh.positions.size()) reader.fail(fmt::format("vertex {} of {}", i, mesh.positions.size()));
  for (const Vec3f n : mesh.normals)
    if (n == Vec3f{}) reader.fail("a normal without direction");
  for (const Vec3f c : mesh.colors)
    if (std::min({c.x, c.y, c.z}) < 0 || std::max({c.x, c.y, c.z}) > 1) reader.fail("a colour outside of 0 to 1");
}

// Meshes: primitives of the same accessors and material are instances of one. They come in the sequence that they had,
// since save_baked wrote their accessors in that.
using MeshKey = std::tuple<std::uint64_t, std::uint64_t, std::uint64_t, std::uint64_t, std::uint64_t, std::uint32_t>;

Mesh read_mesh(Reader& reader, const json& source, std::uint32_t material) {
  const json& primitive = reader.member(source, "primitives")[0];
  const json& attributes = reader.member(primitive, "attributes");
  Mesh mesh;
  mesh.name = reader.text(source, "name");
  mesh.material = material;
  mesh.positions = reader.take<Vec3f>(reader.member(attributes, "POSITION"), "VEC3");
  const std::size_t vertices = mesh.positions.size();
  mesh.normals = reader.take_rows<Vec3f>(attributes, "NORMAL", "VEC3", vertices);
  if (attributes.contains("TEXCOORD_0"))
    mesh.texcoords = reader.take_rows<Vec2f>(attributes, "TEXCOORD_0", "VEC2", vertices);
  if (attributes.contains("COLOR_0")) mesh.colors = reader.take_rows<Vec3f>(attributes, "COLOR_0", "VEC3", vertices);
  mesh.indices = reader.take<std::uint32_t>(reader.member(primitive, "indices"), "SCALAR", kGltfUnsignedInt);
  if (mesh.indices.size() % 3 != 0) reader.fail("indices that are not three for each triangle");
  check_mesh(reader, mesh);
  return mesh;
}

void read_meshes(Reader& reader, std::span<const Placed> placed, Scene& scene) {
  const std::vector<std::uint32_t> materials = read_materials(reader, scene);
  std::map<MeshKey, std::uint32_t> meshes;
  std::vector<MeshKey> keys;
  for (const Placed& p : placed) {
    const json& primitive = primitive_of(reader, p.mesh);
    const json& attributes = reader.member(primitive, "attributes");
    const auto accessor = [&](const json& object, const char* key) -> std::uint64_t {
      return object.contains(key) ? reader.index(object[key], "accessors") : reader.list("accessors").size();
    };
    if (!attributes.is_object()) reader.fail("attributes that are none");
    keys.push_back({accessor(attributes, "POSITION"), accessor(attributes, "NORMAL"),
                    accessor(attributes, "TEXCOORD_0"), accessor(attributes, "COLOR_0"), accessor(primitive, "indices"),
                    materials[reader.index(reader.member(primitive, "material"), "materials")]});
    meshes.emplace(keys.back(), 0);
  }
  std::uint32_t count = 0;
  for (auto& [key, mesh] : meshes) mesh = count++;
  scene.meshes.resize(count);
  for (std::size_t i = 0; i < placed.size(); ++i) {
    const std::uint32_t index = meshes.at(keys[i]);
    Mesh& mesh = scene.meshes[index];
    if (mesh.positions.empty()) mesh = read_mesh(reader, reader.list("meshes")[placed[i].mesh], std::get<5>(keys[i]));
    scene.instances.push_back({index, placed[i].to_world});
  }
}

void read_textures(Reader& reader, const std::string& name, Scene& scene) {
  for (const json& image : reader.list("images")) {
    const auto png = reader.take_view(reader.member(image, "bufferView"));
    scene.textures.push_back(load_image8(png, fmt::format("{}: texture {}", name, scene.textures.size())));
  }
}

// The coefficients of one instance, whose first vertex is `first`, from what lies in the file as Number.
template <class Number, class Decode>
void read_coefficients(Reader& reader, const json& attributes, int component_type, std::size_t first,
                       std::size_t vertices, Transfer& transfer, Decode&& decode) {
  const auto n = static_cast<std::size_t>(num_coefficients(transfer.bands));
  const auto channels = static_cast<std::size_t>(transfer.channels);
  for (std::size_t c = 0; c < channels; ++c)
    for (int k = 0; k < num_transfer_attributes(transfer.bands); ++k) {
      const std::string key = transfer_attribute(transfer.channels, static_cast<int>(c), k);
      const auto row = reader.take_rows<std::array<Number, 4>>(attributes, key.c_str(), "VEC4", vertices,
                                                               component_type, component_type != kGltfFloat);
      const auto from = 4 * static_cast<std::size_t>(k), size = std::min<std::size_t>(4, n - from);
      for (std::size_t v = 0; v < vertices; ++v)
        for (std::size_t i = 0; i < size; ++i)
          transfer.coefficients[((first + v) * channels + c) * n + from + i] = decode(row[v][i], c * n + from + i);
    }
}

// The codes of one instance's vertices, and what they stand for.
void read_codes(Reader& reader, const json& attributes, std::size_t vertices, ClusteredPca& pca) {
  const std::size_t n = pca.rows_per_cluster(), first = pca.num_vertices();
  reader.expect_left(vertices * 8 * static_cast<std::uint64_t>(num_pca_attributes(pca.components)));
  pca.codes.resize((first + vertices) * n);
  for (int k = 0; k < num_pca_attributes(pca.components); ++k) {
    const auto row = reader.take_rows<std::array<std::int16_t, 4>>(attributes, pca_attribute(k).c_str(), "VEC4",
                                                                   vertices, kGltfShort);
    const auto from = 4 * static_cast<std::size_t>(k), size = std::min<std::size_t>(4, n - from);
    for (std::size_t v = 0; v < vertices; ++v) std::copy_n(row[v].begin(), size, &pca.codes[(first + v) * n + from]);
  }
  for (std::size_t v = first; v < first + vertices; ++v)
    if (const int cluster = pca.codes[v * n]; cluster < 0 || cluster >= pca.clusters)
      reader.fail(fmt::format("a vertex of cluster {} of {}", cluster, pca.clusters));
}

void read_transfer(Reader& reader, std::span<const Placed> placed, const Scene& scene, std::span<const float> scales,
                   BakeInfo& info, Transfer& transfer) {
  const int bits = info.bits;
  const auto row = static_cast<std::size_t>(transfer.channels * num_coefficients(transfer.bands));
  const auto decode = [&](int number, std::size_t i) { return dequantise(number, scales[i], bits); };
  transfer.first_vertex.push_back(0);
  for (std::size_t i = 0; i < placed.size(); ++i) {
    const json& attributes = reader.member(primitive_of(reader, placed[i].mesh), "attributes");
    const std::size_t first = transfer.num_vertices();
    const std::size_t vertices = scene.meshes[scene.instances[i].mesh].positions.size();
    const auto occlusion = reader.take_rows<float>(attributes, kOcclusionAttribute, "SCALAR", vertices);
    const auto bent = reader.take_rows<Vec3f>(attributes, kBentNormalAttribute, "VEC3", vertices);
    transfer.ambient_occlusion.insert(transfer.ambient_occlusion.end(), occlusion.begin(), occlusion.end());
    transfer.bent_normals.insert(transfer.bent_normals.end(), bent.begin(), bent.end());
    if (info.pca) {
      read_codes(reader, attributes, vertices, *info.pca);
      transfer.first_vertex.push_back(transfer.num_vertices());
      continue;
    }
    reader.expect_left(vertices * row * static_cast<std::uint64_t>(bits) / 8);
    transfer.coefficients.resize((first + vertices) * row);
    if (bits == 8)
      read_coefficients<std::int8_t>(reader, attributes, kGltfByte, first, vertices, transfer, decode);
    else if (bits == 16)
      read_coefficients<std::int16_t>(reader, attributes, kGltfShort, first, vertices, transfer, decode);
    else
      read_coefficients<float>(reader, attributes, kGltfFloat, first, vertices, transfer,
                               [](float a, std::size_t) { return a; });
    transfer.first_vertex.push_back(transfer.num_vertices());
  }
  if (!info.pca) return;
  transfer.coefficients = pca_coefficients(*info.pca);
  for (const float a : transfer.coefficients)
    if (!std::isfinite(a)) reader.fail("a coefficient that is not finite");
}

void read_extras(const Reader& reader, const json& extras, Baked& baked) {
  auto& [scene, transfer, info] = baked;
  const auto kind = find_transfer_kind(reader.text(extras, "kind"));
  if (!kind) reader.fail("a kind that is not known");
  transfer.kind = *kind;
  transfer.bands = static_cast<int>(reader.whole(extras, "bands", 1, kMaxTransferBands));
  transfer.channels = static_cast<int>(reader.whole(extras, "channels", 1, 3));
  if (transfer.channels == 2) reader.fail("two channels");
  info.bits = static_cast<int>(reader.whole(extras, "bits", 8, 32));
  if (!is_transfer_bits(info.bits)) reader.fail("bits are not 8, 16 or 32");
  transfer.hash = reader.hexadecimal(extras, "hash");
  transfer.rays = reader.whole(extras, "rays", 0, std::numeric_limits<std::uint64_t>::max());
  transfer.estimated_error = reader.number(reader.member(extras, "estimated_error"), "estimated_error");
  if (transfer.estimated_error < 0) reader.fail("an estimated_error below 0");
  if (reader.member(extras, "convention") != json(baked_convention())) reader.fail("its convention is another");

  const json& settings = reader.member(extras, "settings");
  constexpr auto kMostInt = static_cast<std::uint64_t>(std::numeric_limits<int>::max());
  const auto method = find_transfer_method(reader.text(settings, "method"));
  if (!method) reader.fail("a method that is not known");
  info.params.kind = transfer.kind;
  info.params.bands = transfer.bands;
  info.params.method = *method;
  info.params.samples = static_cast<int>(reader.whole(settings, "samples", 0, kMostInt));
  info.params.error = static_cast<float>(reader.number(reader.member(settings, "error"), "error"));
  info.params.bounces = static_cast<int>(reader.whole(settings, "bounces", 0, kMostInt));
  info.params.seed = reader.whole(settings, "seed", 0, std::numeric_limits<std::uint64_t>::max());
  info.model = reader.text(extras, "model");
}

// Clusters and their table; nothing where the file has none. Codes are still to come.
std::optional<ClusteredPca> read_pca(Reader& reader, const json& extras, const Baked& baked) {
  if (!extras.contains("pca")) return {};
  const json& sizes = extras["pca"];
  if (baked.info.bits != 16) reader.fail("pca is not of 16 bits");
  ClusteredPca pca;
  pca.bands = baked.transfer.bands;
  pca.channels = baked.transfer.channels;
  pca.clusters = static_cast<int>(reader.whole(sizes, "clusters", 1, kMaxPcaClusters));
  pca.components = static_cast<int>(reader.whole(sizes, "components", 1, kMaxPcaComponents));
  pca.table = reader.take<float>(reader.member(sizes, "table"), "SCALAR");
  if (pca.table.size() != static_cast<std::size_t>(pca.clusters) * pca.rows_per_cluster() * pca.row_size())
    reader.fail(fmt::format("a table of {} values", pca.table.size()));
  return pca;
}

// The scales of coefficients that are not floats, for each of each channel.
std::vector<float> read_scales(const Reader& reader, const json& extras, const Baked& baked) {
  if (baked.info.bits == 32 || baked.info.pca) return {};
  const json& values = reader.member(extras, "scales");
  const auto count = static_cast<std::size_t>(baked.transfer.channels * num_coefficients(baked.transfer.bands));
  if (!values.is_array() || values.size() != count) reader.fail("scales are not one for each coefficient");
  std::vector<float> scales;
  for (const json& value : values) scales.push_back(static_cast<float>(reader.number(value, "a scale")));
  return scales;
}

json parse_json(std::string_view text, const std::string& name) {
  const auto malformed = [&](const std::string& why) {
    return Error(name, "is malformed: its JSON " + why, kAcceptedBaked);
  };
  if (text.size() > kMaxJsonBytes) throw malformed(fmt::format("holds {} bytes", text.size()));
  const auto stop_if_deep = [&](int depth, json::parse_event_t, json&) {
    if (depth > kMaxDepth) throw malformed("is too deep");
    return true;
  };
  const json root = json::parse(text, stop_if_deep, false);
  if (root.is_discarded() || !root.is_object()) throw malformed("is none");
  return root;
}

}  // namespace

Baked load_baked(std::span<const std::byte> bytes, const std::string& name) {
  const auto [text, binary] = split_glb(bytes, name);
  const json root = parse_json(text, name);
  const auto extras_at = json::json_pointer("/asset/extras/shlight");
  if (!root.contains(extras_at)) throw Error(name, "is no baked file", kAcceptedBaked);
  const json& extras = root[extras_at];
  Reader reader(root, binary, name);
  if (const auto version = reader.whole(extras, "version", 0, 1'000'000); version != kBakedVersion)
    throw Error(name, fmt::format("is of version {}", version), fmt::format("version {}", kBakedVersion));
  if (reader.text(extras, "checksum") != glb_checksum(bytes))
    throw Error(name, "has been changed since it was baked (its checksum is another)", kAcceptedBaked);

  Baked baked;
  read_extras(reader, extras, baked);
  std::vector<Placed> placed;
  const json& scenes = reader.list("scenes");
  if (scenes.size() != 1) reader.fail("other than one scene");
  const json& nodes = reader.member(scenes[0], "nodes");
  if (!nodes.is_array() || nodes.empty()) reader.fail("no nodes");
  for (const json& node : nodes) placed.push_back(read_node(reader, reader.item(node, "nodes")));
  read_meshes(reader, placed, baked.scene);
  read_textures(reader, name, baked.scene);
  baked.info.pca = read_pca(reader, extras, baked);
  read_transfer(reader, placed, baked.scene, read_scales(reader, extras, baked), baked.info, baked.transfer);
  return baked;
}

Baked load_baked(const std::filesystem::path& path) {
  return load_baked(read_file(path, kMaxGlbBytes), path.string());
}

}  // namespace shlight
