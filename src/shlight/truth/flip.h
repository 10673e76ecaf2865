#pragma once

#include "shlight/image/image.h"
#include "shlight/truth/plane.h"

// How different two pictures look to an observer who flips back and forth between them: 0 where they look the same, 1
// where they differ as much as they can.
//
// [1] Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström, Fairchild 2020, FLIP: A Difference Evaluator for
//     Alternating Images, Proceedings of the ACM on Computer Graphics and Interactive Techniques 3(2) (HPG).
// [2] Andersson, Nilsson, Shirley, Akenine-Möller 2021, Visualizing Errors in Rendered High Dynamic Range Images,
//     Eurographics Short Papers.

namespace shlight {

struct FlipParams {
  // Of the observer's visual angle, above 0; [1]'s default: a 3840 pixels wide monitor of 0.7 m, 0.7 m away.
  double pixels_per_degree = 67;
  int threads = 0;
};

// Of two pictures as they are shown, of equal size: linear light (a file's bytes through decode_srgb), clamped to [0,
// 1]. Finite values. Symmetric [1].
Plane flip_map(const Image& a, const Image& b, const FlipParams& params = {});

// The exposures, in stops, at which radiance is looked at.
struct FlipExposures {
  double start = 0, stop = 0;
  int count = 1;
  double at(int i) const { return count > 1 ? start + (stop - start) * i / (count - 1) : start; }
};

// From where the brightest pixel of the reference to where its median pixel is shown at 0.85, about one exposure a stop
// [2, section 3]. Pixels that are black do not count for the median; one exposure of 0 for a reference that is all
// black.
FlipExposures flip_exposures(const Image& reference);

// Of radiance: at each pixel the largest of flip_map over the exposures of the reference, each with the tone mapper
// that [2] chooses, Narkowicz's approximation of ACES. Finite values; negative ones are taken as 0.
Plane hdr_flip_map(const Image& test, const Image& reference, const FlipParams& params = {});

}  // namespace shlight
