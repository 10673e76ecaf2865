#include "shlight/render/targets.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "shlight/core/error.h"

namespace shlight {
namespace {

// More is hardly seen, and costs memory and time.
constexpr int kMaxSamples = 4;

void check_size(int width, int height) {
  GLint viewport[2] = {};
  glGetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport);
  const int limit = std::min(gl::get_integer(GL_MAX_TEXTURE_SIZE), gl::get_integer(GL_MAX_RENDERBUFFER_SIZE));
  const int max_width = std::min(limit, viewport[0]), max_height = std::min(limit, viewport[1]);
  if (width < 1 || height < 1 || width > max_width || height > max_height)
    throw Error("OpenGL", fmt::format("a picture of {}x{} pixels cannot be drawn", width, height),
                fmt::format("1x1 to {}x{}", max_width, max_height));
}

// Samples a pixel that the driver has for RGBA16F, at most kMaxSamples. It lists them from the most.
int num_samples() {
  GLint count = 0;
  glGetInternalformativ(GL_RENDERBUFFER, GL_RGBA16F, GL_NUM_SAMPLE_COUNTS, 1, &count);
  std::vector<GLint> samples(static_cast<std::size_t>(std::max(count, 0)));
  if (count > 0) glGetInternalformativ(GL_RENDERBUFFER, GL_RGBA16F, GL_SAMPLES, count, samples.data());
  for (const GLint n : samples)
    if (n <= kMaxSamples) return n;
  return 0;
}

gl::Texture make_target_texture(unsigned format, int width, int height) {
  gl::Texture texture = gl::make_texture();
  glBindTexture(GL_TEXTURE_2D, texture.id());
  glTexStorage2D(GL_TEXTURE_2D, 1, format, width, height);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  return texture;
}

// Of a framebuffer's eight-bit colours, rows from the top.
Image8 read_picture(unsigned framebuffer, int width, int height) {
  const std::size_t row_bytes = 4 * static_cast<std::size_t>(width);
  std::vector<unsigned char> bottom_up(row_bytes * static_cast<std::size_t>(height));
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
  glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, bottom_up.data());
  Image8 image = {width, height, std::vector<unsigned char>(bottom_up.size())};
  for (int y = 0; y < height; ++y)
    std::copy_n(bottom_up.begin() + static_cast<std::ptrdiff_t>((height - 1 - y) * row_bytes), row_bytes,
                image.values.begin() + static_cast<std::ptrdiff_t>(y * row_bytes));
  return image;
}

}  // namespace

RadianceTarget::RadianceTarget(int width, int height) : width_(width), height_(height) {
  check_size(width, height);
  const int samples = num_samples();
  color_ = gl::make_renderbuffer();
  glBindRenderbuffer(GL_RENDERBUFFER, color_.id());
  glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, GL_RGBA16F, width, height);
  depth_ = gl::make_renderbuffer();
  glBindRenderbuffer(GL_RENDERBUFFER, depth_.id());
  glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, GL_DEPTH_COMPONENT24, width, height);
  samples_ = gl::make_framebuffer();
  glBindFramebuffer(GL_FRAMEBUFFER, samples_.id());
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color_.id());
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_.id());
  const std::string what = fmt::format("a target of {}x{} pixels", width, height);
  gl::check_framebuffer(what);

  texture_ = make_target_texture(GL_RGBA16F, width, height);
  resolved_ = gl::make_framebuffer();
  glBindFramebuffer(GL_FRAMEBUFFER, resolved_.id());
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_.id(), 0);
  gl::check_framebuffer(what);
}

void RadianceTarget::resume() const {
  glBindFramebuffer(GL_FRAMEBUFFER, samples_.id());
  glViewport(0, 0, width_, height_);
}

void RadianceTarget::begin() const {
  resume();
  glClearColor(0, 0, 0, 1);
  glDepthMask(GL_TRUE);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

void RadianceTarget::resolve() const {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, samples_.id());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved_.id());
  glBlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

Image RadianceTarget::read(double scale) const {
  // OpenGL ES reads float framebuffers as four floats only, with rows from the bottom.
  std::vector<float> rgba(4 * static_cast<std::size_t>(width_) * height_);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, resolved_.id());
  glReadPixels(0, 0, width_, height_, GL_RGBA, GL_FLOAT, rgba.data());
  Image image(width_, height_);
  const float* p = rgba.data();
  for (int y = height_ - 1; y >= 0; --y)
    for (int x = 0; x < width_; ++x, p += 4) image.set_rgb(x, y, scale * Rgb{p[0], p[1], p[2]});
  return image;
}

PictureTarget::PictureTarget(int width, int height) : width_(width), height_(height) {
  check_size(width, height);
  texture_ = make_target_texture(GL_RGBA8, width, height);
  // Who shows it larger than it is wants no steps.
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  framebuffer_ = gl::make_framebuffer();
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_.id(), 0);
  gl::check_framebuffer(fmt::format("a picture of {}x{} pixels", width, height));
}

void PictureTarget::begin() const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
  glViewport(0, 0, width_, height_);
}

Image8 PictureTarget::read() const {
  return read_picture(framebuffer_.id(), width_, height_);
}

void WindowTarget::begin(int width, int height, double grey) {
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glViewport(0, 0, width, height);
  const auto value = static_cast<float>(grey);
  glClearColor(value, value, value, 1);
  glClear(GL_COLOR_BUFFER_BIT);
}

Image8 WindowTarget::read(int width, int height) {
  Image8 picture = read_picture(0, width, height);
  for (std::size_t i = 3; i < picture.values.size(); i += 4) picture.values[i] = 255;
  return picture;
}

void WindowTarget::forget_errors() {
  while (glGetError() != GL_NO_ERROR) {
  }
}

PictureTexture::PictureTexture(const Image8& picture)
    : width_(picture.width), height_(picture.height), texture_(make_target_texture(GL_RGBA8, width_, height_)) {
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, picture.values.data());
  gl::check_errors("a picture's texture");
}

}  // namespace shlight
