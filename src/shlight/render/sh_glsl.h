#pragma once

#include <string>

#include "shlight/render/gl.h"
#include "shlight/sh/coefficients.h"

namespace shlight {

// GLSL ES 3.00 that evaluates spherical-harmonic sums at a direction, generated for a number of bands. All sources here
// define the function that shaders declare as
//
//   vec3 eval_sh(vec3 n);   red, green and blue at the unit vector n
//
// with the coefficients in uniforms, which the setters below fill. They need highp float: mediump may have ten bits,
// and the tenth band is a polynomial of degree nine. In float they are right to 1e-6 of the largest value.

inline constexpr int kMaxGlslBands = 10;  // 100 of the 224 uniform vectors that every OpenGL ES 3.0 has

// eval_sh(n) = Σ L_lm Y_lm(n), 1 <= bands <= 10: radiance from direction n.
std::string make_sh_glsl(int bands);

// eval_sh(n) is irradiance at the normal n, 1 <= bands <= 10: the nine-coefficient polynomial of Ramamoorthi and
// Hanrahan for three bands, otherwise Σ Â_l L_lm Y_lm(n) without the odd degrees above 1, whose Â_l are 0. Not clamped:
// a light that is cut off at few bands can be negative somewhere.
std::string make_irradiance_glsl(int bands);

// Opens a block of code for one of the degrees or orders of so many bands. Of many bands it is a loop that runs once,
// as often as the uniform u_once says: as one straight line they take LLVM, which compiles for Mesa's llvmpipe, a time
// that grows steeply, 1.3 s for six bands and 12 s for nine, against 0.4 s and 0.7 s. A loop makes pixels of llvmpipe
// half as costly again, so that few bands have none.
std::string open_block(int bands);

// Give the coefficients of radiance to a program in use, which has the source made by make_sh_glsl or
// make_irradiance_glsl for radiance.bands().
void set_radiance_uniforms(const gl::Program& program, const RgbCoefficients& radiance);
void set_irradiance_uniforms(const gl::Program& program, const RgbCoefficients& radiance);

}  // namespace shlight
