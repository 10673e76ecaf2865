#pragma once

#include <memory>

#include "shlight/brdf/brdf.h"

namespace shlight {

// Perfectly diffuse: f_r = ρ/π, the same from everywhere. ρ is the albedo, [0, 1].
std::unique_ptr<Brdf> make_lambert(Rgb rho);

}  // namespace shlight
