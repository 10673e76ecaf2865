#pragma once

#include <memory>

#include "shlight/brdf/brdf.h"

namespace shlight {

// Facets that are mirrors in V-shaped grooves, their slopes spread as Beckmann has it, with root mean square m:
//
//     f_r = F D G / (4 n·s n·v)
//     D = exp(−tan²α/m²) / (π m² cos⁴α),  α between normal and half vector h
//     G = min{1, 2 n·h n·v / v·h, 2 n·h n·s / v·h}
//     F = F0 + (1 − F0)(1 − v·h)⁵, Schlick's.
//
// m > 0; F0 in [0, 1] is what is reflected at normal incidence. The thesis prints neither π nor 4, F with n·v, and h
// without its length; [1] itself has π in place of the 4, and a D without π.
//
// [1] Cook & Torrance 1982, A Reflectance Model for Computer Graphics, ACM TOG 1(1).
std::unique_ptr<Brdf> make_cook_torrance(double m, Rgb f0);

}  // namespace shlight
