#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "shlight/image/image.h"
#include "shlight/sh/vec.h"

namespace shlight {

struct Vec2f {
  float u = 0, v = 0;
  bool operator==(const Vec2f&) const = default;
};

// Column-major 4x4 matrix, as OpenGL has it.
using Mat4f = std::array<float, 16>;
inline constexpr Mat4f kIdentity = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

// glTF's two numbers of a surface's gloss, both in [0, 1] (brdf/metallic_roughness.h).
struct MetallicRoughness {
  float metallic = 0;
  float roughness = 1;
  bool operator==(const MetallicRoughness&) const = default;
};

// How a surface reflects. Every method uses the base colour, as diffuse reflectance; those that can show gloss, the
// rest.
struct Material {
  std::string name;
  Vec3f base_color = {0.8f, 0.8f, 0.8f};        // linear Rec. 709 in [0, 1]
  std::optional<std::uint32_t> texture;         // into Scene::textures; multiplies base_color where texcoords are
  std::optional<MetallicRoughness> gloss = {};  // none: a Lambertian surface
};

// Triangles of one material. All of a loaded mesh's values are finite and every index is below positions.size();
// normals have unit length and as many as positions; texcoords are empty or as many as positions, (0, 0) at the top
// left of the picture; colors (of vertices, linear Rec. 709, they multiply the material's) are empty or as many as
// positions.
struct Mesh {
  std::string name;
  std::vector<Vec3f> positions;
  std::vector<Vec3f> normals;
  std::vector<Vec2f> texcoords;
  std::vector<Vec3f> colors;
  std::vector<std::uint32_t> indices;  // three a triangle, counter-clockwise seen from outside
  std::uint32_t material = 0;          // into Scene::materials
};

// A mesh put into the world.
struct Instance {
  std::uint32_t mesh = 0;      // into Scene::meshes
  Mat4f to_world = kIdentity;  // of positive determinant: it never mirrors, so triangles stay counter-clockwise
};

struct Scene {
  std::vector<Mesh> meshes;
  std::vector<Instance> instances;
  std::vector<Material> materials;
  std::vector<Image8> textures;
  // What was found and mended or left out while loading, a line each ("texture tiger.bmp: no such file: …").
  std::vector<std::string> warnings;
};

struct Bounds {
  Vec3f min, max;
};

// Triangles and vertices as drawn: an instance counts each time.
std::size_t num_triangles(const Scene& scene);
std::size_t num_vertices(const Scene& scene);

// The box around all instances in the world; nothing where the scene has no vertex.
std::optional<Bounds> world_bounds(const Scene& scene);

}  // namespace shlight
