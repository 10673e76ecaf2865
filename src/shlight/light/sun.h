#pragma once

#include <optional>

#include "shlight/image/environment.h"
#include "shlight/sh/coefficients.h"
#include "shlight/sh/vec.h"

// The one small source that outshines all others, taken out of a light, so that it can be a directional light with
// shadows of its own, and what is left is soft enough for a few coefficients.
//
// Nothing is lost: the sun's irradiance is the integral of the radiance that is taken away, channel by channel, so that
// the radiant flux ∫ L of sun and rest together is the light's to rounding. All of it comes from the mean direction of
// what is taken away.
//
// [1] Sloan 2008, Stupid Spherical Harmonics Tricks, GDC, "Extracting conventional lights".

namespace shlight {

struct Sun {
  Vec3d direction;  // unit, toward it
  Rgb irradiance;   // on a surface that faces it
};

// Half of the angle under which the earth sees the sun, in radians.
constexpr double kSunHalfAngle = 0.2665 * 3.14159265358979323846 / 180;

// What is no sun: wider than this, radians, or a smaller share of all light's luminance.
constexpr double kSunMaxHalfAngle = 1.5 * 3.14159265358979323846 / 180;
constexpr double kSunMinShare = 0.005;

// Puts it back: adds a delta light of that irradiance.
void add_sun(const Sun& sun, RgbCoefficients& coefficients);

// Takes the sun out of a picture and leaves in its place the sky around it. Nothing, and the picture as it was, where
// there is none: no source within about kSunMaxHalfAngle that is much brighter than what surrounds it and gives at
// least kSunMinShare of the luminance. Soft boxes, windows and bright clouds are none.
//
// All angles are fixed, whatever the resolution: pictures of one light, 512 pixels around and more, have the same sun
// to 0.12°, a sixth of such a pixel (from 1024 on to 0.03°), and 1 % of its irradiance.
std::optional<Sun> split_sun(Environment& environment, int threads = 0);

// The same from coefficients alone, at least three bands of them: the delta light, of any direction and color, that
// with a constant comes nearest to them in the least-squares sense. Its color is that of [1]; its direction is the
// brightest, for which [1] takes degree 1. Nothing where that leaves more than an eighth of the variation: the
// light is soft, or has several sources. Few bands cannot tell the sun from the glow around it: its irradiance then
// comes out up to twice as large.
std::optional<Sun> split_sun(RgbCoefficients& coefficients);

}  // namespace shlight
