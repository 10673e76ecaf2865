#include "shlight/transfer/quantise.h"

#include <gtest/gtest.h>

#include <cmath>

#include "shlight/scene/builtin_scene.h"
#include "shlight/transfer/transfer_test_util.h"

namespace shlight {
namespace {

TEST(Quantise, EndsAndZeroAreExactAndTheRestIsWithinHalfAStep) {
  for (const int bits : {8, 16}) {
    const int most = (1 << (bits - 1)) - 1;
    EXPECT_EQ(quantise(3.5f, 3.5f, bits), most);
    EXPECT_EQ(quantise(-3.5f, 3.5f, bits), -most);
    EXPECT_EQ(dequantise(most, 3.5f, bits), 3.5f);
    EXPECT_EQ(quantise(0, 3.5f, bits), 0);
    EXPECT_EQ(dequantise(0, 3.5f, bits), 0);
    EXPECT_EQ(quantise(0, 0, bits), 0);
    for (float value = -2; value <= 2; value += .0137f)
      EXPECT_NEAR(dequantise(quantise(value, 2, bits), 2, bits), value, 1.001 / most);
    for (int number = -most; number <= most; ++number)
      ASSERT_EQ(quantise(dequantise(number, .7f, bits), .7f, bits), number);
  }
}

TEST(Quantise, TransferComesBackNearAndNoFurtherTheSecondTime) {
  const Transfer transfer = bake_transfer(make_sphere_scene(8), make_cosine_params(4));
  for (const int bits : {8, 16, 32}) {
    const Transfer once = quantise_transfer(transfer, bits);
    EXPECT_EQ(quantise_transfer(once, bits).coefficients, once.coefficients) << bits;
    const std::vector<float> scales = quantisation_scales(transfer);
    for (std::size_t k = 0; k < once.coefficients.size(); ++k)
      ASSERT_NEAR(once.coefficients[k], transfer.coefficients[k],
                  bits == 32 ? 0 : .501 * scales[k % scales.size()] / ((1 << (bits - 1)) - 1));
  }
}

// One coefficient 1 % too large under a light of that coefficient alone is 1 % of error, in whatever unit.
TEST(Quantise, ShadingErrorIsRelative) {
  const Transfer a = bake_transfer(make_sphere_scene(4), make_cosine_params(2));
  Transfer b = a;
  for (std::size_t k = 2; k < b.coefficients.size(); k += 4) b.coefficients[k] *= 1.01f;
  for (const double unit : {1.0, 1e6}) {
    RgbCoefficients light(3);  // the third band is not looked at
    light[2] = {unit, unit, unit};
    light[5] = {unit, 0, unit};
    const ShadingError error = measure_shading_error(a, b, light);
    EXPECT_NEAR(error.rms, .01, 1e-6);
    EXPECT_GT(error.max, error.rms);
    EXPECT_EQ(measure_shading_error(a, a, light).max, 0);
  }
}

}  // namespace
}  // namespace shlight
