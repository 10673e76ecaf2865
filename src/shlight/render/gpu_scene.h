#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "shlight/render/gl.h"
#include "shlight/scene/camera.h"
#include "shlight/scene/scene.h"
#include "shlight/sh/rotation.h"

namespace shlight {

// What dims the light of each vertex, in the memory of the graphics card, for any GpuScene of as many vertices.
class GpuShadows {
 public:
  // Factors of radiance. Throws Error where memory runs out.
  explicit GpuShadows(std::span<const Vec3f> of_vertices);
  std::size_t num_vertices() const { return num_vertices_; }
  unsigned buffer() const { return buffer_.id(); }

 private:
  gl::Buffer buffer_;
  std::size_t num_vertices_;
};

// The triangles from `begin` to before `end` of all instances', in the sequence in which they are drawn.
struct TriangleRange {
  std::size_t begin = 0, end = static_cast<std::size_t>(-1);
};

// A scene's meshes and textures in the memory of the graphics card, for any renderer whose programs use the vertex
// shader mesh.vert or transfer.vert. Needs the context in which it was made.
class GpuScene {
 public:
  // With tangents (scene/tangents.h) only where asked for. Throws Error where a texture is bigger than the card takes,
  // or where memory runs out.
  explicit GpuScene(const Scene& scene, bool tangents = false);

  // Draws all instances, each with the program that `program_of` its material returns, into the framebuffer and
  // viewport now bound, with a depth test and both sides of every triangle. Sets u_object_to_clip, u_object_to_eye,
  // u_normal_to_light and u_first_vertex of the vertex shaders, and u_base_color and u_texture of surface.frag; the
  // rest is the caller's, and may be set in `program_of`: textures from unit 1 on. `light_to_world` turns the light's
  // frame into the world.
  using ProgramOfMaterial = std::function<const gl::Program&(std::uint32_t material)>;
  void draw(const ProgramOfMaterial& program_of, const View& view, const Rotation& light_to_world) const;
  // The same with one program for all.
  void draw(const gl::Program& program, const View& view, const Rotation& light_to_world) const;

  // From now on, what the vertex shaders mesh.vert and reflectance_vertex.vert hand on as v_shadow, for each vertex;
  // null: 1. Has to live until other ones are set.
  void set_shadows(const GpuShadows* shadows);
  // From now on, draws no other triangles than these.
  void set_range(TriangleRange range) { range_ = range; }

  // Of all instances. A mesh's vertices keep their sequence, and instances theirs: vertex v of an instance is the
  // (first vertex + v)th.
  std::size_t num_vertices() const { return num_vertices_; }
  // Of each instance.
  std::vector<std::size_t> num_triangles() const;

 private:
  struct GpuMesh {
    gl::VertexArray vertex_array;
    gl::Buffer vertices, indices;
    int num_indices = 0;
    std::size_t num_vertices = 0;
    std::uint32_t material = 0;
  };

  std::vector<GpuMesh> meshes_;
  std::vector<Instance> instances_;
  std::vector<Material> materials_;
  std::vector<gl::Texture> textures_;
  const GpuShadows* shadows_ = nullptr;
  TriangleRange range_;
  gl::Texture white_;  // of materials without a texture
  std::size_t num_vertices_;
};

}  // namespace shlight
