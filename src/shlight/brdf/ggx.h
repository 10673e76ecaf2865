#pragma once

#include <memory>

#include "shlight/brdf/brdf.h"

namespace shlight {

// Mirror facets with the long-tailed distribution of Trowbridge and Reitz [1, "GGX"], shadowed and masked as Smith has
// it, both together [2, eq. 99], anisotropic along tangent and bitangent [2, eq. 85]:
//
//     f_r = F D G₂ / (4 n·s n·v)
//     D = 1 / (π α_x α_y h_z⁴ (1 + t_x²/α_x² + t_y²/α_y²)²),  t the slopes of the half vector
//     G₂ = 1 / (1 + Λ(s) + Λ(v)),  Λ(d) = (√(1 + (α_x² d_x² + α_y² d_y²)/d_z²) − 1)/2
//     F = F0 + (1 − F0)(1 − v·h)⁵, Schlick's.
//
// What light is lost between facets is not put back: rough metals are darker than real ones. Sampled by visible normals
// [3].
//
// [1] Walter, Marschner, Li & Torrance 2007, Microfacet Models for Refraction through Rough Surfaces, EGSR.
// [2] Heitz 2014, Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs, JCGT 3(2).
// [3] Heitz 2018, Sampling the GGX Distribution of Visible Normals, JCGT 7(4).
struct GgxParams {
  double ax = 0.3, ay = 0.3;  // roughness α along tangent and bitangent, > 0
  Rgb f0 = {0.04, 0.04, 0.04};
  // Of light that comes back from below the facets, with Fresnel's factor of what got in: (1 − F') diffuse/π is added,
  // F' with an F0 of its own (metallic_roughness.h).
  Rgb diffuse = {0, 0, 0};
  Rgb diffuse_f0 = {0.04, 0.04, 0.04};
};
std::unique_ptr<Brdf> make_ggx(const GgxParams& params);

}  // namespace shlight
