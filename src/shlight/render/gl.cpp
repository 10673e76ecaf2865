#include "shlight/render/gl.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <initializer_list>
#include <stdexcept>
#include <vector>

#include "shlight/core/error.h"

namespace shlight::gl {
namespace {

using Shader = Handle<[](unsigned id) { glDeleteShader(id); }>;

// glGet…InfoLog of a shader or program.
template <class GetLength, class GetLog>
std::string info_log(unsigned id, GetLength get_length, GetLog get_log) {
  GLint length = 0;
  get_length(id, GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(length), '\0');
  if (length > 0) get_log(id, length, nullptr, log.data());
  return log;
}

Shader compile(unsigned type, std::initializer_list<std::string_view> sources) {
  Shader shader(glCreateShader(type));
  std::vector<const char*> texts;
  std::vector<GLint> lengths;
  for (const std::string_view source : sources) {
    if (source.empty()) continue;
    texts.push_back(source.data());
    lengths.push_back(static_cast<GLint>(source.size()));
  }
  glShaderSource(shader.id(), static_cast<GLsizei>(texts.size()), texts.data(), lengths.data());
  glCompileShader(shader.id());
  GLint compiled = GL_FALSE;
  glGetShaderiv(shader.id(), GL_COMPILE_STATUS, &compiled);
  if (!compiled)
    throw std::logic_error(
        fmt::format("a shader does not compile:\n{}", info_log(shader.id(), glGetShaderiv, glGetShaderInfoLog)));
  return shader;
}

}  // namespace

void delete_buffer(unsigned id) {
  glDeleteBuffers(1, &id);
}
void delete_vertex_array(unsigned id) {
  glDeleteVertexArrays(1, &id);
}
void delete_texture(unsigned id) {
  glDeleteTextures(1, &id);
}
void delete_renderbuffer(unsigned id) {
  glDeleteRenderbuffers(1, &id);
}
void delete_framebuffer(unsigned id) {
  glDeleteFramebuffers(1, &id);
}
void delete_program(unsigned id) {
  glDeleteProgram(id);
}
void delete_query(unsigned id) {
  glDeleteQueries(1, &id);
}

Buffer make_buffer() {
  unsigned id = 0;
  glGenBuffers(1, &id);
  return Buffer(id);
}

VertexArray make_vertex_array() {
  unsigned id = 0;
  glGenVertexArrays(1, &id);
  return VertexArray(id);
}

Texture make_texture() {
  unsigned id = 0;
  glGenTextures(1, &id);
  return Texture(id);
}

Renderbuffer make_renderbuffer() {
  unsigned id = 0;
  glGenRenderbuffers(1, &id);
  return Renderbuffer(id);
}

Framebuffer make_framebuffer() {
  unsigned id = 0;
  glGenFramebuffers(1, &id);
  return Framebuffer(id);
}

Query make_query() {
  unsigned id = 0;
  glGenQueries(1, &id);
  return Query(id);
}

Program::Program(std::string_view vertex, std::string_view fragment, std::string_view fragment_functions)
    : id_(glCreateProgram()) {
  const Shader vertex_shader = compile(GL_VERTEX_SHADER, {vertex});
  const Shader fragment_shader = compile(GL_FRAGMENT_SHADER, {fragment, fragment_functions});
  glAttachShader(id_.id(), vertex_shader.id());
  glAttachShader(id_.id(), fragment_shader.id());
  glLinkProgram(id_.id());
  GLint linked = GL_FALSE;
  glGetProgramiv(id_.id(), GL_LINK_STATUS, &linked);
  if (!linked)
    throw std::logic_error(
        fmt::format("shaders do not link:\n{}", info_log(id_.id(), glGetProgramiv, glGetProgramInfoLog)));
}

void Program::use() const {
  glUseProgram(id_.id());
}

int Program::location(const char* name) const {
  return glGetUniformLocation(id_.id(), name);
}

void Program::set(const char* name, int value) const {
  glUniform1i(location(name), value);
}

void Program::set(const char* name, float value) const {
  glUniform1f(location(name), value);
}

void Program::set(const char* name, Vec3f value) const {
  glUniform3f(location(name), value.x, value.y, value.z);
}

void Program::set(const char* name, std::span<const float> values) const {
  if (!values.empty()) glUniform1fv(location(name), static_cast<GLsizei>(values.size()), values.data());
}

void Program::set(const char* name, std::span<const Vec3f> values) const {
  static_assert(sizeof(Vec3f) == 3 * sizeof(float));
  if (!values.empty()) glUniform3fv(location(name), static_cast<GLsizei>(values.size()), &values[0].x);
}

void Program::set(const char* name, std::span<const Vec4f> values) const {
  if (!values.empty()) glUniform4fv(location(name), static_cast<GLsizei>(values.size()), values[0].data());
}

void Program::set(const char* name, const Mat3f& value) const {
  glUniformMatrix3fv(location(name), 1, GL_FALSE, value.data());
}

void Program::set(const char* name, const Mat4f& value) const {
  glUniformMatrix4fv(location(name), 1, GL_FALSE, value.data());
}

void Program::set(const char* name, std::span<const Mat3x4f> values) const {
  static_assert(sizeof(Mat3x4f) == 12 * sizeof(float));
  if (!values.empty())
    glUniformMatrix3x4fv(location(name), static_cast<GLsizei>(values.size()), GL_FALSE, values[0].data());
}

void draw_fullscreen_triangle() {
  // The vertex shader needs no attributes, but some drivers insist on a vertex array.
  const VertexArray vertex_array = make_vertex_array();
  glBindVertexArray(vertex_array.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glBindVertexArray(0);
}

void finish() {
  glFinish();
}

int get_integer(unsigned name) {
  GLint value = 0;
  glGetIntegerv(name, &value);
  return value;
}

void check_errors(std::string_view what) {
  const GLenum error = glGetError();
  if (error == GL_NO_ERROR) return;
  const std::string reason = error == GL_OUT_OF_MEMORY ? "out of memory" : fmt::format("error 0x{:04x}", error);
  throw Error("OpenGL", fmt::format("cannot make {} ({})", what, reason), "something smaller");
}

void check_framebuffer(std::string_view what) {
  check_errors(what);
  const GLenum status = glCheckFramebufferStatus(GL_FRAMEBUFFER);
  if (status != GL_FRAMEBUFFER_COMPLETE)
    throw Error("OpenGL", fmt::format("cannot make {} (framebuffer status 0x{:04x})", what, status),
                "a driver with EXT_color_buffer_float");
}

}  // namespace shlight::gl
