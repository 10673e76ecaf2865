#include "shlight/render/sh_probe.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <initializer_list>
#include <string>
#include <string_view>

#include "shaders.h"
#include "shlight/core/assert.h"
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

// What `fragment` and `functions` draw, a pixel for each element of the inputs, which are as many as each other: their
// textures are u_input0, u_input1 …; `set_uniforms` gives the program its coefficients.
std::vector<Rgb> draw_at(std::initializer_list<std::span<const Vec3d>> inputs, std::string_view fragment,
                         const std::string& functions, const std::function<void(const gl::Program&)>& set_uniforms) {
  const std::size_t count = inputs.begin()->size();
  if (count == 0) return {};
  const int height = static_cast<int>((count + kWidth - 1) / kWidth);
  std::vector<float> values(4 * static_cast<std::size_t>(kWidth) * height);
  std::vector<gl::Texture> textures;
  for (const std::span<const Vec3d> input : inputs) {
    SHLIGHT_ASSERT_EQ(input.size(), count);
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3f d = vec_cast<float>(input[i]);
      values[4 * i] = d.x, values[4 * i + 1] = d.y, values[4 * i + 2] = d.z;
    }
    textures.push_back(make_float_texture(height, values.data()));
  }
  const gl::Texture output = make_float_texture(height, nullptr);
  const gl::Framebuffer framebuffer = gl::make_framebuffer();
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, output.id(), 0);
  gl::check_framebuffer("a target of 32-bit floats");

  const gl::Program program(shaders::fullscreen_vert, fragment, functions);
  program.use();
  set_uniforms(program);
  for (std::size_t unit = 0; unit < textures.size(); ++unit) {
    program.set(fmt::format("u_input{}", unit).c_str(), static_cast<int>(unit));
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    glBindTexture(GL_TEXTURE_2D, textures[unit].id());
  }
  glViewport(0, 0, kWidth, height);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  gl::draw_fullscreen_triangle();

  glReadPixels(0, 0, kWidth, height, GL_RGBA, GL_FLOAT, values.data());
  std::vector<Rgb> results(count);
  for (std::size_t i = 0; i < count; ++i) results[i] = {values[4 * i], values[4 * i + 1], values[4 * i + 2]};
  return results;
}

}  // namespace

std::vector<Rgb> draw_irradiance_at(std::span<const Vec3d> normals, const RgbCoefficients& radiance) {
  return draw_at({normals}, shaders::sh_probe_frag, make_irradiance_glsl(radiance.bands()),
                 [&](const gl::Program& program) { set_irradiance_uniforms(program, radiance); });
}

std::vector<Rgb> draw_radiance_at(std::span<const Vec3d> directions, const RgbCoefficients& radiance) {
  return draw_at({directions}, shaders::sh_probe_frag, make_sh_glsl(radiance.bands()),
                 [&](const gl::Program& program) { set_radiance_uniforms(program, radiance); });
}

std::vector<Rgb> draw_reflectance_at(std::span<const Vec3d> normals, std::span<const Vec3d> tangents,
                                     const ReflectanceGlslParams& params, std::span<const float> coefficients,
                                     Vec3f base_color, const RgbCoefficients& radiance) {
  SHLIGHT_ASSERT_EQ(radiance.bands(), params.bands);
  // As reflectance_texel returns them.
  const std::size_t per_texel = params.channels == 3 ? 3 : 4;
  std::vector<gl::Vec4f> texels((coefficients.size() + per_texel - 1) / per_texel);
  for (std::size_t i = 0; i < coefficients.size(); ++i) texels[i / per_texel][i % per_texel] = coefficients[i];
  const std::string texel = fmt::format(
      "uniform vec4 u_texels[{}];\nvec4 reflectance_texel(int k) {{ return u_texels[k]; }}\n", texels.size());
  return draw_at({normals, tangents}, shaders::reflectance_probe_frag, texel + make_reflectance_glsl(params),
                 [&](const gl::Program& program) {
                   set_radiance_uniforms(program, radiance);
                   program.set("u_texels", texels);
                   program.set("u_base_color", base_color);
                 });
}

}  // namespace shlight
