#include "shlight/truth/brute_force.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "shlight/brdf/make_brdf.h"
#include "shlight/brdf/project_brdf.h"
#include "shlight/light/builtin_light.h"
#include "shlight/sh/basis.h"
#include "shlight/sh/zonal.h"
#include "shlight/truth/truth_test_util.h"

namespace shlight {
namespace {

Vec3d unit(Vec3d v) {
  return 1 / std::sqrt(dot(v, v)) * v;
}

const Vec3d kNormals[] = {{0, 1, 0}, {0.36, 0.48, 0.8}, {-0.6, -0.64, 0.48}, {0, 0, -1}};

double largest_difference(Rgb a, Rgb b) {
  return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

TEST(BruteForce, IrradianceOfCoefficientsIsTheirConvolution) {
  RgbCoefficients radiance(4);
  for (std::size_t i = 0; i < radiance.size(); ++i) radiance[i] = {noise(1, i), noise(2, i) - 0.5, noise(3, i)};
  const CoefficientLight light(radiance);
  const RgbCoefficients irradiance = irradiance_from_radiance(radiance);
  for (const Vec3d normal : {kNormals[1], kNormals[2]}) {
    const BruteForceResult result = reference_irradiance(light, normal);
    const Rgb expected = reconstruct(irradiance, normal);
    EXPECT_LE(largest_difference(result.value, expected), result.error);
    EXPECT_LT(result.error, 1e-5);
  }
}

// A disc of the half angle α and radiance L at the angle θ from the normal, above the horizon: E = π L sin²α cos θ.
TEST(BruteForce, DiscsHaveTheirClosedForm) {
  for (const double half_angle : {0.0046, 0.1, 0.6}) {
    const Vec3d axis = unit({1, 2, 3});
    const FunctionLight light([](Vec3d) { return Rgb{}; }, {{axis, half_angle, {1, 2, 1e5}}});
    const Vec3d normal = unit({0, 1, 3});
    const BruteForceResult result = reference_irradiance(light, normal);
    const double expected = std::numbers::pi * std::pow(std::sin(half_angle), 2) * dot(axis, normal);
    EXPECT_NEAR(result.value.b, 1e5 * expected, result.error) << half_angle;
    EXPECT_NEAR(result.value.r, expected, 1e-3 * expected) << "edges in 64 x 64 parts of a cell, " << half_angle;
    EXPECT_LT(result.error, 0.02 * result.value.b) << half_angle;
  }
}

// Pixels of constant radiance, in every layout: a closed form in the limit of many bands.
TEST(BruteForce, PicturesOfEveryLayoutAgreeWithTheirCoefficients) {
  for (const Layout layout : all_layouts()) {
    const PictureSize size = picture_size(layout, size_from_horizon(layout, 24));
    Environment environment{noise_image(size.width, size.height, 4), layout};
    clear_unused(environment);
    const ImageLight light(environment);
    const RgbCoefficients irradiance = irradiance_from_radiance(light.project(40, 0));
    // Degrees from 40 on, which are missing: noise of these pixels has coefficients of about 0.05, irradiance's Â_l
    // falls from 5e-4 with the power −5/2, and there are 2l + 1 of each.
    constexpr double kTail = 1.5e-3;
    for (const Vec3d normal : kNormals) {
      const Rgb value = reference_irradiance(light, normal).value;
      EXPECT_LT(largest_difference(value, reconstruct(irradiance, normal)), kTail) << layout_name(layout);
    }
  }
}

// Against coefficients of a light and of a BRDF at one view, which another quadrature made, in the BRDF's frame.
TEST(BruteForce, RadianceOfCoefficientsIsTheirProduct) {
  RgbCoefficients radiance(5);
  for (std::size_t i = 0; i < radiance.size(); ++i) radiance[i] = {noise(1, i), noise(2, i), noise(3, i)};
  radiance[0] = {3, 3, 3};
  const CoefficientLight light(radiance);
  const Rotation to_local = rotation_zyz(0.3, 0.8, -1.1);
  for (const char* material : {"oren-nayar:rho=0.8,sigma=0.5", "ward-aniso:rd=0.2,rs=0.3,sx=0.2,sy=0.5"}) {
    const auto brdf = make_brdf(material);
    const Vec3d v = {0.6, 0, 0.8};
    const BruteForceResult result = reference_radiance(light, *brdf, to_local, inverse(to_local)(v));
    const RgbCoefficients local = rotate(to_local, radiance), f = project_brdf(*brdf, v, 5).coefficients;
    Rgb expected;
    for (std::size_t i = 0; i < f.size(); ++i)
      expected += Rgb{local[i].r * f[i].r, local[i].g * f[i].g, local[i].b * f[i].b};
    EXPECT_LT(largest_difference(result.value, expected), 1e-5 * expected.g) << material;
    EXPECT_LT(result.error, 1e-3 * expected.g) << material;
  }
}

TEST(BruteForce, BlackLightsGiveNothing) {
  const BruteForceResult result = reference_irradiance(ImageLight({Image(8, 4), Layout::kLatLong}), {0, 1, 0});
  EXPECT_EQ(result.value, Rgb{});
  EXPECT_EQ(result.error, 0);
}

// Irradiance by somebody else's quadrature in double, of real lights.
TEST(BruteForce, IrradianceOfRealLights) {
  const char* data = std::getenv("SHLIGHT_TEST_DATA");
  if (!data) GTEST_SKIP() << "SHLIGHT_TEST_DATA names no folder";
  for (const char* name : {"blender_city.exr", "polyhaven_1k_sunset.hdr", "polyhaven_1k_venice.hdr"}) {
    const std::filesystem::path folder = data;
    std::ifstream file(folder / "references" / std::filesystem::path(name).replace_extension(".json"));
    const nlohmann::json reference = nlohmann::json::parse(file);
    const auto light = load_light((folder / "lights" / name).string()).light;
    double largest = 0, error = 0;
    for (const auto& e : reference["irradiance"])
      largest = std::max({largest, double{e[0]}, double{e[1]}, double{e[2]}});
    constexpr std::size_t kEvery = 25;  // of 200 directions
    for (std::size_t i = 0; i < reference["irradiance"].size(); i += kEvery) {
      const auto& n = reference["irradiance_at"][i];
      const auto& e = reference["irradiance"][i];
      error = std::max(
          error, largest_difference(reference_irradiance(*light, unit({n[0], n[1], n[2]})).value, {e[0], e[1], e[2]}));
    }
    EXPECT_LT(error, 1e-4 * largest) << name;
  }
}

}  // namespace
}  // namespace shlight
