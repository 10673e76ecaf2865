#pragma once

#include <functional>
#include <string>

#include "shlight/core/progress.h"
#include "shlight/image/image.h"
#include "shlight/scene/scene.h"
#include "shlight/sh/coefficients.h"

namespace shlight {

// Turns around the point looked at. Azimuth 0 and elevation 0 look down -Z; azimuth turns the camera toward +X, so
// that azimuth 90 looks down -X; elevation raises it.
struct Camera {
  double azimuth = 30;       // degrees
  double elevation = 15;     // degrees, in [-90, 90]
  double zoom = 1;           // 1 frames the whole model; 2 is twice as near
  double vertical_fov = 35;  // degrees
};

struct RenderParams {
  int width = 1280;
  int height = 720;
  int bands = 3;  // of the irradiance, 1 to 10
  Camera camera;
  double rotate_light = 0;  // degrees about +Y, counter-clockwise seen from above
  double exposure = 0;      // stops, on top of what makes the light's mean radiance middle grey
  int frames = 1;           // more: drawn with the view turning, for timing
  bool show_background = true;
};

// A distant light as the renderer needs it.
struct RenderLight {
  RgbCoefficients coefficients;  // of radiance
  Image background;              // lat-long radiance, drawn at infinity; empty: reconstructed from the coefficients
};

struct RenderResult {
  Image radiance;       // linear, as lit, without exposure
  Image8 picture;       // exposed, tone mapped, sRGB
  double frame_ms = 0;  // median over the frames
  std::string gl_renderer;
};

// Draws `scene` under `light` by the irradiance method, on OpenGL ES 3.0 without a window. Throws Error where there is
// no such OpenGL; Cancelled.
RenderResult render_irradiance(const Scene& scene, const RenderLight& light, const RenderParams& params,
                               const Progress& progress = {});

}  // namespace shlight
