#pragma once

#include <cstddef>
#include <vector>

#include "shlight/sh/coefficients.h"
#include "shlight/transfer/transfer.h"

// Transfer coefficients in fewer bits: whole numbers from −(2^(bits−1) − 1) to 2^(bits−1) − 1, as glTF's normalized
// integers are, times a scale for each coefficient of each channel, the largest magnitude that it has in the scene.
// Zero stays zero.

namespace shlight {

// Whether transfer can be stored in so many bits: 8, 16, or 32 for floats as they are.
constexpr bool is_transfer_bits(int bits) {
  return bits == 8 || bits == 16 || bits == 32;
}

// The largest magnitude of coefficient i of channel c: [c · bands² + i].
std::vector<float> quantisation_scales(const Transfer& transfer);

// The nearest whole number, and what it stands for. `value` is at most `scale` in magnitude; 2 <= bits <= 16.
int quantise(float value, float scale, int bits);
float dequantise(int number, float scale, int bits);

// The transfer as it comes back from so many bits; as it is from 32.
Transfer quantise_transfer(Transfer transfer, int bits);

// How far apart two transfers shade white surfaces under a light: differences of the channels' radiance over all
// vertices, relative to the root mean square of what `a` gives.
struct ShadingError {
  double rms = 0;
  double max = 0;
};
// Of as many vertices, bands and channels.
ShadingError measure_shading_error(const Transfer& a, const Transfer& b, const RgbCoefficients& light);

}  // namespace shlight
