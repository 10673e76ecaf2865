#include "shlight/render/transfer_renderer.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "shaders.h"
#include "shlight/core/assert.h"
#include "shlight/core/error.h"

namespace shlight {
namespace {

// Vertices a row of the texture: the largest width that every OpenGL ES 3.0 has.
constexpr int kRow = 2048;

constexpr int num_layers(int bands) {
  return (num_coefficients(bands) + 3) / 4;
}

// Layers lie behind each other so that vertices drawn after each other read memory side by side. 16 bands of three
// channels are 192 of the 256 layers, and the light's coefficients 192 of the 256 uniform vectors, that every OpenGL
// ES 3.0 has; u_light of transfer.vert has as many.
static_assert(num_layers(kMaxTransferBands) == 64);

// What transfer.vert reads: the first `bands` bands of all vertices, a layer for every four coefficients of a channel.
gl::Texture upload_transfer(const Transfer& transfer, int bands) {
  const std::size_t vertices = transfer.num_vertices();
  const auto rows = static_cast<int>(std::max<std::size_t>((vertices + kRow - 1) / kRow, 1));
  const int max_rows = gl::get_integer(GL_MAX_TEXTURE_SIZE);
  if (rows > max_rows)
    throw Error("OpenGL", fmt::format("transfer of {} vertices cannot be drawn", vertices),
                fmt::format("at most {}", static_cast<std::size_t>(max_rows) * kRow));
  const int layers = num_layers(bands);
  gl::Texture texture = gl::make_texture();
  glBindTexture(GL_TEXTURE_2D_ARRAY, texture.id());
  glTexStorage3D(GL_TEXTURE_2D_ARRAY, 1, GL_RGBA32F, kRow, rows, transfer.channels * layers);
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAG_FILTER, GL_NEAREST);

  const auto stride = static_cast<std::size_t>(num_coefficients(transfer.bands));
  const auto used = static_cast<std::size_t>(num_coefficients(bands));
  std::vector<float> values(4 * static_cast<std::size_t>(kRow) * static_cast<std::size_t>(rows));
  for (int channel = 0; channel < transfer.channels; ++channel)
    for (int layer = 0; layer < layers; ++layer) {
      const std::size_t first = 4 * static_cast<std::size_t>(layer), count = std::min<std::size_t>(4, used - first);
      std::ranges::fill(values, 0.0f);
      for (std::size_t v = 0; v < vertices; ++v) {
        const std::size_t vector = v * static_cast<std::size_t>(transfer.channels) + static_cast<std::size_t>(channel);
        std::copy_n(transfer.coefficients.data() + vector * stride + first, count, values.data() + 4 * v);
      }
      glTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, channel * layers + layer, kRow, rows, 1, GL_RGBA, GL_FLOAT,
                      values.data());
    }
  gl::check_errors("the transfer's texture");
  return texture;
}

// u_light of transfer.vert.
std::vector<gl::Mat3x4f> light_matrices(const RgbCoefficients& radiance) {
  std::vector<gl::Mat3x4f> matrices(static_cast<std::size_t>(num_layers(radiance.bands())), gl::Mat3x4f{});
  for (std::size_t i = 0; i < radiance.size(); ++i) {
    gl::Mat3x4f& matrix = matrices[i / 4];
    matrix[i % 4] = static_cast<float>(radiance[i].r);
    matrix[4 + i % 4] = static_cast<float>(radiance[i].g);
    matrix[8 + i % 4] = static_cast<float>(radiance[i].b);
  }
  return matrices;
}

}  // namespace

TransferRenderer::TransferRenderer(const Transfer& transfer, const RgbCoefficients& radiance)
    : num_vertices_(transfer.num_vertices()),
      radiance_(resize_bands(radiance, std::min(radiance.bands(), transfer.bands))),
      program_(shaders::transfer_vert, shaders::surface_frag, shaders::transfer_frag) {
  SHLIGHT_ASSERT_LE(1, radiance_.bands());
  SHLIGHT_ASSERT_LE(radiance_.bands(), kMaxTransferBands);
  SHLIGHT_ASSERT_EQ(transfer.channels == 1 || transfer.channels == 3, true);
  SHLIGHT_ASSERT_EQ(transfer.coefficients.size(), num_vertices_ * static_cast<std::size_t>(transfer.channels) *
                                                      static_cast<std::size_t>(num_coefficients(transfer.bands)));
  transfer_ = upload_transfer(transfer, radiance_.bands());
  program_.use();
  program_.set("u_transfer", 1);
  program_.set("u_colored", transfer.channels == 3 ? 1 : 0);
  program_.set("u_layers", num_layers(radiance_.bands()));
}

void TransferRenderer::mark_negative(Vec3f radiance) {
  program_.use();
  program_.set("u_negative", radiance);
}

void TransferRenderer::draw(const GpuScene& scene, const View& view, const Rotation& light_to_world) const {
  SHLIGHT_ASSERT_EQ(scene.num_vertices(), num_vertices_);
  program_.use();
  program_.set("u_light", light_matrices(rotate(light_to_world, radiance_)));
  glActiveTexture(GL_TEXTURE1);
  glBindTexture(GL_TEXTURE_2D_ARRAY, transfer_.id());
  scene.draw(program_, view, light_to_world);
}

}  // namespace shlight
