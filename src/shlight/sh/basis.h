#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "shlight/sh/coefficients.h"
#include "shlight/sh/vec.h"

// The convention of the whole library, and the functions that define it.
//
// Real, orthonormal spherical harmonics without the Condon-Shortley phase, of a unit direction (x, y, z) in the world:
// right-handed, +Y up, -Z forward. The polar axis of the basis is z, its azimuth runs from x to y:
//
//     Y_lm = √2 K_l^m  cos(mφ)   P_l^m(z)     m > 0
//     Y_l0 =    K_l^0            P_l^0(z)
//     Y_lm = √2 K_l^|m| sin(|m|φ) P_l^|m|(z)  m < 0,    K_l^m = √((2l+1)/4π · (l−m)!/(l+m)!)
//
// at index i = l(l+1) + m, where P_l^m is taken without its (−1)^m [1, with the phase; 2, without]. n bands are the
// degrees 0 … n−1. The first nine are
//
//     .282095   .488603 y   .488603 z   .488603 x
//     1.092548 xy   1.092548 yz   .315392 (3z² − 1)   1.092548 xz   .546274 (x² − y²)
//
// The golden value: a unit delta light from (.36, .48, .80) has the coefficients .282095 .234529 .390882 .175897
// .188792 .419539 .290160 .314654 −.055064.
//
// [1] Green 2003, Spherical Harmonic Lighting: The Gritty Details.
// [2] Sloan 2013, Efficient Spherical Harmonic Evaluation, JCGT 2(2).

namespace shlight {

// Writes the num_coefficients(bands) values Y_i(direction) to `values`. Any number of bands; in double right to 1e-12
// relative to the largest value of the band at 64 bands and more, in float to 1e-5 up to 16. `direction` has unit
// length. Up to 6 bands straight-line polynomials, beyond that the recursion of eval_basis_recursive; both give the
// same values to rounding.
template <class T>
void eval_basis(int bands, Vec3<T> direction, std::span<T> values);

// The same for many directions at once, given as one array a component: values[i · count + j] is Y_i of direction j,
// count = x.size(). Much quicker a direction than one by one: the processor's vectors run along j.
void eval_basis(int bands, std::span<const float> x, std::span<const float> y, std::span<const float> z,
                std::span<float> values);

// The reference that eval_basis is held to: the normalised recursion over l, written down plainly.
template <class T>
void eval_basis_recursive(int bands, Vec3<T> direction, std::span<T> values);

// The normalised associated Legendre functions without phase, of z = cos θ and s = sin θ >= 0, in the sequence
// p[l(l+1)/2 + m] = K_l^m P_l^m(z) √(2 if m > 0), so that Y_lm = p cos(mφ). bands(bands+1)/2 values.
class NormalizedLegendre {
 public:
  explicit NormalizedLegendre(int bands);
  int bands() const { return bands_; }
  std::size_t size() const { return factors_.size(); }
  void eval(double z, double s, std::span<double> p) const;
  // Divided by s^m, which leaves polynomials in z, and their derivatives.
  void eval_with_derivative(double z, std::span<double> p, std::span<double> derivative) const;

 private:
  struct Factors {
    double a, b;
  };
  int bands_;
  std::vector<Factors> factors_;  // in the sequence of p; on the diagonal, a is p_m^m / p_{m-1}^{m-1}
};

// Σ c_i Y_i(direction).
double reconstruct(const Coefficients<double>& coefficients, Vec3d direction);
Rgb reconstruct(const RgbCoefficients& coefficients, Vec3d direction);

// Adds value · Y_i(direction) to each coefficient: a delta light of that value, or one weighted sample.
void add_delta(Vec3d direction, Rgb value, RgbCoefficients& coefficients);

}  // namespace shlight
