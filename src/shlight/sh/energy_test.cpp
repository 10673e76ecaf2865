#include "shlight/sh/energy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "shlight/sh/kernel.h"
#include "shlight/sh/project.h"
#include "shlight/sh/zonal.h"

namespace shlight {
namespace {

using std::numbers::pi;

// Basri and Jacobs's figures, in per cent, to the digits that they print.
TEST(Energy, OfTheClampedCosine) {
  const auto energy = energy_per_band(make_cosine_power_kernel(16, 1));
  const double total = 2 * pi / 3;  // ∫ max(0, z)²
  double sum = 0;
  const double expected[] = {37.5, 87.5, 99.22, 99.22, 99.80};
  for (std::size_t l = 0; l < 5; ++l) {
    sum += energy[l];
    EXPECT_NEAR(100 * sum / total, expected[l], 0.006) << l;
  }
  EXPECT_EQ(bands_for_energy(energy, 0.99, total), 3);
  EXPECT_EQ(bands_for_energy(energy, 0.375, total), 1);
  EXPECT_EQ(bands_for_energy(energy, 0.9999999, total), std::nullopt);
}

// One zonal function as a kernel and as coefficients about a slanted axis.
TEST(Energy, IsTheSameAboutEveryAxis) {
  const auto kernel = make_henyey_greenstein_kernel(8, 0.6);
  RgbCoefficients coefficients(8);
  add_zonal(kernel, {0.36, 0.48, 0.8}, {1, 2, -2}, coefficients);
  const auto expected = energy_per_band(kernel), energy = energy_per_band(coefficients);
  for (std::size_t l = 0; l < 8; ++l) EXPECT_NEAR(energy[l], 9 * expected[l], 1e-13) << l;
}

// The highest degree that 99 % of the energy takes, of cos^s θ.
TEST(Energy, DegreesOfCosinePowers) {
  const auto highest_degree = [](double s) {
    return *bands_for_energy(energy_per_band(make_cosine_power_kernel(64, s)), 0.99, 2 * pi / (2 * s + 1)) - 1;
  };
  EXPECT_EQ(highest_degree(16), 8);
  EXPECT_EQ(highest_degree(64), 17);
}

// The same of exp(−tan²(θ/2)/m²) on the upper hemisphere: a glossy lobe about the mirrored view.
TEST(Energy, DegreesOfGlossyLobes) {
  const auto highest_degree = [](double m) {
    constexpr int kBands = 96;
    // Gauss's rule in θ over the hemisphere: smooth but where it is cut off.
    const GaussLegendre rule = make_gauss_legendre(400);
    std::vector<double> kernel(kBands);
    double total = 0;
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
      const double theta = pi / 4 * (1 + rule.nodes[i]), tangent = std::tan(theta / 2);
      const double f = std::exp(-tangent * tangent / (m * m));
      const double weight = 2 * pi * pi / 4 * rule.weights[i] * std::sin(theta);
      for (int l = 0; l < kBands; ++l)
        kernel[static_cast<std::size_t>(l)] += weight * f * std::legendre(static_cast<unsigned>(l), std::cos(theta));
      total += weight * f * f;
    }
    return *bands_for_energy(energy_per_band(kernel), 0.99, total) - 1;
  };
  EXPECT_EQ(highest_degree(0.05), 30);
  EXPECT_EQ(highest_degree(0.1), 15);
  EXPECT_EQ(highest_degree(0.2), 7);
  EXPECT_EQ(highest_degree(0.3), 5);
}

}  // namespace
}  // namespace shlight
