#pragma once

#include <memory>
#include <string>

#include "shlight/light/light.h"

namespace shlight {

// A light from a formula, as the user writes it without "fn:": one expression for all channels, or parts
// "r=…; g=…; b=…" of which each may be missing (black). An expression may use
//
//     x y z           the unit direction in the world
//     theta phi       the thesis's angles: x = sin θ cos φ, y = sin θ sin φ, z = cos θ; φ in (−π, π]
//     pi, e, + − * / ^ ( ), < <= == && || ?:, and muParser's functions: sin cos tan asin acos atan atan2 exp ln
//     log10 sqrt abs sign rint min max sum avg, and clamp(v, low, high), smoothstep(low, high, v)
//
// The light throws Error where a value is not finite. Throws Error where the formula does not parse.
std::unique_ptr<Light> make_formula_light(const std::string& formula);

}  // namespace shlight
