#pragma once

#include <memory>
#include <string>

#include "shlight/light/light.h"

namespace shlight {

// Azimuths of lights are those of a lat-long picture: 0 is its middle, −Z, and they grow toward its right, +X.

// Preetham, Shirley & Smits 1999, A Practical Analytic Model for Daylight: the clear sky and the disc of the sun, and
// below the horizon a diffuse ground that they light. In units of 10 kcd/m².
struct SkyParams {
  double elevation = 30;   // of the sun above the horizon, degrees, [0, 90]
  double azimuth = -125;   // of the sun, degrees: behind the left shoulder of who looks along −Z
  double turbidity = 2.2;  // haze: 2 very clear, 10 hazy; [1.7, 10]
  double ground = 0.2;     // the ground's reflectance, [0, 1]
};
std::unique_ptr<Light> make_sky_light(const SkyParams& params);

// A photographer's studio: a warm key soft box, a cool fill, a strip from behind, a wide one overhead, on grey.
std::unique_ptr<Light> make_studio_light();

// One flat lamp of uniform radiance that faces the origin, a rectangle of these sizes in degrees, upright, and a
// uniform background: exact at any number of bands.
struct PanelParams {
  double azimuth = -40;  // of its centre, degrees
  double elevation = 35;
  double width = 40;  // as seen, degrees, (0, 175]
  double height = 30;
  double radiance = 5;
  double background = 0.05;  // radiance from everywhere
};
std::unique_ptr<Light> make_panel_light(const PanelParams& params);

// An orientation test: on each axis a disc of 25° half angle; +X red, −X cyan, +Y green, −Y magenta, +Z blue, −Z
// yellow.
std::unique_ptr<Light> make_axes_light();

// The thesis's light of two lobes (Green 2003), max(0, 5 cos θ − 4) + max(0, −4 sin(θ − π) cos(φ − 2.5) − 3), about z.
std::unique_ptr<Light> make_thesis_light();

// From "sky", "sky:elevation=20,turbidity=4", "studio",
// "panel:width=60,height=10", "axes" or "thesis". Throws Error.
std::unique_ptr<Light> make_builtin_light(const std::string& name_and_parameters);

}  // namespace shlight
