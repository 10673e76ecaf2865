#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "settings.h"

namespace shlight::viewer {

struct ViewerParams {
  Settings settings;
  int width = 1280, height = 800;
  double scale = 0;                     // of text and controls; 0: as the display wants it
  std::filesystem::path script;         // drives the window without hands; docs/viewer.md has the language
  std::filesystem::path screenshot;     // of the whole window, when the script has ended or all is drawn; then closes
  std::function<bool()> asked_to_stop;  // closes the window; may be empty
};

// Opens the window and stays until it is closed. Throws Error where there is no display, where the model or the light
// cannot be loaded in the first place, and where a line of the script fails.
void run_viewer(const ViewerParams& params);

}  // namespace shlight::viewer
