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
#include "shlight/render/render_light.h"
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

// One row, from slope 0 to infinity.
gl::Texture upload_slope_density(const std::vector<float>& density) {
  gl::Texture texture = gl::make_texture();
  glBindTexture(GL_TEXTURE_2D, texture.id());
  const auto width = static_cast<GLsizei>(density.size());
  glTexStorage2D(GL_TEXTURE_2D, 1, GL_R16F, width, 1);
  for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
    glTexParameteri(GL_TEXTURE_2D, filter, GL_LINEAR);
  for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
    glTexParameteri(GL_TEXTURE_2D, wrap, GL_CLAMP_TO_EDGE);
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, 1, GL_RED, GL_FLOAT, density.data());
  gl::check_errors("a lobe's texture");
  return texture;
}

}  // namespace

gl::Program ReflectanceRenderer::make_program(const Kind& kind, const RgbCoefficients& radiance, Shade shade) const {
  const auto& [channels, isotropic, colored, hybrid, sun] = kind;
  if (channels == 0) {
    gl::Program program(shaders::mesh_vert, shaders::surface_frag,
                        std::string(shaders::seen_normal_glsl) + std::string(shaders::irradiance_frag) +
                            make_irradiance_glsl(radiance.bands()));
    program.use();
    set_irradiance_uniforms(program, radiance);
    return program;
  }
  std::string defines = isotropic ? "" : "#define ANISOTROPIC\n";
  if (colored) defines += "#define COLORED\n";
  if (hybrid)
    defines += fmt::format("#define HIGHLIGHT_LAYER {}\n#define LOBE_TAPS {}\n",
                           num_layers(radiance.bands(), channels, isotropic), kLobeTaps);
  if (sun) defines += fmt::format("#define SUN\n#define CHANNELS {}\n", channels);
  const std::string reflect =
      defines + std::string(shaders::reflect_glsl) + make_reflectance_glsl({radiance.bands(), channels, isotropic});
  gl::Program program =
      shade == Shade::kPixel
          ? gl::Program(shaders::mesh_vert, shaders::surface_frag,
                        std::string(shaders::seen_normal_glsl) + std::string(shaders::reflectance_frag) + reflect)
          : gl::Program(std::string(shaders::reflectance_vertex_vert) + reflect, shaders::surface_frag,
                        shaders::reflectance_vertex_frag);
  program.use();
  program.set("u_reflectance", 1);
  program.set("u_residual", 2);
  program.set("u_slope_density", 3);
  set_radiance_uniforms(program, radiance);
  return program;
}

ReflectanceRenderer::ReflectanceRenderer(std::span<const SurfaceReflectance> surfaces, const RgbCoefficients& radiance,
                                         Shade shade, const HighlightLight* highlights, double unit)
    : radiance_(radiance), sun_coefficients_(radiance.bands()) {
  if (highlights) {
    SHLIGHT_ASSERT_EQ(highlights->surfaces.size(), surfaces.size());
    sun_coefficients_ = scaled(unit, highlights->sun_coefficients);
    SHLIGHT_ASSERT_EQ(sun_coefficients_.bands(), radiance.bands());
    if (highlights->sun) {
      const Rgb c = unit * highlights->sun->irradiance;
      to_sun_ = vec_cast<float>(highlights->sun->direction);
      sun_irradiance_ = vec_cast<float>(Vec3d{c.r, c.g, c.b});
    }
  }
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const SurfaceReflectance& reflectance = surfaces[i];
    // Tables made beside a highlight leave out what it reflects.
    if (!highlights) SHLIGHT_ASSERT_EQ(reflectance.highlight.has_value(), false);
    const bool isotropic = !reflectance.plain || reflectance.plain->isotropic();
    Kind kind = {channels_of(reflectance), isotropic, reflectance.colors.has_value()};
    Surface surface;
    surface.colors = reflectance.colors;
    if (reflectance.plain) {
      SHLIGHT_ASSERT_EQ(reflectance.plain->bands, radiance.bands());
      surface.table = upload_table(reflectance);
    }
    if (reflectance.highlight) {
      const LobeFromAbove& lobe = reflectance.highlight->lobe;
      const auto& [cube, sun_share] = highlights->surfaces[i];
      kind.hybrid = true;
      kind.sun = sun_share > 0;
      surface.residual = upload_cube(cube, unit);
      surface.slopes = lobe.slopes;
      surface.wide_along_x = lobe.wide_along_x;
      if (kind.sun) {
        surface.slope_density = upload_slope_density(lobe.slope_density);
        surface.slope_scale = vec_cast<float>(Vec3d{lobe.wide_along_x ? lobe.slim_over_wide : 1,
                                                    lobe.wide_along_x ? 1 : lobe.slim_over_wide, lobe.width});
      }
      surface.sun_share = sun_share;
    }
    if (!programs_.contains(kind)) programs_.emplace(kind, make_program(kind, radiance, shade));
    surface.program = &programs_.at(kind);
    surfaces_.push_back(std::move(surface));
    needs_tangents_ = needs_tangents_ || !isotropic;
  }
}

void ReflectanceRenderer::set_radiance(const RgbCoefficients& radiance) {
  radiance_ = radiance;
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
    glActiveTexture(GL_TEXTURE3);
    glBindTexture(GL_TEXTURE_2D, surface.slope_density.id());
    const gl::Program& program = *surface.program;
    program.use();
    program.set("u_slopes", surface.slopes);
    program.set("u_wide_along_x", surface.wide_along_x ? 1 : 0);
    if (surface.sun_share > 0) {
      program.set("u_to_sun", to_sun_);
      program.set("u_sun_irradiance", static_cast<float>(surface.sun_share) * sun_irradiance_);
      program.set("u_slope_scale", surface.slope_scale);
      RgbCoefficients without_sun = radiance_;
      for (std::size_t i = 0; i < without_sun.size(); ++i)
        without_sun[i] = without_sun[i] - surface.sun_share * sun_coefficients_[i];
      set_radiance_uniforms(program, without_sun);
    }
    if (surface.colors) {
      program.set("u_plain_color", surface.colors->plain);
      program.set("u_tinted_color", surface.colors->tinted);
    }
    return program;
  };
  scene.draw(program_of, view, light_to_world);
}

}  // namespace shlight
