#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <span>

#include "shlight/brdf/brdf.h"

namespace shlight {

struct CornellBrdf {
  std::unique_ptr<Brdf> brdf;
  std::size_t samples = 0;
  std::size_t negative = 0;  // spectral values below 0, which are taken as 0
};

// A surface measured with Cornell's gonioreflectometer [1], as text: a line a sample, with 35 numbers apart by blanks
// or commas: θ_i φ_i θ_r φ_r in radians, then f_r in 1/sr at 31 wavelengths from 400 to 700 nm. Lines that are empty or
// begin with a letter or '#' are passed over. Samples may lie anywhere; the surface is taken as isotropic and
// reciprocal. f_r between them is from the nearest six, weighted by the inverse fourth power of their distance in
// (2 √(2θ_h/π), 2θ_d/π, sin θ_h sin θ_d cos 2φ_d), worked out once on a grid of 45 x 30 x 36 cells over the angles of
// half and difference vector. Throws Error, with the line, where the file cannot be read, or a line is cut short or has
// a number that is not finite or no angle; and where it holds fewer than 16 samples.
//
// [1] Foo 1997, A Gonioreflectometer for Measuring the Bidirectional Reflectance of Materials for Use in Illumination
//     Computations, Cornell University.
CornellBrdf load_cornell(const std::filesystem::path& file);

inline constexpr int kCornellWavelengths = 31;

// Linear Rec. 709 from a reflectance at 400, 410 … 700 nm, under light of equal energy, so that 1 everywhere gives
// exactly (1, 1, 1). Observer: the fits of [2]. A saturated colour may have a negative channel.
//
// [2] Wyman, Sloan & Shirley 2013, Simple Analytic Approximations to the CIE XYZ Color Matching Functions, JCGT 2(2).
Rgb rgb_of_spectrum(std::span<const double, kCornellWavelengths> reflectance);

}  // namespace shlight
