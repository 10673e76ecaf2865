#include "shlight/render/reflectance_renderer.h"

#include <epoxy/gl.h>

#include <cstddef>
#include <string>

#include "shaders.h"
#include "shlight/core/assert.h"
#include "shlight/render/reflectance_glsl.h"
#include "shlight/render/sh_glsl.h"

namespace shlight {
namespace {

int channels_of(const SurfaceReflectance& surface) {
  if (!surface.plain) return 0;
  return surface.tinted ? 2 : surface.plain->channels;
}

// A layer for every texel of an entry, as reflectance_texel of reflect.glsl reads them.
gl::Texture upload_table(const SurfaceReflectance& surface) {
  const ReflectanceTable& plain = *surface.plain;
  const int channels = channels_of(surface), per_texel = channels == 3 ? 3 : 4;
  const std::size_t entry = static_cast<std::size_t>(plain.coefficients() * channels);
  const std::size_t entries = static_cast<std::size_t>(plain.width) * plain.height;
  const int layers = (plain.coefficients() * channels + per_texel - 1) / per_texel;
  SHLIGHT_ASSERT_LE(2, plain.width);

  // Number i of an entry; of two channels, tinted and plain take turns.
  const auto number = [&](std::size_t at, std::size_t i) {
    if (!surface.tinted) return plain.values[at * entry + i];
    return (i % 2 == 0 ? surface.tinted->values : plain.values)[at * entry / 2 + i / 2];
  };
  if (surface.tinted) SHLIGHT_ASSERT_EQ(surface.tinted->values.size(), plain.values.size());

  gl::Texture texture = gl::make_texture();
  glBindTexture(GL_TEXTURE_2D_ARRAY, texture.id());
  glTexStorage3D(GL_TEXTURE_2D_ARRAY, 1, GL_RGBA32F, plain.width, plain.height, layers);
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  std::vector<float> values(4 * entries);
  for (int layer = 0; layer < layers; ++layer) {
    for (std::size_t at = 0; at < entries; ++at)
      for (int k = 0; k < per_texel; ++k) {
        const std::size_t i = static_cast<std::size_t>(layer * per_texel + k);
        values[4 * at + static_cast<std::size_t>(k)] = i < entry ? number(at, i) : 0;
      }
    glTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, layer, plain.width, plain.height, 1, GL_RGBA, GL_FLOAT,
                    values.data());
  }
  gl::check_errors("a reflectance table's texture");
  return texture;
}

gl::Program make_program(int channels, bool isotropic, const RgbCoefficients& radiance, Shade shade) {
  if (channels == 0) {
    gl::Program program(shaders::mesh_vert, shaders::surface_frag,
                        std::string(shaders::irradiance_frag) + make_irradiance_glsl(radiance.bands()));
    program.use();
    set_irradiance_uniforms(program, radiance);
    return program;
  }
  const std::string reflect = std::string(isotropic ? "" : "#define ANISOTROPIC\n") +
                              std::string(shaders::reflect_glsl) +
                              make_reflectance_glsl({radiance.bands(), channels, isotropic});
  gl::Program program = shade == Shade::kPixel ? gl::Program(shaders::mesh_vert, shaders::surface_frag,
                                                             std::string(shaders::reflectance_frag) + reflect)
                                               : gl::Program(std::string(shaders::reflectance_vertex_vert) + reflect,
                                                             shaders::surface_frag, shaders::reflectance_vertex_frag);
  program.use();
  program.set("u_reflectance", 1);
  set_radiance_uniforms(program, radiance);
  return program;
}

}  // namespace

ReflectanceRenderer::ReflectanceRenderer(std::span<const SurfaceReflectance> surfaces, const RgbCoefficients& radiance,
                                         Shade shade) {
  for (const SurfaceReflectance& surface : surfaces) {
    const Kind kind = {channels_of(surface), !surface.plain || surface.plain->isotropic()};
    if (surface.plain) SHLIGHT_ASSERT_EQ(surface.plain->bands, radiance.bands());
    if (!programs_.contains(kind)) programs_.emplace(kind, make_program(kind.first, kind.second, radiance, shade));
    surfaces_.push_back({&programs_.at(kind), surface.plain ? upload_table(surface) : gl::Texture()});
    needs_tangents_ = needs_tangents_ || !kind.second;
  }
}

void ReflectanceRenderer::mark_negative(Vec3f radiance) {
  for (const auto& [kind, program] : programs_) {
    program.use();
    program.set("u_negative", radiance);
  }
}

void ReflectanceRenderer::draw(const GpuScene& scene, const View& view, const Rotation& light_to_world) const {
  const auto program_of = [&](std::uint32_t material) -> const gl::Program& {
    const Surface& surface = surfaces_[material];
    glActiveTexture(GL_TEXTURE1);
    glBindTexture(GL_TEXTURE_2D_ARRAY, surface.table.id());
    return *surface.program;
  };
  scene.draw(program_of, view, light_to_world);
}

}  // namespace shlight
