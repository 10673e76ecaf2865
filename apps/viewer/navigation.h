#pragma once

#include "settings.h"
#include "shlight/scene/camera.h"

namespace shlight::viewer {

// What dragging over the picture does, by these parts of its height to the right and up.
void orbit(Settings& settings, double right, double up);
void pan(Settings& settings, const Extent& extent, double aspect, double right, double up);
void turn_light(Settings& settings, double right, double up);
void zoom(Settings& settings, double steps);

}  // namespace shlight::viewer
