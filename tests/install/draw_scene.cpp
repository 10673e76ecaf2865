// A picture of the built-in scene under the built-in sky, on a machine without a screen: draw_scene FILE.png

#include <cstdio>

#include "shlight/core/error.h"
#include "shlight/image/image_io.h"
#include "shlight/light/builtin_light.h"
#include "shlight/render/render.h"
#include "shlight/scene/load_scene.h"

int main(int argc, char** argv) try {
  if (argc != 2) return 2;
  const auto sky = shlight::make_builtin_light("sky");
  shlight::RenderParams params;
  params.width = 320, params.height = 180;
  const shlight::RenderResult result = shlight::render_irradiance(
      shlight::make_scene("builtin:scene"), {sky->project(params.bands), sky->lat_long(256)}, params);
  shlight::save_image8(argv[1], result.picture);
  std::printf("%g ms a frame on %s\n", result.frame_ms, result.gl_renderer.c_str());
  return 0;
} catch (const shlight::Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
