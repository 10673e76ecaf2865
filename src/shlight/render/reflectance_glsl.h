#pragma once

#include <string>

namespace shlight {

// GLSL ES 3.00 that lets a light meet the reflectance coefficients of one view (brdf/reflectance_table.h), per vertex
// or per pixel. The source defines
//
//   void eval_reflectance(vec3 n, vec3 t, out vec3 plain, out vec3 tinted)
//
// the radiance Σ_i L_i F_i that a surface leaves toward the eye, as the sum of `plain` and of `tinted` times the base
// colour: n is its normal and t its tangent, orthogonal and of unit length, in the light's frame. F are coefficients in
// the local frame, whose z is n and whose x is t. They are turned into the light's frame rather than the light's
// coefficients into the local one: one channel instead of three.
//
// It takes them from a function that the program defines,
//
//   vec4 reflectance_texel(int k)
//
// which returns four numbers of those of all coefficients and their channels, 4k … 4k+3; of three channels, the red,
// green and blue of coefficient k. The light is in the uniforms that set_radiance_uniforms (render/sh_glsl.h) fills.
struct ReflectanceGlslParams {
  int bands = 5;          // 1 to 10
  int channels = 1;       // 1: plain, grey; 2: tinted and plain, both grey; 3: plain, red, green and blue
  bool isotropic = true;  // F has only m >= 0, with index l(l+1)/2 + m, and t points to the eye's side
};
std::string make_reflectance_glsl(const ReflectanceGlslParams& params);

}  // namespace shlight
