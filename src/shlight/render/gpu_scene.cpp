#include "shlight/render/gpu_scene.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <glm/gtc/matrix_transform.hpp>
#include <utility>

#include "shlight/core/assert.h"
#include "shlight/core/error.h"
#include "shlight/render/matrices.h"
#include "shlight/scene/tangents.h"

namespace shlight {
namespace {

// The locations that mesh.vert gives its attributes.
enum Attribute { kPosition = 0, kNormal = 1, kTexcoord = 2, kColor = 3, kTangent = 4, kShadow = 5 };

// More costs time and is hardly seen.
constexpr float kMaxAnisotropy = 8;

// The attribute of `values` in a vertex buffer that has one array after the other: filled at `offset`, which moves on.
// Where a mesh does not have the attribute, its value is the constant that draw() sets.
template <class T>
void add_attribute(Attribute attribute, const std::vector<T>& values, std::size_t& offset) {
  if (values.empty()) return;
  const std::size_t bytes = values.size() * sizeof(T);
  glBufferSubData(GL_ARRAY_BUFFER, static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(bytes), values.data());
  glEnableVertexAttribArray(attribute);
  glVertexAttribPointer(attribute, sizeof(T) / sizeof(float), GL_FLOAT, GL_FALSE, 0,
                        reinterpret_cast<const void*>(offset));
  offset += bytes;
}

gl::Texture upload_texture(const Image8& image) {
  const int max_size = gl::get_integer(GL_MAX_TEXTURE_SIZE);
  if (image.width > max_size || image.height > max_size)
    throw Error("OpenGL", fmt::format("a texture has {}x{} pixels", image.width, image.height),
                fmt::format("at most {0}x{0}", max_size));
  SHLIGHT_ASSERT_EQ(image.values.size(), 4 * static_cast<std::size_t>(image.width) * image.height);
  gl::Texture texture = gl::make_texture();
  glBindTexture(GL_TEXTURE_2D, texture.id());
  glTexImage2D(GL_TEXTURE_2D, 0, GL_SRGB8_ALPHA8, image.width, image.height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
               image.values.data());
  glGenerateMipmap(GL_TEXTURE_2D);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  if (epoxy_has_gl_extension("GL_EXT_texture_filter_anisotropic")) {
    float max_anisotropy = 1;
    glGetFloatv(GL_MAX_TEXTURE_MAX_ANISOTROPY_EXT, &max_anisotropy);
    glTexParameterf(GL_TEXTURE_2D, GL_TEXTURE_MAX_ANISOTROPY_EXT, std::min(max_anisotropy, kMaxAnisotropy));
  }
  return texture;
}

// What materials without a texture use: one pixel, read in the cheapest way.
gl::Texture make_white_texture() {
  constexpr unsigned char kWhite[] = {255, 255, 255, 255};
  gl::Texture texture = gl::make_texture();
  glBindTexture(GL_TEXTURE_2D, texture.id());
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, 1, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, kWhite);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  return texture;
}

// The matrix of normals is the inverse transpose of that of positions. The cofactor matrix is det times that, and is
// defined for flat instances too; the sign of det is taken out so that a mirrored instance keeps its normals outside.
glm::dmat3 normal_matrix(const glm::dmat3& m) {
  const glm::dmat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
  double largest = 0;
  for (int i = 0; i < 9; ++i) largest = std::max(largest, std::abs(cofactors[i / 3][i % 3]));
  const double sign = glm::determinant(m) < 0 ? -1 : 1;
  return largest > 0 ? cofactors * (sign / largest) : glm::dmat3(1);
}

}  // namespace

GpuScene::GpuScene(const Scene& scene, bool tangents)
    : instances_(scene.instances),
      materials_(scene.materials),
      white_(make_white_texture()),
      num_vertices_(shlight::num_vertices(scene)) {
  for (const Image8& image : scene.textures) textures_.push_back(upload_texture(image));
  for (const Mesh& mesh : scene.meshes) {
    SHLIGHT_ASSERT_LT(mesh.material, scene.materials.size());
    SHLIGHT_ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
    GpuMesh gpu_mesh = {gl::make_vertex_array(), gl::make_buffer(),
                        gl::make_buffer(),       static_cast<int>(mesh.indices.size()),
                        mesh.positions.size(),   mesh.material};
    glBindVertexArray(gpu_mesh.vertex_array.id());
    glBindBuffer(GL_ARRAY_BUFFER, gpu_mesh.vertices.id());
    const std::vector<Vec3f> mesh_tangents = tangents ? make_tangents(mesh) : std::vector<Vec3f>();
    const std::size_t bytes =
        (mesh.positions.size() + mesh.normals.size() + mesh.colors.size() + mesh_tangents.size()) * sizeof(Vec3f) +
        mesh.texcoords.size() * sizeof(Vec2f);
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(bytes), nullptr, GL_STATIC_DRAW);
    std::size_t offset = 0;
    add_attribute(kPosition, mesh.positions, offset);
    add_attribute(kNormal, mesh.normals, offset);
    add_attribute(kTexcoord, mesh.texcoords, offset);
    add_attribute(kColor, mesh.colors, offset);
    add_attribute(kTangent, mesh_tangents, offset);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, gpu_mesh.indices.id());
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(mesh.indices.size() * sizeof(std::uint32_t)),
                 mesh.indices.data(), GL_STATIC_DRAW);
    meshes_.push_back(std::move(gpu_mesh));
  }
  glBindVertexArray(0);
  gl::check_errors("the scene's buffers and textures");
}

GpuShadows::GpuShadows(std::span<const Vec3f> of_vertices)
    : buffer_(gl::make_buffer()), num_vertices_(of_vertices.size()) {
  glBindBuffer(GL_ARRAY_BUFFER, buffer_.id());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(of_vertices.size_bytes()), of_vertices.data(), GL_STATIC_DRAW);
  gl::check_errors("the shadows of vertices");
}

void GpuScene::set_shadows(const GpuShadows* shadows) {
  if (shadows) SHLIGHT_ASSERT_EQ(shadows->num_vertices(), num_vertices_);
  shadows_ = shadows;
}

std::vector<std::size_t> GpuScene::num_triangles() const {
  std::vector<std::size_t> counts;
  for (const Instance& instance : instances_)
    counts.push_back(static_cast<std::size_t>(meshes_[instance.mesh].num_indices) / 3);
  return counts;
}

void GpuScene::draw(const gl::Program& program, const View& view, const Rotation& light_to_world) const {
  draw([&](std::uint32_t) -> const gl::Program& { return program; }, view, light_to_world);
}

void GpuScene::draw(const ProgramOfMaterial& program_of, const View& view, const Rotation& light_to_world) const {
  const glm::dmat4 world_to_view = to_glm(view.world_to_view);
  const glm::dmat4 world_to_clip = to_glm(view.view_to_clip) * world_to_view;
  const glm::dmat3 world_to_light = inverse_to_glm(light_to_world);
  const glm::dvec3 eye(glm::inverse(world_to_view)[3]);
  const glm::dmat4 world_to_eye = glm::dmat4(world_to_light) * glm::translate(glm::dmat4(1), -eye);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  glDepthMask(GL_TRUE);
  glDisable(GL_CULL_FACE);
  glDisable(GL_BLEND);
  glVertexAttrib2f(kTexcoord, 0, 0);
  glVertexAttrib3f(kColor, 1, 1, 1);
  glVertexAttrib3f(kShadow, 1, 1, 1);

  std::size_t first_vertex = 0, first_triangle = 0;
  for (const Instance& instance : instances_) {
    const GpuMesh& mesh = meshes_[instance.mesh];
    const std::size_t vertex = std::exchange(first_vertex, first_vertex + mesh.num_vertices);
    // Its part of the range.
    const std::size_t triangles = static_cast<std::size_t>(mesh.num_indices) / 3;
    const std::size_t before = std::exchange(first_triangle, first_triangle + triangles);
    const std::size_t begin = std::clamp(range_.begin, before, first_triangle) - before,
                      end = std::clamp(range_.end, before, first_triangle) - before;
    if (begin >= end) continue;
    const Material& material = materials_[mesh.material];
    const glm::dmat4 to_world = to_glm(instance.to_world);
    const gl::Program& program = program_of(mesh.material);
    program.use();
    program.set("u_texture", 0);
    program.set("u_object_to_eye", to_mat4f(world_to_eye * to_world));
    program.set("u_object_to_clip", to_mat4f(world_to_clip * to_world));
    program.set("u_normal_to_light", to_mat3f(world_to_light * normal_matrix(glm::dmat3(to_world))));
    program.set("u_first_vertex", static_cast<int>(vertex));
    program.set("u_base_color", material.base_color);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, material.texture ? textures_[*material.texture].id() : white_.id());
    // A mirroring instance turns the winding around.
    glFrontFace(glm::determinant(glm::dmat3(to_world)) < 0 ? GL_CW : GL_CCW);
    glBindVertexArray(mesh.vertex_array.id());
    if (shadows_) {
      glBindBuffer(GL_ARRAY_BUFFER, shadows_->buffer());
      glEnableVertexAttribArray(kShadow);
      glVertexAttribPointer(kShadow, 3, GL_FLOAT, GL_FALSE, 0, reinterpret_cast<const void*>(vertex * sizeof(Vec3f)));
    } else {
      glDisableVertexAttribArray(kShadow);
    }
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * (end - begin)), GL_UNSIGNED_INT,
                   reinterpret_cast<const void*>(3 * begin * sizeof(std::uint32_t)));
  }
  glFrontFace(GL_CCW);
  glBindVertexArray(0);
}

}  // namespace shlight
