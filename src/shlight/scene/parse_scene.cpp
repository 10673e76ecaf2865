#include <fmt/format.h>

#include <assimp/DefaultIOSystem.h>
#include <assimp/commonMetaData.h>
#include <assimp/config.h>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "shlight/core/error.h"
#include "shlight/scene/load_scene.h"
#include "shlight/scene/model_folder.h"
#include "shlight/scene/parsed_scene.h"
#include "shlight/scene/transform.h"

namespace shlight {
namespace {

constexpr std::uint64_t kMaxTexels = 256ull << 20;  // as many as a picture file may have

// Opens only what a model may name.
class FolderIOSystem : public Assimp::DefaultIOSystem {
 public:
  explicit FolderIOSystem(const std::filesystem::path& model) : folder_(model) {}
  bool Exists(const char* path) const override { return folder_.may_read(path); }
  Assimp::IOStream* Open(const char* path, const char* mode) override {
    return *mode == 'r' && folder_.may_read(path) ? DefaultIOSystem::Open(path, mode) : nullptr;
  }

 private:
  ModelFolder folder_;
};

// What depends on the file's format.
struct FormatTraits {
  bool is_gltf = false;  // its colours are linear
  bool is_stl = false;   // its normals are those of its triangles: they say nothing and hide what is smooth
};

FormatTraits traits_of(const aiScene& scene) {
  aiString format;
  if (!scene.mMetaData || !scene.mMetaData->Get(AI_METADATA_SOURCE_FORMAT, format)) return {};
  const std::string_view name = format.C_Str();
  return {.is_gltf = name.starts_with("glTF2"), .is_stl = name.starts_with("Stereolithography")};
}

// IEC 61966-2-1.
double linear_from_srgb(double v) {
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

Vec3f linear_color(const aiColor4D& c, const FormatTraits& traits) {
  if (traits.is_gltf) return {c.r, c.g, c.b};
  return vec_cast<float>(Vec3d{linear_from_srgb(c.r), linear_from_srgb(c.g), linear_from_srgb(c.b)});
}

Vec3f vec_of(const aiVector3D& v) {
  return {v.x, v.y, v.z};
}

Mat4f matrix_of(const aiMatrix4x4& m) {
  return {m.a1, m.b1, m.c1, m.d1, m.a2, m.b2, m.c2, m.d2, m.a3, m.b3, m.c3, m.d3, m.a4, m.b4, m.c4, m.d4};
}

std::string text_of(const aiString& text) {
  return {text.data, std::min<std::size_t>(text.length, MAXLEN - 1)};
}

// Textures that materials name, each once.
class TextureList {
 public:
  explicit TextureList(const aiScene& source) : source_(source) {}

  std::uint32_t index_of(const std::string& name) {
    const auto [entry, is_new] = index_of_name_.try_emplace(name, static_cast<std::uint32_t>(textures_.size()));
    if (is_new) textures_.push_back(read(name));
    return entry->second;
  }
  std::vector<ParsedTexture> take() { return std::move(textures_); }

 private:
  ParsedTexture read(const std::string& name) const {
    ParsedTexture texture;
    texture.name = name;
    const aiTexture* embedded = source_.GetEmbeddedTexture(name.c_str());
    if (!embedded || !embedded->pcData) return texture;
    // A height of 0 says that the texels are a picture file's bytes, as many as the width.
    if (embedded->mHeight == 0) {
      const auto* bytes = reinterpret_cast<const std::byte*>(embedded->pcData);
      texture.file_bytes.assign(bytes, bytes + embedded->mWidth);
      return texture;
    }
    const std::uint64_t texels = std::uint64_t{embedded->mWidth} * embedded->mHeight;
    if (texels > kMaxTexels) return texture;
    texture.texels = {static_cast<int>(embedded->mWidth), static_cast<int>(embedded->mHeight), {}};
    texture.texels.values.reserve(4 * texels);
    for (std::uint64_t i = 0; i < texels; ++i) {
      const aiTexel& t = embedded->pcData[i];
      texture.texels.values.insert(texture.texels.values.end(), {t.r, t.g, t.b, t.a});
    }
    return texture;
  }

  const aiScene& source_;
  std::map<std::string, std::uint32_t> index_of_name_;
  std::vector<ParsedTexture> textures_;
};

// A material, and which of a mesh's sets of texture coordinates its texture uses.
struct ParsedMaterial {
  Material material;
  unsigned texcoord_set = 0;
};

ParsedMaterial parse_material(const aiMaterial& source, const FormatTraits& traits, bool has_vertex_colors,
                              TextureList& textures) {
  ParsedMaterial parsed;
  aiString name;
  if (source.Get(AI_MATKEY_NAME, name) == aiReturn_SUCCESS) parsed.material.name = printable(text_of(name));

  for (const aiTextureType type : {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE})
    if (aiString path; !parsed.material.texture &&
                       source.GetTexture(type, 0, &path, nullptr, &parsed.texcoord_set) == aiReturn_SUCCESS &&
                       path.length > 0)
      parsed.material.texture = textures.index_of(text_of(path));

  // Where a file has no material, assimp makes one in a colour of its own; except by glTF, that is one without a name.
  const bool is_made_up =
      parsed.material.name == AI_DEFAULT_MATERIAL_NAME || (parsed.material.name.empty() && !traits.is_gltf);
  aiColor4D color;
  const bool has_color = !is_made_up && (source.Get(AI_MATKEY_BASE_COLOR, color) == aiReturn_SUCCESS ||
                                         source.Get(AI_MATKEY_COLOR_DIFFUSE, color) == aiReturn_SUCCESS);
  if (has_color)
    parsed.material.base_color = linear_color(color, traits);
  else if (parsed.material.texture || has_vertex_colors)
    parsed.material.base_color = {1, 1, 1};
  if (traits.is_gltf && !is_made_up) {
    // Textures of metallic and roughness are not read: their factors stand for them.
    MetallicRoughness gloss = {1, 1};
    source.Get(AI_MATKEY_METALLIC_FACTOR, gloss.metallic);
    source.Get(AI_MATKEY_ROUGHNESS_FACTOR, gloss.roughness);
    const auto share = [](float value) { return value >= 0 ? std::min(value, 1.0f) : 0.0f; };
    parsed.material.gloss = {share(gloss.metallic), share(gloss.roughness)};
  }
  return parsed;
}

Mesh parse_mesh(const aiMesh& source, const FormatTraits& traits, unsigned texcoord_set) {
  Mesh mesh;
  mesh.name = printable(text_of(source.mName));
  mesh.material = source.mMaterialIndex;
  for (unsigned i = 0; i < source.mNumVertices; ++i) mesh.positions.push_back(vec_of(source.mVertices[i]));
  if (source.HasNormals() && !traits.is_stl)
    for (unsigned i = 0; i < source.mNumVertices; ++i) mesh.normals.push_back(vec_of(source.mNormals[i]));
  // assimp's texture coordinates have their origin at the bottom left, whatever the format's.
  if (source.HasTextureCoords(texcoord_set))
    for (unsigned i = 0; i < source.mNumVertices; ++i) {
      const aiVector3D& t = source.mTextureCoords[texcoord_set][i];
      mesh.texcoords.push_back({t.x, 1 - t.y});
    }
  if (source.HasVertexColors(0))
    for (unsigned i = 0; i < source.mNumVertices; ++i)
      mesh.colors.push_back(linear_color(source.mColors[0][i], traits));
  for (unsigned i = 0; i < source.mNumFaces; ++i)
    if (const aiFace& face = source.mFaces[i]; face.mNumIndices == 3)
      mesh.indices.insert(mesh.indices.end(), face.mIndices, face.mIndices + 3);
  return mesh;
}

std::vector<Instance> parse_nodes(const aiScene& source) {
  std::vector<Instance> instances;
  std::vector<std::pair<const aiNode*, Mat4f>> open = {{source.mRootNode, kIdentity}};
  while (!open.empty()) {
    const auto [node, parent_to_world] = open.back();
    open.pop_back();
    const Mat4f to_world = multiply(parent_to_world, matrix_of(node->mTransformation));
    for (unsigned i = 0; i < node->mNumMeshes; ++i) instances.push_back({node->mMeshes[i], to_world});
    // Backwards, so that nodes come off the stack in the file's sequence.
    for (unsigned i = node->mNumChildren; i-- > 0;) open.push_back({node->mChildren[i], to_world});
  }
  return instances;
}

ParsedScene convert_scene(const aiScene& source) {
  const FormatTraits traits = traits_of(source);
  std::vector<bool> has_vertex_colors(source.mNumMaterials);
  for (unsigned i = 0; i < source.mNumMeshes; ++i)
    if (const aiMesh& mesh = *source.mMeshes[i]; mesh.mMaterialIndex < source.mNumMaterials)
      has_vertex_colors[mesh.mMaterialIndex] = has_vertex_colors[mesh.mMaterialIndex] || mesh.HasVertexColors(0);

  ParsedScene scene;
  TextureList textures(source);
  std::vector<unsigned> texcoord_sets;
  for (unsigned i = 0; i < source.mNumMaterials; ++i) {
    ParsedMaterial parsed = parse_material(*source.mMaterials[i], traits, has_vertex_colors[i], textures);
    scene.materials.push_back(std::move(parsed.material));
    texcoord_sets.push_back(parsed.texcoord_set);
  }
  scene.textures = textures.take();
  for (unsigned i = 0; i < source.mNumMeshes; ++i) {
    const aiMesh& mesh = *source.mMeshes[i];
    scene.meshes.push_back(
        parse_mesh(mesh, traits, mesh.mMaterialIndex < texcoord_sets.size() ? texcoord_sets[mesh.mMaterialIndex] : 0));
  }
  scene.instances = parse_nodes(source);
  return scene;
}

}  // namespace

ParsedScene parse_scene(const std::filesystem::path& path, std::string_view accepted) {
  Assimp::Importer importer;
  importer.SetIOHandler(new FolderIOSystem(path));  // the importer owns it
  // Files with nothing but bones would otherwise get a mesh to show them by.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
  const auto is_complete = [](const aiScene* s) {
    return s && s->mRootNode && !(s->mFlags & AI_SCENE_FLAGS_INCOMPLETE);
  };

  const aiScene* source = importer.ReadFile(path.string(), 0);
  if (!is_complete(source)) {
    if (!source && !importer.IsExtensionSupported(path.extension().string()))
      throw Error(path.string(), "is of no kind that is known here", accepted);
    const std::string reason = source ? "it holds nothing to draw" : printable(importer.GetErrorString());
    throw Error(path.string(), fmt::format("is malformed ({})", reason), accepted);
  }

  std::size_t points_and_lines = 0;
  for (unsigned i = 0; i < source->mNumMeshes; ++i) {
    const aiMesh& mesh = *source->mMeshes[i];
    points_and_lines +=
        std::count_if(mesh.mFaces, mesh.mFaces + mesh.mNumFaces, [](const aiFace& f) { return f.mNumIndices < 3; });
  }
  source = importer.ApplyPostProcessing(aiProcess_Triangulate);
  if (!is_complete(source)) throw Error(path.string(), "is malformed (its polygons are none)", accepted);

  ParsedScene scene = convert_scene(*source);
  if (points_and_lines > 0) scene.warnings.push_back(fmt::format("{} points and lines: left out", points_and_lines));
  return scene;
}

bool is_model_file(const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  return !extension.empty() && Assimp::Importer().IsExtensionSupported(extension);
}

}  // namespace shlight
