#pragma once

#include <functional>
#include <string>
#include <vector>

#include "shlight/brdf/brdf.h"
#include "shlight/image/image.h"
#include "shlight/image/tone_map.h"
#include "shlight/light/light.h"
#include "shlight/render/render.h"
#include "shlight/report/part.h"
#include "shlight/scene/scene.h"

// Pictures of the report, drawn and traced so that they can be compared pixel by pixel. Not installed.

namespace shlight {

using DrawMethod = std::function<RenderResult(const RenderLight&, const RenderParams&)>;

// Draws `fine` times as wide and high and takes the mean of each block: the pixels of an outline are then covered
// nearly as exactly as a path tracer's, and hardly an error is measured there but the method's. Linear radiance.
Image draw_fine(const RenderLight& light, const RenderParams& params, int fine, const DrawMethod& draw);

// The mean of each block of factor x factor pixels; what is left over at the right and at the bottom is left out.
Image average_blocks(const Image& image, int factor);

// What the light behind the scene adds to pictures that were drawn without it, outlines included: the same for every
// method, so that it stays out of errors.
Image draw_backdrop(const Scene& scene, const RenderLight& light, RenderParams params, int fine);

// The sum of two pictures of one size.
Image add_images(const Image& a, const Image& b);

// What the methods approximate: no shadows, `brdf` or, without one, the scene's own colours; params' view and size.
struct Reference {
  Image radiance, variance;
  double noise = 0;  // root mean square of the pixels' deviations, relative to that of the pixels
};
Reference trace_reference(const Scene& scene, const Light& light, const RenderParams& params, const Brdf* brdf,
                          int samples, const Progress& progress);

// Root mean square of a picture's error, relative to that of the reference. The reference's own noise, which it knows,
// is taken out of both: the mean of (test − reference)² is that of the error's square and the variance. What is left of
// noise hides errors smaller than `resolution`, two standard deviations of that difference.
struct PictureError {
  double value = 0, resolution = 0;
};
PictureError measure_picture(const Image& test, const Reference& reference);

// The same between two references, the noise of both taken out.
PictureError measure_difference(const Reference& a, const Reference& b);

void add_error(PartWriter& out, const std::string& name, const PictureError& error);

// "0.35 %", or "below 0.2 %" where noise hides it.
std::string to_text(const PictureError& error);

}  // namespace shlight
