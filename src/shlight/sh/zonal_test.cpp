#include "shlight/sh/zonal.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "shlight/sh/basis.h"
#include "shlight/sh/kernel.h"
#include "shlight/sh/project.h"
#include "shlight/sh/sphere_samples.h"

namespace shlight {
namespace {

using std::numbers::pi;

TEST(Zonal, CosineLobeIsTheQuadratureOfTheClampedCosine) {
  // ∫ max(0, z) Y_l0 = 2π K_l ∫_0^1 z P_l(z) dz; a polynomial, so that Gauss-Legendre is exact.
  const GaussLegendre rule = make_gauss_legendre(40);
  for (int l = 0; l < 64; ++l) {
    double integral = 0;
    for (std::size_t k = 0; k < rule.nodes.size(); ++k) {
      const double z = 0.5 * (1 + rule.nodes[k]);
      integral += 0.5 * rule.weights[k] * z * std::legendre(static_cast<unsigned>(l), z);
    }
    EXPECT_NEAR(cosine_lobe(l), 2 * pi * std::sqrt((2 * l + 1) / (4 * pi)) * integral, 1e-13) << "degree " << l;
  }
}

TEST(Zonal, CosineLobeHatHasThePublishedValues) {
  const double published[] = {3.141593, 2.094395, 0.785398, 0, -0.130900, 0, 0.049087};
  for (int l = 0; l < 7; ++l) EXPECT_NEAR(cosine_lobe_hat(l), published[l], 5e-7) << "degree " << l;
}

TEST(Zonal, PolynomialConstantsAreThePublishedOnes) {
  const double published[] = {0.429043, 0.511664, 0.743125, 0.886227, 0.247708};
  // The print was made from factors rounded to six digits: its c3 is off by 1.13e-6.
  const auto constants = irradiance_polynomial_constants();
  for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(constants[i], published[i], 1.2e-6) << "c" << i + 1;
}

TEST(Zonal, PolynomialEqualsTheConvolution) {
  RgbCoefficients radiance(3);
  for (std::size_t i = 0; i < 9; ++i)
    radiance[i] = {std::sin(1.0 + double(i)), std::cos(2.0 * double(i)), double(i) - 4};
  const RgbCoefficients irradiance = irradiance_from_radiance(radiance);
  for (const Vec3d n : make_sphere_samples(0, 20, 3).directions) {
    const Rgb difference = eval_irradiance_polynomial(radiance, n) - reconstruct(irradiance, n);
    EXPECT_NEAR(difference.r, 0, 1e-13);
    EXPECT_NEAR(difference.g, 0, 1e-13);
    EXPECT_NEAR(difference.b, 0, 1e-13);
  }
}

TEST(Zonal, UniformLightGivesIrradiancePi) {
  RgbCoefficients radiance(5);
  radiance[0] = {std::sqrt(4 * pi), 0, 0};
  const RgbCoefficients irradiance = irradiance_from_radiance(radiance);
  for (const Vec3d n : make_sphere_samples(0, 5, 3).directions) EXPECT_NEAR(reconstruct(irradiance, n).r, pi, 1e-14);
}

TEST(Zonal, DiscIsItsQuadrature) {
  // Integrated in the disc's own frame, where the integrand is smooth.
  const Vec3d axis = {.36, .48, .80}, u = {.8, -.6, 0}, v = cross(axis, u);
  constexpr int kBands = 9;
  for (const double half_angle : {0.00465, 0.3, pi / 2, 2.5}) {
    RgbCoefficients disc(kBands), expected(kBands);
    add_disc(axis, half_angle, {1, 0, 2}, disc);
    const GaussLegendre rule = make_gauss_legendre(24);
    const double low = std::cos(half_angle), solid = 2 * std::pow(std::sin(half_angle / 2), 2);
    for (std::size_t k = 0; k < rule.nodes.size(); ++k)
      for (int j = 0; j < 32; ++j) {
        const double z = low + solid * 0.5 * (1 + rule.nodes[k]), s = std::sqrt(std::max(0.0, 1 - z * z));
        const double phi = 2 * pi * j / 32, weight = 0.5 * rule.weights[k] * solid * 2 * pi / 32;
        add_delta(z * axis + s * std::cos(phi) * u + s * std::sin(phi) * v, weight * Rgb{1, 0, 2}, expected);
      }
    const double scale = std::sqrt(4 * pi) * solid;
    for (std::size_t i = 0; i < disc.size(); ++i) {
      EXPECT_NEAR(disc[i].r, expected[i].r, 1e-11 * scale) << "half angle " << half_angle << ", coefficient " << i;
      EXPECT_NEAR(disc[i].b, expected[i].b, 2e-11 * scale) << "half angle " << half_angle << ", coefficient " << i;
    }
  }
}

// A hemisphere is the disc of half angle π/2: above, its irradiance is π; below, nothing.
TEST(Zonal, HemisphereLightsWhatFacesIt) {
  RgbCoefficients sky(40);
  add_disc({0, 1, 0}, pi / 2, {1, 1, 1}, sky);
  const RgbCoefficients irradiance = irradiance_from_radiance(sky);
  EXPECT_NEAR(reconstruct(irradiance, {0, 1, 0}).r, pi, 2e-3);
  EXPECT_NEAR(reconstruct(irradiance, {0, -1, 0}).r, 0, 2e-3);
  EXPECT_NEAR(reconstruct(irradiance, {1, 0, 0}).r, pi / 2, 1e-12);
}

// A lobe turned to an axis is the delta from there convolved with it, and its values depend on the angle to it alone.
TEST(Zonal, ATurnedLobeIsAConvolvedDelta) {
  constexpr int kBands = 40;
  const Vec3d axis = {.36, .48, .80};
  const std::vector<double> kernel = make_von_mises_fisher_kernel(kBands, 20);
  RgbCoefficients delta(kBands), lobe(kBands);
  add_delta(axis, {1, 2, 3}, delta);
  add_zonal(kernel, axis, {1, 2, 3}, lobe);
  const RgbCoefficients convolved = convolve(kernel, delta);
  for (std::size_t i = 0; i < lobe.size(); ++i) EXPECT_NEAR(lobe[i].b, convolved[i].b, 1e-15) << "coefficient " << i;
  // κ = 20 leaves less than 1e-12 above 40 bands.
  for (const Vec3d d : make_sphere_samples(0, 6, 3).directions) {
    const double exact = 20 * std::exp(20 * (dot(d, axis) - 1)) / (2 * pi * -std::expm1(-40.0));
    EXPECT_NEAR(reconstruct(lobe, d).r, exact, 1e-11);
  }
}

// Convolutions commute and compose: Henyey-Greenstein's g, twice, is g².
TEST(Zonal, ConvolutionsCompose) {
  RgbCoefficients light(12);
  add_delta({.36, .48, .80}, {1, 2, 3}, light);
  const auto g = make_henyey_greenstein_kernel(12, 0.6), g2 = make_henyey_greenstein_kernel(12, 0.36);
  const RgbCoefficients twice = convolve(g, convolve(g, light)), once = convolve(g2, light);
  for (std::size_t i = 0; i < light.size(); ++i) EXPECT_NEAR(twice[i].g, once[i].g, 1e-15);
}

TEST(Zonal, TheZonalPartOfALobeIsTheLobe) {
  constexpr int kBands = 9;
  const Vec3d axis = {.8, -.6, 0};
  const std::vector<double> kernel = make_cosine_power_kernel(kBands, 5);
  RgbCoefficients lobe(kBands);
  add_zonal(kernel, axis, {1, 0, 2}, lobe);
  const std::vector<Rgb> part = zonal_part(axis, lobe);
  for (std::size_t l = 0; l < part.size(); ++l) {
    EXPECT_NEAR(part[l].r, kernel[l], 1e-15) << "degree " << l;
    EXPECT_NEAR(part[l].b, 2 * kernel[l], 1e-14) << "degree " << l;
  }
}

// A projection: what is left has no zonal part about that axis.
TEST(Zonal, WhatTheZonalPartLeavesHasNone) {
  constexpr int kBands = 6;
  RgbCoefficients light(kBands);
  for (std::size_t i = 0; i < light.size(); ++i) light[i] = {std::sin(1.0 + double(i)), 1, std::cos(2.0 * double(i))};
  const Vec3d axis = {.36, .48, .80};
  const std::vector<Rgb> part = zonal_part(axis, light);
  std::vector<double> red;
  for (const Rgb k : part) red.push_back(k.r);
  RgbCoefficients rest = light;
  add_zonal(red, axis, {-1, 0, 0}, rest);
  for (const Rgb k : zonal_part(axis, rest)) EXPECT_NEAR(k.r, 0, 1e-14);
}

TEST(Zonal, BestAxisIsTheLobes) {
  for (const Vec3d axis : {Vec3d{.36, .48, .80}, {.36, -.48, -.80}, {0, 0, -1}, {1, 0, 0}}) {
    RgbCoefficients lobe(7);
    add_zonal(make_cosine_power_kernel(7, 30), axis, {1, 2, 0}, lobe);
    lobe[0] += Rgb{5, 5, 5};
    // Half of a double's digits: the power is flat at its top.
    EXPECT_NEAR(dot(best_zonal_axis(lobe), axis), 1, 1e-14);
  }
  EXPECT_EQ(best_zonal_axis(RgbCoefficients(1)), (Vec3d{0, 0, 1}));
}

}  // namespace
}  // namespace shlight
