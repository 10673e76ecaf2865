#include "shlight/render/background.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cstddef>
#include <glm/gtc/packing.hpp>
#include <vector>

#include "shaders.h"
#include "shlight/core/assert.h"
#include "shlight/render/matrices.h"
#include "shlight/render/sh_glsl.h"

namespace shlight {
namespace {

constexpr double kMaxHalf = 65504;

gl::Texture upload_lat_long(const HalfPicture& image) {
  SHLIGHT_ASSERT_EQ(image.rgba.size(),
                    4 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  SHLIGHT_ASSERT_LT(0u, image.rgba.size());
  gl::Texture texture = gl::make_texture();
  glBindTexture(GL_TEXTURE_2D, texture.id());
  glTexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA16F, image.width, image.height);
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, image.width, image.height, GL_RGBA, GL_HALF_FLOAT, image.rgba.data());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  // Around the horizon the picture goes on at its other side; at the poles it ends.
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  gl::check_errors("the background's texture");
  return texture;
}

// Takes (x, y, 1) of the picture, x and y in [-1, 1], to a direction in the light's frame.
glm::dmat3 ndc_to_light(const View& view, const Rotation& light_to_world) {
  const glm::dmat4 projection = to_glm(view.view_to_clip);
  const glm::dmat3 ndc_to_view(1 / projection[0][0], 0, 0, 0, 1 / projection[1][1], 0, 0, 0, -1);
  // The view is a rotation and a scale; the rotation's inverse is its transpose.
  glm::dmat3 view_to_world = glm::transpose(glm::dmat3(to_glm(view.world_to_view)));
  for (int i = 0; i < 3; ++i) view_to_world[i] = glm::normalize(view_to_world[i]);
  return inverse_to_glm(light_to_world) * view_to_world * ndc_to_view;
}

}  // namespace

HalfPicture make_half_picture(const Image& image, double scale) {
  HalfPicture picture = {image.width, image.height, std::vector<std::uint16_t>(4 * image.num_pixels())};
  for (std::size_t i = 0; i < image.values.size(); ++i) {
    const double scaled = scale * double{image.values[i]};
    const float value = scaled > 0 ? static_cast<float>(std::min(scaled, kMaxHalf)) : 0.0f;  // NaN is not above 0
    picture.rgba[4 * (i / 3) + i % 3] = glm::packHalf1x16(value);
  }
  return picture;
}

Background::Background(const HalfPicture& lat_long)
    : program_(shaders::fullscreen_vert, shaders::background_image_frag), image_(upload_lat_long(lat_long)) {}

Background::Background(const Image& lat_long, double scale)
    : Background(make_half_picture(reduce_to_size(lat_long, gl::get_integer(GL_MAX_TEXTURE_SIZE)), scale)) {}

Background::Background(const RgbCoefficients& radiance)
    : program_(shaders::fullscreen_vert, shaders::background_sh_frag, make_sh_glsl(radiance.bands())) {
  program_.use();
  set_radiance_uniforms(program_, radiance);
}

void Background::draw(const View& view, const Rotation& light_to_world) const {
  program_.use();
  program_.set("u_ndc_to_light", to_mat3f(ndc_to_light(view, light_to_world)));
  program_.set("u_image", 0);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, image_.id());
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  glDisable(GL_BLEND);
  gl::draw_fullscreen_triangle();
}

Image reduce_to_size(const Image& image, int max_size) {
  const int k = (std::max(image.width, image.height) + max_size - 1) / max_size;
  if (k <= 1) return image;
  Image reduced((image.width + k - 1) / k, (image.height + k - 1) / k);
  for (int y = 0; y < reduced.height; ++y)
    for (int x = 0; x < reduced.width; ++x) {
      Rgb sum;
      const int y_end = std::min((y + 1) * k, image.height), x_end = std::min((x + 1) * k, image.width);
      for (int yy = y * k; yy < y_end; ++yy)
        for (int xx = x * k; xx < x_end; ++xx) sum += image.rgb(xx, yy);
      reduced.set_rgb(x, y, 1.0 / ((y_end - y * k) * (x_end - x * k)) * sum);
    }
  return reduced;
}

}  // namespace shlight
