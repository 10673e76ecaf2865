#pragma once

#include <span>
#include <vector>

#include "shlight/sh/coefficients.h"
#include "shlight/sh/vec.h"

// Lamps of uniform radiance nearby, seen from the origin: the coefficients of the directions that they cover.
//
// Positions are in any unit; only directions from the origin count. What faces away is dark unless the lamp shines to
// both sides. A lamp seen exactly edge-on from outside of it is dark as well; with the origin on it, it fills the
// hemisphere behind it, as it does just before.
//
// All of them turn the area into its boundary. Others do so for axial moments [1] or zonal harmonics [2], and make the
// rest of those along several axes [2, 3]. Here all of a degree are taken at once: Y_lm is an eigenfunction of the
// sphere's Laplacian, and so, by the divergence theorem with n the outward normal of the boundary,
//
//     ∫_S Y_lm = −1/(l(l+1)) ∫_S ∇²Y_lm = −1/(l(l+1)) ∮_∂S ∂Y_lm/∂n,     l > 0.
//
// [1] Arvo 1995, Applications of Irradiance Tensors to the Simulation of Non-Lambertian Phenomena, SIGGRAPH.
// [2] Wang & Ramamoorthi 2018, Analytic Spherical Harmonic Coefficients for Polygonal Area Lights, SIGGRAPH.
// [3] Belcour, Xie, Hery, Meyer, Jarosz & Nowrouzezahrai 2018, Integrating Clipped Spherical Harmonics Expansions, ACM
//     TOG 37(2).
// [4] Van Oosterom & Strackee 1983, The Solid Angle of a Plane Triangle, IEEE Trans. Biomed. Eng. 30(2).
// [5] Gamito 2016, Solid Angle Sampling of Disk and Cylinder Lights, EGSR: a disc's directions are a spherical ellipse.

namespace shlight {

enum class Sides { kFront, kBoth };

// Adds a polygon. Its front is the side from which its vertices run counter-clockwise. It is planar, of any number of
// vertices, convex or not; or spherical, which is the same with unit vertices in one hemisphere, of any radii: the
// edges are great circles seen from the origin. Where its boundary goes around twice it counts twice; fewer than three
// vertices cover nothing. In closed form, degree 0 by [4]; right to 2e-15 · radiance up to 48 bands, to 1e-14 at
// 64, however small the polygon is. O(bands³) an edge.
void add_polygon(std::span<const Vec3d> vertices, Sides sides, Rgb radiance, RgbCoefficients& coefficients);

// Whether the polygon covers a direction, seen from the origin.
bool polygon_covers(std::span<const Vec3d> vertices, Sides sides, Vec3d direction);

// What is left of a polygon on the side of the plane through the origin to which `normal` points: above a horizon. A
// polygon that is not convex may get edges that run along the plane and back, which count for nothing.
std::vector<Vec3d> clip_polygon(std::span<const Vec3d> vertices, Vec3d normal);

// Adds a flat disc; `normal` is its front's, of any length but zero. Its directions are an elliptical cone [5], whose
// boundary is integrated by the trapezoid rule with as many nodes as rounding can tell apart; a circle seen from its
// axis is add_disc. Absolutely right to 1e-14 · radiance as long as the origin is not nearer to the rim than a
// millionth of the radius.
void add_flat_disc(Vec3d centre, Vec3d normal, double radius, Sides sides, Rgb radiance, RgbCoefficients& coefficients);

// Adds a sphere, or all directions where the origin is inside of it.
void add_sphere(Vec3d centre, double radius, Rgb radiance, RgbCoefficients& coefficients);

}  // namespace shlight
