#pragma once

#include "shlight/truth/plane.h"

namespace shlight {

// The structural similarity of two pictures of values in [0, 1], as luma is: 1 where they are equal, and nowhere more.
// Symmetric. With means μ, variances σ² and the covariance σ_ab in an 11 x 11 window around each pixel, Gaussian with σ
// = 1.5, and C1 = 0.01², C2 = 0.03² [1, eq. 13]:
//
//     SSIM = (2 μ_a μ_b + C1) (2 σ_ab + C2) / ((μ_a² + μ_b² + C1) (σ_a² + σ_b² + C2))
//
// Of equal size, at least 1 x 1.
//
// [1] Wang, Bovik, Sheikh, Simoncelli 2004, Image Quality Assessment: From Error Visibility to Structural Similarity,
//     IEEE Transactions on Image Processing 13(4).
Plane ssim_map(const Plane& a, const Plane& b, int threads = 0);

// Its mean over the pixels whose windows lie within the picture, as [1] has it; over all of them in pictures narrower
// or lower than a window.
double mean_ssim(const Plane& map);

}  // namespace shlight
