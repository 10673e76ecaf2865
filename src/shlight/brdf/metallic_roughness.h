#pragma once

#include <memory>

#include "shlight/brdf/brdf.h"

namespace shlight {

// glTF's material [1, appendix B.2]: metallic parts of a metal, GGX with α = roughness² and F0 = base, and 1 − metallic
// of a dielectric, GGX with F0 = 0.04 over a diffuse part (1 − F) base/π. Linear in the base colour. All parameters in
// [0, 1]. α is held above 0.01, where a highlight is a
// mirror to any number of bands here.
//
// [1] Khronos Group 2021, glTF 2.0 Specification.
std::unique_ptr<Brdf> make_metallic_roughness(Rgb base, double metallic, double roughness);

}  // namespace shlight
