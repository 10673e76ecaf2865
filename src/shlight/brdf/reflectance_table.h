#pragma once

#include <cstddef>
#include <vector>

#include "shlight/brdf/brdf.h"
#include "shlight/sh/coefficients.h"

// F*(v) (project_brdf.h) for all views, as a table of floats that shaders look up [1].
//
// Layout. `values` holds entry after entry, row after row; an entry holds coefficient after coefficient, a coefficient
// its channels: 1 where the model is grey, else 3 (red, green, blue):
//
//     values[((row · width + column) · coefficients + i) · channels + channel]
//
// The polar angle θ of the view stands in the table as its position u from the normal, 0, to the horizon, 1:
//
//     u = 1 − (x + √x)/2,   x = 1 − √(1 − cos θ)        (view_position; cosine_of_position is the inverse)
//
// nearly proportional to θ at the normal, and denser toward the horizon, where models change most.
//
// Isotropic models: one row. Column k is the view at u = k/(width−1) and azimuth 0, in the half plane +x of the frame;
// there the coefficients of m < 0 are zero and are left out. The bands(bands+1)/2 others stand at i = l(l+1)/2 + m.
// Seen from azimuth φ,
//
//     F*_{l,m} = cos(mφ) entry_{l,m},   F*_{l,−m} = sin(mφ) entry_{l,m}.
//
// (A shader that has no tangent needs none: it may take the frame with the view at azimuth 0.)
//
// Anisotropic models: a disc in a square, width = height. Column j and row k are the view of position u and azimuth φ
// with
//
//     u cos φ = 2j/(width−1) − 1,   u sin φ = 2k/(height−1) − 1;
//
// outside of the disc stands the view of the same azimuth at the horizon. All bands² coefficients stand in the
// library's sequence, i = l(l+1) + m.
//
// Between entries, interpolate linearly: two of them, or bilinearly four. With 5 bands and the default sizes, that is
// off by at most 2.5e-4 of the largest |coefficient| of the same view in isotropic tables, 3.5e-3 in anisotropic ones.
// Beyond 80° it is 1e-3 for Blinn and Phong's highlight, which fades there, and 2e-3 and 7e-3 for the forms kWard and
// kDuer of ward.h, which have no bound.
//
// Horizon means 89.9° here, since nothing is seen from the horizon itself.
//
// [1] Kautz, Sloan & Snyder 2002, Fast, Arbitrary BRDF Shading for Low-Frequency Lighting Using Spherical Harmonics.

namespace shlight {

struct ReflectanceTableParams {
  int bands = 5;            // 1 to kMaxTableBands
  int polar_size = 256;     // entries of an isotropic table, >= 2
  int square_size = 128;    // entries of a side of an anisotropic one, >= 2
  double tolerance = 6e-5;  // of entries, relative to their largest coefficient
  int threads = 0;          // 0: all; the same bits for any number
};
inline constexpr int kMaxTableBands = 10;

struct ReflectanceTable {
  int bands = 0;
  int channels = 1;
  int width = 0, height = 1;
  std::vector<float> values;

  bool isotropic() const { return height == 1; }
  int coefficients() const { return isotropic() ? bands * (bands + 1) / 2 : bands * bands; }
};

// Where a view stands between normal and horizon, [0, 1], and back.
double view_position(double cos_theta);
double cosine_of_position(double position);

// Cost: projections of all entries, with as few nodes as the tolerance takes; a model that is not isotropic but
// mirrored needs a quarter of them. Throws what a model of one's own throws.
ReflectanceTable make_reflectance_table(const Brdf& brdf, const ReflectanceTableParams& params = {});

// A grey table and the colour that it is to be multiplied by.
struct ColoredTable {
  Vec3f color;  // of length 1
  ReflectanceTable grey;
};

// A table of three channels as the sum of one or two grey ones. That is all there is to a model whose colour is that of
// one Fresnel term after Schlick, or those of a diffuse and a specular part. None where two are off by more than
// `tolerance` of the largest |coefficient| of a view, as for measured materials.
std::vector<ColoredTable> split_colors(const ReflectanceTable& table, double tolerance = 1e-5);

// F*(v), v of unit length and above the horizon, from the table: what a shader does, in double.
RgbCoefficients eval_reflectance_table(const ReflectanceTable& table, Vec3d v);

// Σ_i F*_i(v) L_i: the radiance that goes to v under a light whose coefficients are given in the local frame. The light
// has at least the table's bands.
Rgb reflect_light(const ReflectanceTable& table, Vec3d v, const RgbCoefficients& light);

}  // namespace shlight
