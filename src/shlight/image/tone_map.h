#pragma once

#include "shlight/image/image.h"
#include "shlight/sh/coefficients.h"
#include "shlight/sh/vec.h"

// From linear radiance to what a screen shows, as render/shaders/tone_map.frag does it on the graphics card.

namespace shlight {

// IEC 61966-2-1, for values in [0, 1]: linear light to what a file or a screen takes, and back.
double encode_srgb(double linear);
double decode_srgb(double encoded);

// From exposed radiance to linear light of a screen.
enum class ToneCurve {
  kFilmic,  // tone_map
  kNone,    // cut off at 1
};

// A filmic curve that keeps middle grey (0.18), takes 0 to 0, and all there is above to less than 1. Negative values
// are taken as 0, NaN too; infinite ones are white. See tone_map.frag for where it is from.
Rgb tone_map(Rgb radiance);
Rgb tone_map(Rgb radiance, ToneCurve curve);

// The picture of `radiance` times `exposure`, a factor: tone mapped, sRGB, opaque.
Image8 make_picture8(const Image& radiance, double exposure, ToneCurve curve = ToneCurve::kFilmic);

// The factor that takes the mean luminance of a light over all directions, Y00 L00, to 0.36. That is one stop above
// middle grey: most of a captured light comes from a few bright directions overhead, and with the mean at 0.18 the
// model and what is to be seen behind it come out dark. 1 for a light whose mean is not above 0.
double auto_exposure(const RgbCoefficients& radiance);

}  // namespace shlight
