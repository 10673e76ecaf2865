#pragma once

#include <memory>

#include "shlight/brdf/brdf.h"

namespace shlight {

// glTF's material [1, appendix B.2]: GGX with α = roughness², F0 = 0.04 (1 − metallic) + base · metallic, over a
// diffuse part (1 − F) base (1 − metallic)/π. All parameters in [0, 1]. α is held above 0.01, where a highlight is a
// mirror to any number of bands here.
//
// [1] Khronos Group 2021, glTF 2.0 Specification.
std::unique_ptr<Brdf> make_metallic_roughness(Rgb base, double metallic, double roughness);

}  // namespace shlight
