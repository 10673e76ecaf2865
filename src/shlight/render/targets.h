#pragma once

#include "shlight/image/image.h"
#include "shlight/render/gl.h"

namespace shlight {

// Framebuffers to draw into. All need a current context; constructors throw Error where the driver cannot make them:
// too big, out of memory, no EXT_color_buffer_float.

// Linear radiance in half floats with a 24-bit depth buffer, antialiased: several samples a pixel, averaged by
// resolve(). The average is of radiance, as a camera's pixel takes it, so an edge against a light that is many times
// white stays hard.
class RadianceTarget {
 public:
  RadianceTarget(int width, int height);

  // Binds it, sets the viewport, clears to black and far.
  void begin() const;
  // The same, but keeps what is there.
  void resume() const;
  // Averages the samples into texture().
  void resolve() const;
  // RGBA16F, one value a pixel, rows from the bottom.
  unsigned texture() const { return texture_.id(); }
  // What resolve() made, multiplied by `scale`, rows from the top.
  Image read(double scale) const;

 private:
  int width_, height_;
  gl::Renderbuffer color_, depth_;
  gl::Texture texture_;
  gl::Framebuffer samples_, resolved_;
};

// An eight-bit picture.
class PictureTarget {
 public:
  PictureTarget(int width, int height);

  // Binds it and sets the viewport.
  void begin() const;
  // Rows from the top, alpha 255.
  Image8 read() const;
  // RGBA8, rows from the bottom.
  unsigned texture() const { return texture_.id(); }
  int width() const { return width_; }
  int height() const { return height_; }

 private:
  int width_, height_;
  gl::Texture texture_;
  gl::Framebuffer framebuffer_;
};

// The window that the current context draws into.
class WindowTarget {
 public:
  // Binds it, sets the viewport, clears it to a grey of this sRGB value.
  static void begin(int width, int height, double grey);
  // What was drawn, before it is shown: rows from the top, alpha 255.
  static Image8 read(int width, int height);
  // Forgets OpenGL's errors of whoever else draws into the window, so that no later check takes them for its own.
  static void forget_errors();
};

// A picture that pixels are uploaded into, for those who draw with textures.
class PictureTexture {
 public:
  explicit PictureTexture(const Image8& picture);
  // RGBA8, rows from the top.
  unsigned texture() const { return texture_.id(); }
  int width() const { return width_; }
  int height() const { return height_; }

 private:
  int width_, height_;
  gl::Texture texture_;
};

}  // namespace shlight
