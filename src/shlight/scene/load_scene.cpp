#include "shlight/scene/load_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <system_error>
#include <utility>

#include "shlight/core/error.h"
#include "shlight/image/image_io.h"
#include "shlight/scene/builtin_scene.h"
#include "shlight/scene/mend_mesh.h"
#include "shlight/scene/model_folder.h"
#include "shlight/scene/parsed_scene.h"
#include "shlight/scene/ply_header.h"
#include "shlight/scene/transform.h"

namespace shlight {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kAccepted =
    "a model with triangles, such as .x .obj .ply .stl .off .gltf .glb .dae .3ds .fbx";

void check_file(const fs::path& path, std::uint64_t max_bytes) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) throw Error(path.string(), "is not there", kAccepted);
  if (fs::is_directory(status)) throw Error(path.string(), "is a folder", kAccepted);
  if (!fs::is_regular_file(status)) throw Error(path.string(), "is not a regular file", kAccepted);
  const std::uintmax_t size = fs::file_size(path, error);
  if (error) throw Error(path.string(), fmt::format("cannot be read ({})", error.message()), kAccepted);
  if (size == 0) throw Error(path.string(), "is empty", kAccepted);
  if (size > max_bytes)
    throw Error(path.string(), fmt::format("holds {} bytes", size), fmt::format("at most {} bytes", max_bytes));

  std::ifstream file(path, std::ios::binary);
  std::string magic(4, ' ');
  file.read(magic.data(), 4);
  if (magic == "ply\n" || magic == "ply\r" || path.extension() == ".ply" || path.extension() == ".PLY") {
    file.clear();
    file.seekg(0);
    check_ply_header(file, path.string());
  }
}

// Some malformed files make a parser run for ever. Sound ones take it less than a second for ten megabytes.
FenceLimits limits_for(const fs::path& path, FenceLimits limits) {
  std::error_code ignored;
  const double megabytes = static_cast<double>(fs::file_size(path, ignored)) / 1e6;
  limits.seconds = std::min(limits.seconds, 20 + megabytes);
  return limits;
}

// Whether all positions of the mesh stay well inside what a float holds.
bool stays_finite(const Mesh& mesh, const Mat4f& to_world) {
  const auto larger = [](double a, float b) { return std::max(a, std::abs(double{b})); };
  double extent = 1;
  for (const Vec3f& p : mesh.positions) extent = larger(larger(larger(extent, p.x), p.y), p.z);
  const double factor = std::accumulate(to_world.begin(), to_world.end(), 0.0, larger);
  return 4 * extent * factor < std::numeric_limits<float>::max();
}

void warn_of(std::size_t count, std::string_view what, Scene& scene) {
  if (count > 0) scene.warnings.push_back(fmt::format("{} {}", count, what));
}

void mend_meshes(std::span<const Mesh> meshes, float crease_degrees, Scene& scene) {
  MeshFaults faults;
  for (const Mesh& mesh : meshes) scene.meshes.push_back(mend_mesh(mesh, crease_degrees, faults));
  warn_of(faults.non_finite_triangles, "triangles with positions that are not finite: left out", scene);
  warn_of(faults.degenerate_triangles, "triangles without area: left out", scene);
  warn_of(faults.bad_normals, "normals that are zero or not finite: made anew", scene);
  warn_of(faults.bad_attributes, "texture coordinates or colours that are not finite: replaced", scene);
}

// Puts mended meshes into the world by matrices that never mirror: a mirrored instance gets a mirrored mesh instead, so
// that nothing further on need ask which way round triangles are.
void place_instances(std::span<const Instance> instances, Scene& scene) {
  std::size_t unplaceable = 0;
  std::map<std::uint32_t, std::uint32_t> mirror_images;
  for (Instance instance : instances) {
    const bool is_finite = std::ranges::all_of(instance.to_world, [](float v) { return std::isfinite(v); });
    const double det = is_finite ? determinant(instance.to_world) : 0;
    if (det == 0 || !stays_finite(scene.meshes[instance.mesh], instance.to_world)) {
      ++unplaceable;
      continue;
    }
    if (det < 0) {
      const auto [entry, is_new] =
          mirror_images.try_emplace(instance.mesh, static_cast<std::uint32_t>(scene.meshes.size()));
      if (is_new) scene.meshes.push_back(mirror_mesh(scene.meshes[instance.mesh]));
      instance = {entry->second, multiply(instance.to_world, make_scaling({-1, 1, 1}))};
    }
    scene.instances.push_back(instance);
  }
  warn_of(unplaceable, "instances whose matrix flattens them or is not finite: left out", scene);
}

// Keeps of `items` only those that some of `users` refer to by their member `index`, in their sequence.
template <class Item, class User>
void keep_used(std::vector<Item>& items, std::vector<User>& users, std::uint32_t User::*index) {
  std::map<std::uint32_t, std::uint32_t> new_index;
  for (const User& user : users) new_index.emplace(user.*index, 0);
  std::vector<Item> used;
  for (auto& [from, to] : new_index) {
    to = static_cast<std::uint32_t>(used.size());
    used.push_back(std::move(items[from]));
  }
  for (User& user : users) user.*index = new_index.at(user.*index);
  items = std::move(used);
}

// Leaves out instances of meshes without triangles, then meshes without instances, then materials without meshes.
void drop_unused(Scene& scene) {
  std::erase_if(scene.instances, [&](const Instance& i) { return scene.meshes[i.mesh].indices.empty(); });
  keep_used(scene.meshes, scene.instances, &Instance::mesh);
  keep_used(scene.materials, scene.meshes, &Mesh::material);
}

// The texture's picture, wherever it is; throws Error.
Image8 load_texture(const ParsedTexture& texture, const ModelFolder& folder) {
  if (!texture.texels.values.empty()) return texture.texels;
  if (!texture.file_bytes.empty()) return load_image8(texture.file_bytes, texture.name);
  if (const std::optional<fs::path> path = folder.find(texture.name)) return load_image8(*path);
  throw Error(printable(texture.name), "is not there", "a picture in the model's folder or below it");
}

// Gives the materials whose meshes have texture coordinates their textures. One that is missing or bad costs a warning
// and no more.
void load_textures(std::span<const ParsedTexture> textures, const ModelFolder& folder, Scene& scene) {
  std::vector<bool> is_mapped(scene.materials.size());
  for (const Mesh& mesh : scene.meshes) is_mapped[mesh.material] = is_mapped[mesh.material] || !mesh.texcoords.empty();

  std::map<std::uint32_t, std::optional<std::uint32_t>> loaded;
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    std::optional<std::uint32_t>& texture = scene.materials[i].texture;
    if (!texture) continue;
    const std::uint32_t source = *texture;
    texture.reset();
    if (!is_mapped[i]) continue;
    if (!loaded.contains(source)) try {
        scene.textures.push_back(load_texture(textures[source], folder));
        loaded[source] = static_cast<std::uint32_t>(scene.textures.size() - 1);
      } catch (const Error& error) {
        scene.warnings.push_back(fmt::format("texture {}", error.what()));
        loaded[source] = {};
      }
    texture = loaded[source];
  }
}

// Reflectance lies in [0, 1].
void mend_materials(Scene& scene) {
  for (Material& material : scene.materials) {
    Vec3f& c = material.base_color;
    for (float* channel : {&c.x, &c.y, &c.z}) {
      if (!(*channel >= 0 && *channel <= 1))
        scene.warnings.push_back(
            fmt::format("material {}: a base colour of {} is outside of 0 to 1", material.name, *channel));
      *channel = std::isnan(*channel) ? 0 : std::clamp(*channel, 0.0f, 1.0f);
    }
  }
}

}  // namespace

Scene load_scene(const fs::path& path, const LoadSceneParams& params) {
  check_file(path, params.max_file_bytes);
  const FencedBytes bytes = run_fenced(path.string(), kAccepted, limits_for(path, params.fence), [&](FencedBytes& out) {
    write_parsed_scene(parse_scene(path, kAccepted), out);
  });
  ParsedScene parsed = read_parsed_scene(bytes.bytes(), path.string(), kAccepted);

  Scene scene;
  scene.materials = std::move(parsed.materials);
  scene.warnings = std::move(parsed.warnings);
  mend_materials(scene);
  mend_meshes(parsed.meshes, params.crease_degrees, scene);
  place_instances(parsed.instances, scene);
  drop_unused(scene);
  if (const std::size_t triangles = num_triangles(scene); triangles == 0)
    throw Error(path.string(), "holds no triangles", kAccepted);
  else if (triangles > params.max_triangles)
    throw Error(path.string(), fmt::format("draws {} triangles", triangles),
                fmt::format("at most {}", params.max_triangles));
  load_textures(parsed.textures, ModelFolder(path), scene);
  return scene;
}

namespace {

struct BuiltinScene {
  std::string_view name;
  Scene (*make)();
};
constexpr BuiltinScene kBuiltinScenes[] = {{"builtin:sphere", [] { return make_sphere_scene(); }},
                                           {"builtin:knot", make_knot_scene},
                                           {"builtin:scene", make_still_life_scene}};

}  // namespace

Scene make_scene(std::string_view model, const LoadSceneParams& params) {
  for (const BuiltinScene& builtin : kBuiltinScenes)
    if (model == builtin.name) return builtin.make();
  if (model.starts_with("builtin:"))
    throw Error(model, "is no built-in model", "builtin:sphere, builtin:knot or builtin:scene");
  return load_scene(model, params);
}

bool is_builtin_scene(std::string_view model) {
  return std::any_of(std::begin(kBuiltinScenes), std::end(kBuiltinScenes),
                     [&](const BuiltinScene& builtin) { return model == builtin.name; });
}

}  // namespace shlight
