#pragma once

#include <string>
#include <vector>

#include "shlight/image/image.h"
#include "shlight/image/pixels.h"
#include "shlight/truth/flip.h"
#include "shlight/truth/plane.h"

// How far a picture is from a reference.

namespace shlight {

// What the pixels of a picture are.
enum class Meaning {
  kShown,    // light of a screen in [0, 1], as eight-bit files hold it
  kRadiance  // linear, of any range
};

struct ImageErrorParams {
  Meaning meaning = Meaning::kShown;
  FlipParams flip;
  int num_worst = 5;  // pixels listed
  int threads = 0;
};

struct WorstPixel {
  Pixel pixel;
  double error = 0;     // the largest of its channels'
  Rgb test, reference;  // values as they were compared
};

// Differences are of sRGB-encoded values in [0, 1] where pictures are shown, of linear radiance otherwise.
struct ImageError {
  double rmse = 0;       // root mean square over all pixels and channels
  double relative = 0;   // rmse over the root mean square of the reference; 0 where both are black
  double max_error = 0;  // the largest difference of a channel
  double psnr = 0;       // dB, 20 log10(peak / rmse); infinite for equal pictures. The peak is 1 where pictures are
                         // shown, the reference's largest value otherwise
  double ssim = 0;       // of luma (ssim.h); radiance is exposed and tone mapped, its reference's mean to 0.18
  double flip = 0;       // the mean of flip_map (flip.h), of hdr_flip_map for radiance
  Plane difference;      // of each pixel, the largest of its channels'
  Plane flip_map;
  std::vector<WorstPixel> worst;  // the largest differences first, at least kWorstApart pixels from each other in x or
                                  // y, so that they show places and not one place; none where nothing differs
};

inline constexpr int kWorstApart = 16;

// Throws Error where the pictures, called by their names, cannot be compared: of different size, or with pixels that
// are not finite.
void check_comparable(const Image& test, const std::string& test_name, const Image& reference,
                      const std::string& reference_name);

// Both linear; needs what check_comparable checks. About 3 s a million pixels and core, for radiance as often as it has
// exposures.
ImageError measure_error(const Image& test, const Image& reference, const ImageErrorParams& params = {});

}  // namespace shlight
