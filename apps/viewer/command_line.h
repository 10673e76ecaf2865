#pragma once

#include <string>

#include "settings.h"

namespace shlight::viewer {

// The `shlight render` line that draws what one side shows in a picture of this size. `samples` are the paths a pixel
// that a reference has come to. Ready for a shell.
std::string render_command(const Settings& settings, const Look& look, int width, int height, int samples);

}  // namespace shlight::viewer
