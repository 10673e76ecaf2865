#pragma once

#include <filesystem>
#include <string>

#include "command.h"
#include "shlight/render/render.h"
#include "shlight/transfer/transfer.h"

// What `render` is asked for, from its options (render.cpp) to its methods (render_methods.cpp).

namespace shlight::app {

struct RenderArguments {
  std::string model = "builtin:scene";
  std::string light = "builtin:sky";
  LoadLightParams load;
  LightShape shape;
  double rotate_light = 0;  // degrees about +Y
  std::string method = "irradiance";
  std::string material;  // of reflectance and reference; empty: the model's own
  bool gloss = false;    // of reference: whether the model's own materials show theirs
  BakeParams bake;       // of transfer and reference
  bool kind_given = false, samples_given = false, bounces_given = false, bands_given = false;
  RenderParams params;
  std::filesystem::path output;
  std::filesystem::path deviation;  // of reference
  bool compare = false;             // beside the reference and the error
  int compare_samples = 256;        // paths a pixel of that reference
  bool no_background = false;
  bool json = false;
};

void run_render(const RenderArguments& arguments);

}  // namespace shlight::app
