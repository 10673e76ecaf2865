#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "shlight/scene/scene.h"
#include "shlight/sh/vec.h"

// Owners of OpenGL ES 3.0 objects. Every object is made in the context that is current and must die while it is.

namespace shlight::gl {

// The name of one OpenGL object; 0 owns nothing. Move-only.
template <void (*kDelete)(unsigned)>
class Handle {
 public:
  Handle() = default;
  explicit Handle(unsigned id) : id_(id) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(id_, other.id_);
    return *this;
  }
  ~Handle() {
    if (id_ != 0) kDelete(id_);
  }
  unsigned id() const { return id_; }

 private:
  unsigned id_ = 0;
};

void delete_buffer(unsigned id);
void delete_vertex_array(unsigned id);
void delete_texture(unsigned id);
void delete_renderbuffer(unsigned id);
void delete_framebuffer(unsigned id);
void delete_program(unsigned id);
void delete_query(unsigned id);

using Buffer = Handle<delete_buffer>;
using VertexArray = Handle<delete_vertex_array>;
using Texture = Handle<delete_texture>;
using Renderbuffer = Handle<delete_renderbuffer>;
using Framebuffer = Handle<delete_framebuffer>;
using Query = Handle<delete_query>;

Buffer make_buffer();
VertexArray make_vertex_array();
Texture make_texture();
Renderbuffer make_renderbuffer();
Framebuffer make_framebuffer();
Query make_query();

// Column-major 3x3 matrix, as OpenGL has it.
using Mat3f = std::array<float, 9>;

// GLSL's mat3x4: three columns of four.
using Mat3x4f = std::array<float, 12>;

using Vec4f = std::array<float, 4>;

// A vertex and a fragment shader, compiled and linked. The setters work on the program in use; a name that the program
// has no use for is passed over, as OpenGL does.
class Program {
 public:
  // The fragment shader is `fragment` followed by `fragment_functions`, which defines what `fragment` only declares.
  // Throws std::logic_error with the compiler's log: a shader that does not compile is no fault of the user's.
  Program(std::string_view vertex, std::string_view fragment, std::string_view fragment_functions = {});

  void use() const;
  void set(const char* name, int value) const;
  void set(const char* name, float value) const;
  void set(const char* name, Vec3f value) const;
  void set(const char* name, std::span<const float> values) const;
  void set(const char* name, std::span<const Vec3f> values) const;
  void set(const char* name, std::span<const Vec4f> values) const;
  void set(const char* name, const Mat3f& value) const;
  void set(const char* name, const Mat4f& value) const;
  void set(const char* name, std::span<const Mat3x4f> values) const;

 private:
  int location(const char* name) const;

  Handle<delete_program> id_;
};

// Draws one triangle that covers the viewport, for programs with the vertex shader fullscreen.vert.
void draw_fullscreen_triangle();

// Waits until the device has done what it was asked for.
void finish();

// Asks for an integer such as GL_MAX_TEXTURE_SIZE.
int get_integer(unsigned name);

// Throw Error "OpenGL: cannot make `what` (…): …" where a call since the last check has failed, which short of a broken
// driver means that memory has run out, and where the framebuffer now bound cannot be drawn into.
void check_errors(std::string_view what);
void check_framebuffer(std::string_view what);

}  // namespace shlight::gl
