#include "shlight/sh/kernel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>

#include "shlight/sh/project.h"
#include "shlight/sh/zonal.h"

namespace shlight {
namespace {

using std::numbers::pi;

// 2π ∫ k P_l over [low, 1] by Gauss-Legendre on pieces that shrink toward both ends, where lobes are steep.
std::vector<double> kernel_by_quadrature(int bands, double low, const std::function<double(double)>& k) {
  static const GaussLegendre rule = make_gauss_legendre(48);
  std::vector<double> kernel(static_cast<std::size_t>(bands));
  const auto add_piece = [&](double begin, double end) {
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
      const double z = begin + (end - begin) * 0.5 * (1 + rule.nodes[i]);
      const double weight = 2 * pi * 0.5 * (end - begin) * rule.weights[i] * k(z);
      for (std::size_t l = 0; l < kernel.size(); ++l) kernel[l] += weight * std::legendre(static_cast<unsigned>(l), z);
    }
  };
  double length = 0.5 * (1 - low);
  for (; length > 1e-9; length *= 0.6) {
    add_piece(low + 0.6 * length, low + length);
    add_piece(1 - length, 1 - 0.6 * length);
  }
  add_piece(low, low + length);
  add_piece(1 - length, 1);
  return kernel;
}

void expect_kernel(const std::vector<double>& kernel, double low, const std::function<double(double)>& k,
                   const std::string& name) {
  const std::vector<double> expected = kernel_by_quadrature(static_cast<int>(kernel.size()), low, k);
  // std::legendre of degree 40 carries about 1e-14.
  for (std::size_t l = 0; l < kernel.size(); ++l)
    EXPECT_NEAR(kernel[l], expected[l], 1e-13 * std::abs(expected[0])) << name << ", degree " << l;
}

constexpr int kBands = 40;

TEST(Kernel, CosinePowersAreTheirQuadrature) {
  // Smooth at 0 only for whole exponents; 7.3 is smooth enough there for 48 nodes.
  for (const double s : {0.0, 1.0, 2.0, 7.3, 50.0, 1000.0})
    expect_kernel(
        make_cosine_power_kernel(kBands, s), 0, [&](double z) { return std::pow(z, s); }, "power " + std::to_string(s));
}

TEST(Kernel, CapsAreTheirQuadrature) {
  for (const double angle : {0.3, 1.0, pi / 2, 2.5, pi})
    expect_kernel(
        make_cap_kernel(kBands, angle), std::cos(angle), [](double) { return 1.0; }, "cap " + std::to_string(angle));
}

// The caps of half angles α and π − α, one mirrored, are the whole sphere.
TEST(Kernel, CapAndItsComplementAreTheSphere) {
  const auto cap = make_cap_kernel(kBands, 0.7), rest = make_cap_kernel(kBands, pi - 0.7);
  for (std::size_t l = 0; l < cap.size(); ++l)
    EXPECT_NEAR(cap[l] + (l % 2 ? -1 : 1) * rest[l], l == 0 ? 4 * pi : 0, 1e-13) << "degree " << l;
}

// A tiny cap is 2π (1 − cos α) P_l(1 − a bit): no digits are lost.
TEST(Kernel, TinyCapsKeepTheirDigits) {
  constexpr double kAngle = 1e-6;
  const auto cap = make_cap_kernel(kBands, kAngle);
  for (std::size_t l = 0; l < cap.size(); ++l) {
    const double mean = 1 - static_cast<double>(l * (l + 1)) * kAngle * kAngle / 8;
    EXPECT_NEAR(cap[l] / (pi * kAngle * kAngle), mean, 1e-12) << "degree " << l;
  }
}

TEST(Kernel, PhaseFunctionsAreTheirQuadrature) {
  for (const double g : {-0.9, -0.2, 0.0, 0.5, 0.85})
    expect_kernel(
        make_henyey_greenstein_kernel(kBands, g), -1,
        [&](double z) { return (1 - g * g) / (4 * pi * std::pow(1 + g * g - 2 * g * z, 1.5)); },
        "Henyey-Greenstein " + std::to_string(g));
  expect_kernel(
      make_rayleigh_kernel(kBands), -1, [](double z) { return 3 / (16 * pi) * (1 + z * z); }, "Rayleigh");
  for (const double k : {-0.8, -0.1, 0.0, 1e-9, 0.3, 0.9, 0.99})
    expect_kernel(
        make_schlick_kernel(kBands, k), -1, [&](double z) { return (1 - k * k) / (4 * pi * std::pow(1 - k * z, 2)); },
        "Schlick " + std::to_string(k));
  for (const double kappa : {0.0, 1e-6, 0.5, 10.0, 300.0, 1e5})
    expect_kernel(
        make_von_mises_fisher_kernel(kBands, kappa), -1,
        [&](double z) {
          // κ/sinh κ · e^{κz} without overflow; 1 at κ = 0.
          if (kappa == 0) return 1 / (4 * pi);
          return 2 * kappa / -std::expm1(-2 * kappa) * std::exp(kappa * (z - 1)) / (4 * pi);
        },
        "von Mises-Fisher " + std::to_string(kappa));
}

// All are positive functions of integral 1, and no coefficient of such a function is larger than its integral.
TEST(Kernel, NoDegreeExceedsTheMeanHoweverNarrowTheLobe) {
  for (const auto& kernel : {make_schlick_kernel(200, 1 - 1e-12), make_von_mises_fisher_kernel(200, 1e9),
                             make_henyey_greenstein_kernel(200, 0.999999)})
    for (std::size_t l = 1; l < kernel.size(); ++l) {
      EXPECT_LE(kernel[l], kernel[l - 1]) << "degree " << l;
      EXPECT_GT(kernel[l], 0.5) << "degree " << l;
    }
}

TEST(Kernel, TheClampedCosineIsItsFirstPower) {
  const auto kernel = make_cosine_power_kernel(64, 1);
  for (int l = 0; l < 64; ++l)
    EXPECT_NEAR(kernel[static_cast<std::size_t>(l)], cosine_lobe_hat(l), 1e-15) << "degree " << l;
}

}  // namespace
}  // namespace shlight
