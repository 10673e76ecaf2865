#include "shlight/render/reflectance_renderer.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
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

// Layers of the coefficients of one entry.
int num_layers(int bands, int channels, bool isotropic) {
  const int numbers = channels * (isotropic ? bands * (bands + 1) / 2 : num_coefficients(bands));
  return channels == 3 ? numbers / 3 : (numbers + 3) / 4;
}

// Floats where OpenGL interpolates them, else half floats, which it always does.
GLenum table_format() {
  return epoxy_has_gl_extension("GL_OES_texture_float_linear") ? GL_RGBA32F : GL_RGBA16F;
}

// A layer for every texel of an entry, as reflectance_texel of reflect.glsl reads them; after them, where there is a
// highlight, its plain and its tinted albedo.
gl::Texture upload_table(const SurfaceReflectance& surface) {
  const ReflectanceTable& plain = *surface.plain;
  const int channels = channels_of(surface), per_texel = channels == 3 ? 3 : 4;
  const std::size_t entry = static_cast<std::size_t>(plain.coefficients() * channels);
  const std::size_t entries = static_cast<std::size_t>(plain.width) * plain.height;
  const int layers = num_layers(plain.bands, channels, plain.isotropic());
  const int all_layers = surface.highlight ? layers + 2 : layers;
  SHLIGHT_ASSERT_LE(2, plain.width);

  // Number i of an entry; of two channels, tinted and plain take turns.
  const auto number = [&](std::size_t at, std::size_t i) {
    if (!surface.tinted) return plain.values[at * entry + i];
    return (i % 2 == 0 ? surface.tinted->values : plain.values)[at * entry / 2 + i / 2];
  };
  if (surface.tinted) SHLIGHT_ASSERT_EQ(surface.tinted->values.size(), plain.values.size());

  gl::Texture texture = gl::make_texture();
  glBindTexture(GL_TEXTURE_2D_ARRAY, texture.id());
  glTexStorage3D(GL_TEXTURE_2D_ARRAY, 1, table_format(), plain.width, plain.height, all_layers);
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
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
  for (int layer = layers; layer < all_layers; ++layer) {
    const ReflectanceTable* const albedo = layer == layers             ? &surface.highlight->plain
                                           : surface.highlight->tinted ? &*surface.highlight->tinted
                                                                       : nullptr;
    for (std::size_t at = 0; at < entries; ++at)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t channel = albedo && albedo->channels == 3 ? 3 * at + k : at;
        // The integral of f cos is the first coefficient over that of the constant 1.
        values[4 * at + k] = albedo ? static_cast<float>(std::sqrt(4 * std::numbers::pi)) * albedo->values[channel] : 0;
      }
    glTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, layer, plain.width, plain.height, 1, GL_RGBA, GL_FLOAT,
                    values.data());
  }
  gl::check_errors("a reflectance table's texture");
  return texture;
}

// Half floats, which every OpenGL ES 3.0 interpolates.
gl::Texture upload_cube(const CubeFaces& faces, double unit) {
  const int size = faces[0].width;
  gl::Texture texture = gl::make_texture();
  glBindTexture(GL_TEXTURE_CUBE_MAP, texture.id());
  glTexStorage2D(GL_TEXTURE_CUBE_MAP, 1, GL_RGBA16F, size, size);
  glTexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  constexpr float kLargestHalf = 65504;
  std::vector<float> values(4 * static_cast<std::size_t>(size) * size);
  for (std::size_t face = 0; face < faces.size(); ++face) {
    const std::vector<float>& rgb = faces[face].values;
    for (std::size_t i = 0; i < rgb.size(); ++i)
      values[4 * (i / 3) + i % 3] = std::clamp(static_cast<float>(unit) * rgb[i], -kLargestHalf, kLargestHalf);
    glTexSubImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X + static_cast<GLenum>(face), 0, 0, 0, size, size, GL_RGBA, GL_FLOAT,
                    values.data());
  }
  gl::check_errors("a cube map of the light");
  return texture;
}

}  // namespace

gl::Program ReflectanceRenderer::make_program(const Kind& kind, const RgbCoefficients& radiance, Shade shade) const {
  const auto& [channels, isotropic, colored, hybrid] = kind;
  if (channels == 0) {
    gl::Program program(shaders::mesh_vert, shaders::surface_frag,
                        std::string(shaders::irradiance_frag) + make_irradiance_glsl(radiance.bands()));
    program.use();
    set_irradiance_uniforms(program, radiance);
    return program;
  }
  std::string defines = isotropic ? "" : "#define ANISOTROPIC\n";
  if (colored) defines += "#define COLORED\n";
  if (hybrid)
    defines += fmt::format("#define HIGHLIGHT_LAYER {}\n#define LOBE_TAPS {}\n",
                           num_layers(radiance.bands(), channels, isotropic), kLobeTaps);
  const std::string reflect =
      defines + std::string(shaders::reflect_glsl) + make_reflectance_glsl({radiance.bands(), channels, isotropic});
  gl::Program program = shade == Shade::kPixel ? gl::Program(shaders::mesh_vert, shaders::surface_frag,
                                                             std::string(shaders::reflectance_frag) + reflect)
                                               : gl::Program(std::string(shaders::reflectance_vertex_vert) + reflect,
                                                             shaders::surface_frag, shaders::reflectance_vertex_frag);
  program.use();
  program.set("u_reflectance", 1);
  program.set("u_residual", 2);
  set_radiance_uniforms(program, radiance);
  return program;
}

ReflectanceRenderer::ReflectanceRenderer(std::span<const SurfaceReflectance> surfaces, const RgbCoefficients& radiance,
                                         Shade shade, std::span<const CubeFaces> cubes, double unit) {
  if (!cubes.empty()) SHLIGHT_ASSERT_EQ(cubes.size(), surfaces.size());
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const SurfaceReflectance& surface = surfaces[i];
    // Tables made beside a highlight leave out what it reflects.
    if (cubes.empty()) SHLIGHT_ASSERT_EQ(surface.highlight.has_value(), false);
    const bool hybrid = surface.highlight.has_value();
    const Kind kind = {channels_of(surface), !surface.plain || surface.plain->isotropic(), surface.colors.has_value(),
                       hybrid};
    if (surface.plain) SHLIGHT_ASSERT_EQ(surface.plain->bands, radiance.bands());
    if (!programs_.contains(kind)) programs_.emplace(kind, make_program(kind, radiance, shade));
    surfaces_.push_back({&programs_.at(kind), surface.plain ? upload_table(surface) : gl::Texture(),
                         hybrid ? upload_cube(cubes[i], unit) : gl::Texture(),
                         hybrid ? surface.highlight->lobe.slopes : std::vector<float>(),
                         hybrid && surface.highlight->lobe.wide_along_x, surface.colors});
    needs_tangents_ = needs_tangents_ || !kind.isotropic;
  }
}

void ReflectanceRenderer::set_radiance(const RgbCoefficients& radiance) {
  for (const auto& [kind, program] : programs_) {
    program.use();
    kind.channels == 0 ? set_irradiance_uniforms(program, radiance) : set_radiance_uniforms(program, radiance);
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
    glActiveTexture(GL_TEXTURE2);
    glBindTexture(GL_TEXTURE_CUBE_MAP, surface.residual.id());
    surface.program->use();
    surface.program->set("u_slopes", surface.slopes);
    surface.program->set("u_wide_along_x", surface.wide_along_x ? 1 : 0);
    if (surface.colors) {
      surface.program->set("u_plain_color", surface.colors->plain);
      surface.program->set("u_tinted_color", surface.colors->tinted);
    }
    return *surface.program;
  };
  scene.draw(program_of, view, light_to_world);
}

}  // namespace shlight
