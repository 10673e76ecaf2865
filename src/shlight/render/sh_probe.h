#pragma once

#include <span>
#include <vector>

#include "shlight/render/reflectance_glsl.h"
#include "shlight/sh/coefficients.h"
#include "shlight/sh/vec.h"

namespace shlight {

// What pictures are drawn with, evaluated at given directions: the same generated GLSL, on the same device, in float
// and without the clamp at 0. For measuring how far the graphics card is from the sums in double. Both need a current
// context with EXT_color_buffer_float, throw Error where there is none, and take 1 to 10 bands and unit vectors.

// Irradiance at each normal.
std::vector<Rgb> draw_irradiance_at(std::span<const Vec3d> normals, const RgbCoefficients& radiance);

// Radiance from each direction.
std::vector<Rgb> draw_radiance_at(std::span<const Vec3d> directions, const RgbCoefficients& radiance);

// Radiance reflected at each normal and tangent by surfaces of this base colour, whose reflectance coefficients are all
// `coefficients`: in the sequence of ReflectanceGlslParams, the channels of one side by side.
std::vector<Rgb> draw_reflectance_at(std::span<const Vec3d> normals, std::span<const Vec3d> tangents,
                                     const ReflectanceGlslParams& params, std::span<const float> coefficients,
                                     Vec3f base_color, const RgbCoefficients& radiance);

}  // namespace shlight
