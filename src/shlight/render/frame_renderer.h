#pragma once

#include <utility>

#include "shlight/image/image.h"
#include "shlight/image/tone_map.h"
#include "shlight/render/background.h"
#include "shlight/render/gpu_scene.h"
#include "shlight/render/render_light.h"
#include "shlight/render/surface_renderer.h"
#include "shlight/render/targets.h"
#include "shlight/render/tone_map.h"
#include "shlight/scene/camera.h"

namespace shlight {

// What a frame shows: a scene, how its surfaces are lit, and the light behind it, all of them in the light's unit.
struct Drawing {
  const GpuScene& scene;
  Extent extent;
  const SurfaceRenderer& surfaces;
  const Background* background = nullptr;  // none: black
  LightScale scale;
};

// How it is seen.
struct FrameParams {
  Camera camera;
  Rotation rotate_light;
  double exposure = 0;  // stops, on top of Drawing::scale
  ToneCurve curve = ToneCurve::kFilmic;
};

// The factor from what is drawn in the light's unit to exposed radiance.
double exposed(const LightScale& scale, const FrameParams& frame);

// Draws frames of one size, by any method: the one way from a scene on the graphics card to a picture. Needs the
// context in which it was made.
class FrameRenderer {
 public:
  // Throws Error where the driver cannot make so large a picture.
  FrameRenderer(int width, int height);

  void draw(const Drawing& drawing, const FrameParams& frame) const;
  // The same in steps, for who draws a scene in parts (FrameInParts): clear(), add_surfaces() for each range of the
  // scene's triangles, add_background(), average(), and make_picture(), after which there is a new picture. Each but
  // the first and the last may be confined to some rows by OpenGL's scissor.
  void clear() const;
  void add_surfaces(const Drawing& drawing, const FrameParams& frame) const;
  void add_background(const Drawing& drawing, const FrameParams& frame) const;
  void average() const;
  void make_picture(const Drawing& drawing, const FrameParams& frame) const;
  // Exchanges the picture that was drawn for a target of the same size, which the next one will be drawn into.
  void swap_picture(PictureTarget& other) { std::swap(picture_, other); }

  // Linear radiance of what was drawn last, in the light's own unit.
  Image read_radiance() const;
  Image8 read_picture() const { return picture_.read(); }
  // RGBA8, rows from the bottom.
  unsigned texture() const { return picture_.texture(); }
  int width() const { return width_; }
  int height() const { return height_; }

 private:
  View view(const Drawing& drawing, const FrameParams& frame) const;

  int width_, height_;
  RadianceTarget radiance_;
  PictureTarget picture_;
  ToneMapper tone_mapper_;
  mutable double unit_ = 1;  // of what was drawn last
};

// A picture of radiance that was made elsewhere, shown with any exposure and curve: the reference, for instance.
class RadiancePicture {
 public:
  RadiancePicture(int width, int height);

  // `radiance` of any size; stretched over the picture, each pixel as a rectangle.
  void set(const Image& radiance, double unit);
  void draw(double exposed, ToneCurve curve) const;
  void swap_picture(PictureTarget& other) { std::swap(picture_, other); }  // as FrameRenderer does
  Image8 read_picture() const { return picture_.read(); }
  unsigned texture() const { return picture_.texture(); }
  int width() const { return width_; }
  int height() const { return height_; }

 private:
  int width_, height_;
  gl::Texture radiance_;
  PictureTarget picture_;
  ToneMapper tone_mapper_;
};

}  // namespace shlight
