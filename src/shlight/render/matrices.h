#pragma once

// Private to render/: matrices of the public headers as glm's, and back.

#include <glm/glm.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "shlight/render/gl.h"
#include "shlight/scene/camera.h"
#include "shlight/scene/scene.h"
#include "shlight/sh/rotation.h"

namespace shlight {

inline glm::dmat4 to_glm(const Mat4d& m) {
  return glm::make_mat4(m.data());
}
inline glm::dmat4 to_glm(const Mat4f& m) {
  return glm::dmat4(glm::make_mat4(m.data()));
}

// A rotation's rows are the columns of its inverse.
inline glm::dmat3 inverse_to_glm(const Rotation& r) {
  const auto column = [](Vec3d v) { return glm::dvec3(v.x, v.y, v.z); };
  return {column(r.rows[0]), column(r.rows[1]), column(r.rows[2])};
}

inline Mat4d to_mat4d(const glm::dmat4& m) {
  Mat4d result;
  for (int i = 0; i < 16; ++i) result[i] = m[i / 4][i % 4];
  return result;
}

inline Mat4f to_mat4f(const glm::dmat4& m) {
  Mat4f result;
  for (int i = 0; i < 16; ++i) result[i] = static_cast<float>(m[i / 4][i % 4]);
  return result;
}

inline gl::Mat3f to_mat3f(const glm::dmat3& m) {
  gl::Mat3f result;
  for (int i = 0; i < 9; ++i) result[i] = static_cast<float>(m[i / 3][i % 3]);
  return result;
}

}  // namespace shlight
