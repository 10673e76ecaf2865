#include "shlight/render/transfer_renderer.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shaders.h"
#include "shlight/core/assert.h"
#include "shlight/core/error.h"
#include "shlight/transfer/quantise.h"

namespace shlight {
namespace {

// Vertices a row of the textures, as in transfer.vert: the largest width that every OpenGL ES 3.0 has.
constexpr int kRow = 2048;

constexpr int num_layers(int bands) {
  return (num_coefficients(bands) + 3) / 4;
}

// Layers lie behind each other so that vertices drawn after each other read memory side by side. 16 bands of three
// channels are 192 of the 256 layers, and the light's coefficients 192 of the 256 uniform vectors, that every OpenGL
// ES 3.0 has; u_light of transfer_sum.vert has as many.
static_assert(num_layers(kMaxTransferBands) == 64);

// Four numbers of a vertex's code in each: its cluster and its weights.
int num_code_layers(const ClusteredPca& pca) {
  return (pca.components + 4) / 4;
}

// How OpenGL takes four of them.
struct PixelFormat {
  GLenum internal, format, type;
};
template <class Number>
constexpr PixelFormat kPixelFormat = {GL_RGBA32F, GL_RGBA, GL_FLOAT};
template <>
constexpr PixelFormat kPixelFormat<std::int16_t> = {GL_RGBA16I, GL_RGBA_INTEGER, GL_SHORT};
template <>
constexpr PixelFormat kPixelFormat<std::int8_t> = {GL_RGBA8I, GL_RGBA_INTEGER, GL_BYTE};

void set_nearest(GLenum target) {
  glTexParameteri(target, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(target, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

int num_rows(std::size_t vertices) {
  return static_cast<int>(std::max<std::size_t>((vertices + kRow - 1) / kRow, 1));
}

gl::Texture make_layers(std::size_t vertices, int layers, GLenum internal_format) {
  const int rows = num_rows(vertices), max_rows = gl::get_integer(GL_MAX_TEXTURE_SIZE);
  if (rows > max_rows)
    throw Error("OpenGL", fmt::format("transfer of {} vertices cannot be drawn", vertices),
                fmt::format("at most {}", static_cast<std::size_t>(max_rows) * kRow));
  gl::Texture texture = gl::make_texture();
  glBindTexture(GL_TEXTURE_2D_ARRAY, texture.id());
  glTexStorage3D(GL_TEXTURE_2D_ARRAY, 1, internal_format, kRow, rows, layers);
  set_nearest(GL_TEXTURE_2D_ARRAY);
  gl::check_errors("the transfer's texture");
  return texture;
}

// A pixel of a layer belongs to a vertex, row by row: fill_pixel(vertex, pixel) writes its four numbers, which were
// zeros.
template <class Number, class FillPixel>
void upload_layer(const gl::Texture& texture, std::size_t vertices, int layer, const FillPixel& fill_pixel) {
  constexpr PixelFormat kFormat = kPixelFormat<Number>;
  const int rows = num_rows(vertices);
  std::vector<Number> values(4 * static_cast<std::size_t>(kRow) * static_cast<std::size_t>(rows));
  for (std::size_t v = 0; v < vertices; ++v) fill_pixel(v, &values[4 * v]);
  glBindTexture(GL_TEXTURE_2D_ARRAY, texture.id());
  glTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, layer, kRow, rows, 1, kFormat.format, kFormat.type, values.data());
  gl::check_errors("the transfer's texture");
}

// Four coefficients of a channel of all vertices, of their first `bands` bands; `encode` makes the Number of
// coefficient i of the row of all channels.
template <class Number, class Encode>
void upload_layer(const gl::Texture& texture, const Transfer& transfer, int bands, int layer, const Encode& encode) {
  const auto stride = static_cast<std::size_t>(num_coefficients(transfer.bands));
  const auto used = static_cast<std::size_t>(num_coefficients(bands));
  const auto channels = static_cast<std::size_t>(transfer.channels);
  const auto first = static_cast<std::size_t>(4 * (layer % num_layers(bands)));
  const std::size_t at = static_cast<std::size_t>(layer / num_layers(bands)) * stride + first;
  upload_layer<Number>(texture, transfer.num_vertices(), layer, [&](std::size_t v, Number* pixel) {
    for (std::size_t i = 0; i < std::min<std::size_t>(4, used - first); ++i)
      pixel[i] = encode(transfer.coefficients[v * channels * stride + at + i], at + i);
  });
}

GLenum internal_format(int bits) {
  return bits == 8    ? kPixelFormat<std::int8_t>.internal
         : bits == 16 ? kPixelFormat<std::int16_t>.internal
                      : kPixelFormat<float>.internal;
}

// What a number 1 in the texture stands for, for each coefficient and channel.
RgbCoefficients number_scales(const Transfer& transfer, int bands, int bits, std::span<const float> scales) {
  const auto n = static_cast<std::size_t>(num_coefficients(transfer.bands));
  RgbCoefficients result(bands);
  for (std::size_t i = 0; i < result.size(); ++i) {
    if (bits == 32) {
      result[i] = {1, 1, 1};
      continue;
    }
    const auto scale = [&](int channel) {
      return double{
          dequantise(1, scales[static_cast<std::size_t>(std::min(channel, transfer.channels - 1)) * n + i], bits)};
    };
    result[i] = {scale(0), scale(1), scale(2)};
  }
  return result;
}

// `scales` are those of `bits`, where they are fewer than 32.
gl::Texture upload_numbers(const Transfer& transfer, int bands, int bits, std::span<const float> scales) {
  const int layers = transfer.channels * num_layers(bands);
  gl::Texture texture = make_layers(transfer.num_vertices(), layers, internal_format(bits));
  const auto number = [&](float a, std::size_t i) { return quantise(a, scales[i], bits); };
  for (int layer = 0; layer < layers; ++layer) {
    if (bits == 8)
      upload_layer<std::int8_t>(texture, transfer, bands, layer,
                                [&](float a, std::size_t i) { return static_cast<std::int8_t>(number(a, i)); });
    else if (bits == 16)
      upload_layer<std::int16_t>(texture, transfer, bands, layer,
                                 [&](float a, std::size_t i) { return static_cast<std::int16_t>(number(a, i)); });
    else
      upload_layer<float>(texture, transfer, bands, layer, [](float a, std::size_t) { return a; });
  }
  return texture;
}

gl::Texture upload_codes(const ClusteredPca& pca) {
  const std::size_t n = pca.rows_per_cluster();
  gl::Texture texture = make_layers(pca.num_vertices(), num_code_layers(pca), internal_format(16));
  for (std::size_t layer = 0; layer < static_cast<std::size_t>(num_code_layers(pca)); ++layer)
    upload_layer<std::int16_t>(
        texture, pca.num_vertices(), static_cast<int>(layer), [&](std::size_t v, std::int16_t* pixel) {
          std::copy_n(&pca.codes[v * n + 4 * layer], std::min<std::size_t>(4, n - 4 * layer), pixel);
        });
  return texture;
}

gl::Texture make_rows(const ClusteredPca& pca) {
  gl::Texture texture = gl::make_texture();
  glBindTexture(GL_TEXTURE_2D, texture.id());
  glTexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA32F, 4 * num_code_layers(pca), pca.clusters);
  set_nearest(GL_TEXTURE_2D);
  gl::check_errors("the texture of clusters");
  return texture;
}

// u_rows of transfer_pca.vert, into the texture now bound.
void fill_rows(const ClusteredPca& pca, const RgbCoefficients& light) {
  const std::vector<Rgb> radiance = light_pca(pca, light);
  const std::size_t n = pca.rows_per_cluster(), width = 4 * static_cast<std::size_t>(num_code_layers(pca));
  std::vector<float> pixels(4 * width * static_cast<std::size_t>(pca.clusters));
  for (std::size_t k = 0; k < radiance.size(); ++k) {
    float* pixel = &pixels[4 * (k / n * width + k % n)];
    pixel[0] = static_cast<float>(radiance[k].r);
    pixel[1] = static_cast<float>(radiance[k].g);
    pixel[2] = static_cast<float>(radiance[k].b);
  }
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, static_cast<GLsizei>(width), pca.clusters, GL_RGBA, GL_FLOAT, pixels.data());
}

// u_light of transfer_sum.vert.
std::vector<gl::Mat3x4f> light_matrices(const RgbCoefficients& radiance, const RgbCoefficients& scales) {
  std::vector<gl::Mat3x4f> matrices(static_cast<std::size_t>(num_layers(radiance.bands())), gl::Mat3x4f{});
  for (std::size_t i = 0; i < radiance.size(); ++i) {
    gl::Mat3x4f& matrix = matrices[i / 4];
    matrix[i % 4] = static_cast<float>(radiance[i].r * scales[i].r);
    matrix[4 + i % 4] = static_cast<float>(radiance[i].g * scales[i].g);
    matrix[8 + i % 4] = static_cast<float>(radiance[i].b * scales[i].b);
  }
  return matrices;
}

std::string joined(std::initializer_list<std::string_view> sources) {
  std::string text;
  for (const std::string_view source : sources) text += source;
  return text;
}

}  // namespace

TransferRenderer::TransferRenderer(const Transfer& transfer, const RgbCoefficients& radiance, int bits)
    : num_vertices_(transfer.num_vertices()),
      radiance_(resize_bands(radiance, std::min(radiance.bands(), transfer.bands))),
      program_(joined({shaders::transfer_vert, shaders::transfer_sum_vert,
                       bits == 32 ? shaders::transfer_floats_vert : shaders::transfer_numbers_vert}),
               shaders::surface_frag, shaders::transfer_frag) {
  SHLIGHT_ASSERT_LE(1, radiance_.bands());
  SHLIGHT_ASSERT_LE(radiance_.bands(), kMaxTransferBands);
  SHLIGHT_ASSERT_EQ(transfer.channels == 1 || transfer.channels == 3, true);
  SHLIGHT_ASSERT_EQ(is_transfer_bits(bits), true);
  SHLIGHT_ASSERT_EQ(transfer.coefficients.size(), num_vertices_ * static_cast<std::size_t>(transfer.channels) *
                                                      static_cast<std::size_t>(num_coefficients(transfer.bands)));
  const std::vector<float> scales = bits < 32 ? quantisation_scales(transfer) : std::vector<float>();
  transfer_ = upload_numbers(transfer, radiance_.bands(), bits, scales);
  scales_ = number_scales(transfer, radiance_.bands(), bits, scales);
  program_.use();
  program_.set("u_transfer", 1);
  program_.set("u_colored", transfer.channels == 3 ? 1 : 0);
  program_.set("u_layers", num_layers(radiance_.bands()));
}

TransferRenderer::TransferRenderer(const ClusteredPca& pca, const RgbCoefficients& radiance)
    : num_vertices_(pca.num_vertices()),
      radiance_(radiance),
      pca_(ClusteredPca{pca.bands, pca.channels, pca.clusters, pca.components, pca.table, {}}),
      program_(joined({shaders::transfer_vert, shaders::transfer_pca_vert}), shaders::surface_frag,
               shaders::transfer_frag),
      transfer_(upload_codes(pca)),
      rows_(make_rows(pca)) {
  SHLIGHT_ASSERT_LE(pca.clusters, kMaxPcaClusters);
  program_.use();
  program_.set("u_transfer", 1);
  program_.set("u_rows", 2);
  program_.set("u_layers", num_code_layers(pca));
}

void TransferRenderer::set_radiance(const RgbCoefficients& radiance) {
  radiance_ = resize_bands(radiance, radiance_.bands());
}

void TransferRenderer::mark_negative(Vec3f radiance) {
  program_.use();
  program_.set("u_negative", radiance);
}

void TransferRenderer::draw(const GpuScene& scene, const View& view, const Rotation& light_to_world) const {
  SHLIGHT_ASSERT_EQ(scene.num_vertices(), num_vertices_);
  program_.use();
  const RgbCoefficients radiance = rotate(light_to_world, radiance_);
  if (pca_) {
    glActiveTexture(GL_TEXTURE2);
    glBindTexture(GL_TEXTURE_2D, rows_.id());
    fill_rows(*pca_, radiance);
  } else {
    program_.set("u_light", light_matrices(radiance, scales_));
  }
  glActiveTexture(GL_TEXTURE1);
  glBindTexture(GL_TEXTURE_2D_ARRAY, transfer_.id());
  scene.draw(program_, view, light_to_world);
}

}  // namespace shlight
