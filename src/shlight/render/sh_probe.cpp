#include "shlight/render/sh_probe.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <string>

#include "shaders.h"
#include "shlight/render/gl.h"
#include "shlight/render/sh_glsl.h"

namespace shlight {
namespace {

// Pixels a row. Every OpenGL ES 3.0 has textures of 2048 x 2048.
constexpr int kWidth = 1024;

gl::Texture make_float_texture(int height, const float* values) {
  gl::Texture texture = gl::make_texture();
  glBindTexture(GL_TEXTURE_2D, texture.id());
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, kWidth, height, 0, GL_RGBA, GL_FLOAT, values);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  return texture;
}

// Draws with eval_sh as `glsl` defines it; `set_uniforms` gives the program its coefficients.
std::vector<Rgb> draw_at(std::span<const Vec3d> directions, const std::string& glsl,
                         const std::function<void(const gl::Program&)>& set_uniforms) {
  if (directions.empty()) return {};
  const int height = static_cast<int>((directions.size() + kWidth - 1) / kWidth);
  std::vector<float> values(4 * static_cast<std::size_t>(kWidth) * height);
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const Vec3f d = vec_cast<float>(directions[i]);
    values[4 * i] = d.x, values[4 * i + 1] = d.y, values[4 * i + 2] = d.z;
  }
  const gl::Texture input = make_float_texture(height, values.data());
  const gl::Texture output = make_float_texture(height, nullptr);
  const gl::Framebuffer framebuffer = gl::make_framebuffer();
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, output.id(), 0);
  gl::check_framebuffer("a target of 32-bit floats");

  const gl::Program program(shaders::fullscreen_vert, shaders::sh_probe_frag, glsl);
  program.use();
  set_uniforms(program);
  program.set("u_directions", 0);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, input.id());
  glViewport(0, 0, kWidth, height);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  gl::draw_fullscreen_triangle();

  glReadPixels(0, 0, kWidth, height, GL_RGBA, GL_FLOAT, values.data());
  std::vector<Rgb> results(directions.size());
  for (std::size_t i = 0; i < results.size(); ++i) results[i] = {values[4 * i], values[4 * i + 1], values[4 * i + 2]};
  return results;
}

}  // namespace

std::vector<Rgb> draw_irradiance_at(std::span<const Vec3d> normals, const RgbCoefficients& radiance) {
  return draw_at(normals, make_irradiance_glsl(radiance.bands()),
                 [&](const gl::Program& program) { set_irradiance_uniforms(program, radiance); });
}

std::vector<Rgb> draw_radiance_at(std::span<const Vec3d> directions, const RgbCoefficients& radiance) {
  return draw_at(directions, make_sh_glsl(radiance.bands()),
                 [&](const gl::Program& program) { set_radiance_uniforms(program, radiance); });
}

}  // namespace shlight
