#pragma once

#include <memory>

#include "shlight/brdf/brdf.h"

// Matte surfaces that are rough: V-shaped grooves of Lambertian facets, whose slopes have the standard deviation σ (in
// radians). Backscattering makes them flatter than Lambert's, to which both forms come down at σ = 0.
//
// With θ_i, θ_r the polar angles of s and v, Δφ the difference of their azimuths, α = max(θ_i, θ_r), β = min(θ_i, θ_r).
// tan β, unbounded where both directions graze, is held below 1/kMinCosine.
//
// [1] Oren & Nayar 1994, Generalization of Lambert's Reflectance Model, SIGGRAPH.

namespace shlight {

// The "qualitative model" of [1, eq. 30], without light between facets:
//
//     f_r = ρ/π (A + B max(0, cos Δφ) sin α tan β),  A = 1 − 0.5 σ²/(σ²+0.33),  B = 0.45 σ²/(σ²+0.09).
//
// ρ in [0, 1], σ >= 0. The thesis prints minus signs in both denominators, a factor n·s too many and no 1/π.
std::unique_ptr<Brdf> make_oren_nayar(Rgb rho, double sigma);

// The full functional approximation, [1, eq. 27 to 29], with one bounce between facets:
//
//     f_r = ρ/π (C1 + C2 cos Δφ tan β + C3 (1 − |cos Δφ|) tan((α+β)/2)) + 0.17 ρ²/π σ²/(σ²+0.13) (1 − cos Δφ (2β/π)²)
//     C1 = A,  C2 = B (sin α − (2β/π)³ where cos Δφ < 0),  C3 = 0.125 σ²/(σ²+0.09) (4αβ/π²)².
std::unique_ptr<Brdf> make_oren_nayar_full(Rgb rho, double sigma);

}  // namespace shlight
