#pragma once

#include "shlight/sh/vec.h"

namespace shlight {

// Schlick's approximation of Fresnel's reflectance, F0 + (1 − F0)(1 − v·h)⁵ [Schlick 1994, An Inexpensive BRDF Model
// for Physically-based Rendering]. Not installed.
inline Rgb eval_schlick_fresnel(Rgb f0, double v_dot_h) {
  const double x = v_dot_h < 1 ? 1 - v_dot_h : 0, x2 = x * x, x5 = x2 * x2 * x;
  return (1 - x5) * f0 + x5 * Rgb{1, 1, 1};
}

}  // namespace shlight
