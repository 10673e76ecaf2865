#pragma once

#include "shlight/sh/coefficients.h"
#include "shlight/sh/vec.h"

// Windows: factors on the degrees of a function that take away the ringing of a cut-off series, at the price of
// contrast.
//
// [1] Sloan 2008, Stupid Spherical Harmonics Tricks, GDC.
// [2] Sloan 2017, Deringing Spherical Harmonics, SIGGRAPH Asia Technical Briefs.

namespace shlight {

enum class Window {
  kHann,       // (1 + cos(πl/w))/2 below degree w, 0 from there on
  kLanczos,    // sin(πl/w)/(πl/w) below degree w, 0 from there on
  kLaplacian,  // 1/(1 + λ l²(l+1)²): the function nearest to the given one at a given ∫(∇²f)² [1]
};

// The factor of degree l. `strength` >= 0 is 1/w for Hann and Lanczos, λ for the Laplacian: 0 leaves all as it is, more
// is smoother.
double window_factor(Window window, double strength, int l);

RgbCoefficients apply_window(Window window, double strength, const RgbCoefficients& coefficients);

// What must not be negative.
enum class Positive { kIrradiance, kRadiance };

struct AutoWindow {
  RgbCoefficients coefficients;  // windowed
  double strength = 0;           // 0 where nothing had to be done
  double lower_bound = 0;        // proved (minimum.h): no channel is anywhere smaller
  Vec3d darkest;                 // near where the smallest value is
  double contrast_kept = 1;      // share of the root mean square of degrees 1 … n−1 that is left, of luminance
};

// The least strength of `window` for which every channel is non-negative in every direction, to within one in a
// thousand of the strength. Works at any number of bands. A channel whose mean is not positive cannot be mended by a
// window: it is left out of account.
AutoWindow make_auto_window(Window window, Positive positive, const RgbCoefficients& coefficients);

}  // namespace shlight
