#include "shlight/render/frame_renderer.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace shlight {

double exposed(const LightScale& scale, const FrameParams& frame) {
  return scale.exposure / scale.unit * std::exp2(frame.exposure);
}

FrameRenderer::FrameRenderer(int width, int height)
    : width_(width), height_(height), radiance_(width, height), picture_(width, height) {}

void FrameRenderer::draw(const Drawing& drawing, const FrameParams& frame) const {
  clear();
  add_surfaces(drawing, frame);
  add_background(drawing, frame);
  average();
  make_picture(drawing, frame);
}

View FrameRenderer::view(const Drawing& drawing, const FrameParams& frame) const {
  return make_view(frame.camera, drawing.extent, static_cast<double>(width_) / height_);
}

void FrameRenderer::clear() const {
  radiance_.begin();
}

void FrameRenderer::add_surfaces(const Drawing& drawing, const FrameParams& frame) const {
  radiance_.resume();
  draw_surfaces(drawing.surfaces, drawing.scene, view(drawing, frame), frame.rotate_light);
}

void FrameRenderer::add_background(const Drawing& drawing, const FrameParams& frame) const {
  radiance_.resume();
  if (drawing.background) drawing.background->draw(view(drawing, frame), frame.rotate_light);
}

void FrameRenderer::average() const {
  radiance_.resolve();
}

void FrameRenderer::make_picture(const Drawing& drawing, const FrameParams& frame) const {
  unit_ = drawing.scale.unit;
  picture_.begin();
  tone_mapper_.draw(radiance_.texture(), exposed(drawing.scale, frame), frame.curve);
}

Image FrameRenderer::read_radiance() const {
  return radiance_.read(1 / unit_);
}

RadiancePicture::RadiancePicture(int width, int height) : width_(width), height_(height), picture_(width, height) {}

void RadiancePicture::set(const Image& radiance, double unit) {
  constexpr float kLargestHalf = 65504;
  std::vector<float> rgba(4 * static_cast<std::size_t>(width_) * height_);
  float* out = rgba.data();
  for (int row = height_ - 1; row >= 0; --row)  // OpenGL's rows begin at the bottom
    for (int x = 0; x < width_; ++x, out += 4) {
      const auto pixel = radiance.pixel(x * radiance.width / width_, row * radiance.height / height_);
      for (int c = 0; c < 3; ++c)
        out[c] = std::min(static_cast<float>(unit) * pixel[static_cast<std::size_t>(c)], kLargestHalf);
    }
  if (radiance_.id() == 0) {
    radiance_ = gl::make_texture();
    glBindTexture(GL_TEXTURE_2D, radiance_.id());
    glTexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA16F, width_, height_);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  }
  glBindTexture(GL_TEXTURE_2D, radiance_.id());
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width_, height_, GL_RGBA, GL_FLOAT, rgba.data());
  gl::check_errors("a picture of radiance");
}

void RadiancePicture::draw(double exposed, ToneCurve curve) const {
  picture_.begin();
  tone_mapper_.draw(radiance_.id(), exposed, curve);
}

}  // namespace shlight
