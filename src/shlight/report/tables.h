#pragma once

#include <string>
#include <vector>

#include "shlight/brdf/brdf.h"
#include "shlight/light/light.h"
#include "shlight/render/render.h"
#include "shlight/scene/scene.h"

// The thesis's four tables, measured: by its own protocol, and by what the library does instead. Not installed.

namespace shlight {

// What a method takes, the median of a few runs, and how wrong its coefficients are.
struct MethodCost {
  double seconds = 0, error = 0;
};

// Table 1: three bands of a light from an angular map of size x size pixels. Errors: the largest difference of a
// coefficient to those of the same picture by pixels, in double, relative to the largest coefficient; of the classic
// way, the root mean square over the runs, each with other samples.
struct LightRow {
  int size = 0;
  MethodCost classic;   // Monte Carlo on one thread, samples made before
  MethodCost exact;     // project_image of the angular map
  MethodCost lat_long;  // project_image of a lat-long map of about as many pixels
};
LightRow measure_light_row(const Light& light, int size, int samples);
// The last of these alone, of a map of width x width/2 pixels.
MethodCost measure_lat_long(const Light& light, int width);

// Table 2: three bands of the cosine of each vertex's normal, on all threads. Errors: root mean square over all
// vertices and coefficients, relative to that of the coefficients, which are known in double.
struct TransferRow {
  std::size_t vertices = 0, triangles = 0;
  MethodCost classic;  // sample_cosine_transfer
  MethodCost own;      // eval_cosine_transfer
};
TransferRow measure_transfer_row(const Scene& scene, int samples);

// Table 3: five bands of f_r max(0, n·s) for the vertices of a model of 1024 and one eye, in the world's frame, on all
// threads. All vertices are taken to be seen: those that face away, from behind. Errors as in table 2, over every
// eighth vertex, against projection in double to 1e-7.
struct BrdfRow {
  MethodCost classic;        // project_brdf_monte_carlo
  MethodCost own;            // quadrature with the fewest nodes that are ten times as exact as that
  MethodCost lookup;         // from the table of all views that is drawn with
  double nodes_seconds = 0;  // to find the nodes, once for a material
  double table_seconds = 0;  // to make the table, once for a material
};
BrdfRow measure_brdf_row(const Brdf& brdf, int samples);

// What of table 3 a new eye takes once the table of all views is there.
double measure_view_seconds(const Brdf& brdf);

// Seconds to turn a light's 3 x 25 coefficients into the frames of so many vertices, on one thread.
double measure_rotation_seconds(int vertices);

// Table 4: frames a second of 1440 x 900 pixels with the view turning.
struct FrameRow {
  std::size_t vertices = 0, triangles = 0;
  double irradiance = 0;  // nine coefficients
  double transfer = 0;    // the classic method, three bands
  std::string gl_renderer;
};
FrameRow measure_frame_row(const Scene& scene, const Light& light, int frames);

// Frames a second of the same size with Kautz's method: five bands of `brdf` for the eye of each frame, and the light
// turned into each vertex's or pixel's frame.
double measure_reflectance_frames(const Scene& scene, const Brdf& brdf, const Light& light, Shade shade, int frames);

// A knot of along x around vertices, twice as many triangles, that fits a unit sphere.
Scene make_table_knot(int along, int around);

}  // namespace shlight
