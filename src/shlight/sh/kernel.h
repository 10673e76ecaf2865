#pragma once

#include <vector>

// Kernels of well-known functions of the angle to an axis (zonal.h): the factors k̂_l = 2π ∫ k(z) P_l(z) dz of the
// degrees 0 … bands−1, in closed form or by a recursion in the direction in which it is stable. Phase functions are
// normalised, k̂_0 = 1, and scatter forward, to z = 1, where their parameter is positive.
//
// [1] Henyey & Greenstein 1941, Diffuse Radiation in the Galaxy, Astrophysical Journal 93.
// [2] Blasi, Le Saëc & Schlick 1993, A Rendering Algorithm for Discrete Volume Density Objects, Eurographics.
// [3] Fisher 1953, Dispersion on a Sphere, Proc. R. Soc. A 217.
// [4] Ramamoorthi & Hanrahan 2001, A Signal-Processing Framework for Inverse Rendering, SIGGRAPH.

namespace shlight {

// max(0, z)^exponent, exponent >= 0: a hemisphere at 0, the clamped cosine at 1, Phong's lobe (not normalised). Where
// [4] gives e^{−l²/2s}, its approximation, this is exact.
std::vector<double> make_cosine_power_kernel(int bands, double exponent);

// 1 within `half_angle` radians of the axis, [0, π], else 0.
std::vector<double> make_cap_kernel(int bands, double half_angle);

// (1 − g²) / (4π (1 + g² − 2gz)^{3/2}), |g| <= 1 [1]: g^l.
std::vector<double> make_henyey_greenstein_kernel(int bands, double g);

// 3/(16π) (1 + z²): 1, 0, 1/10, 0, …
std::vector<double> make_rayleigh_kernel(int bands);

// (1 − k²) / (4π (1 − kz)²), |k| < 1 [2, with the sign that makes k > 0 forward].
std::vector<double> make_schlick_kernel(int bands, double k);

// The von Mises-Fisher lobe κ e^{κz} / (4π sinh κ), κ >= 0 [3]: the Gaussian of the sphere.
std::vector<double> make_von_mises_fisher_kernel(int bands, double kappa);

}  // namespace shlight
