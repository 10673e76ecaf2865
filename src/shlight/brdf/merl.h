#pragma once

#include <filesystem>
#include <memory>

#include "shlight/brdf/brdf.h"

namespace shlight {

struct MerlBrdf {
  std::unique_ptr<Brdf> brdf;
  std::size_t samples = 0, missing = 0;  // of all, how many are negative
};

// A material of the MERL database [1], a `.binary` file: three 32-bit numbers of cells along θ_h, θ_d and φ_d of
// Rusinkiewicz's coordinates (90, 90, 180), then all red, all green and all blue samples as doubles, in which θ_h is
// slowest and φ_d quickest. They are scaled by 1/1500, 1.15/1500 and 1.66/1500. Cell k of θ_h reaches from 90° (k/90)²
// to 90° ((k+1)/90)². Numbers are in the sequence of bytes of x86.
//
// Negative samples are the database's mark of what could not be measured: f_r is interpolated from the others. Other
// numbers of cells are taken too. Throws Error where the file cannot be read, is not of the size that its numbers make,
// or has samples that are not finite.
//
// [1] Matusik, Pfister, Brand & McMillan 2003, A Data-Driven Reflectance Model, ACM TOG 22(3).
MerlBrdf load_merl(const std::filesystem::path& file);

}  // namespace shlight
