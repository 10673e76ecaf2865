#include "shlight/truth/band_error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "shlight/brdf/make_brdf.h"
#include "shlight/brdf/project_brdf.h"
#include "shlight/light/builtin_light.h"
#include "shlight/sh/basis.h"
#include "shlight/sh/window.h"
#include "shlight/sh/zonal.h"
#include "shlight/truth/brute_force.h"
#include "shlight/truth/truth_test_util.h"

namespace shlight {
namespace {

const Vec3d kSunDirection = {0.36, 0.48, 0.8};

CoefficientLight make_directional_light() {
  return CoefficientLight(RgbCoefficients(1), Sun{kSunDirection, {1, 2, 3}});
}

// The series of max(0, z) by 2, 3, 5 bands is off most by 1/4, 3/32, 15/256.
TEST(BandError, OfADirectionalLightHasItsClosedForm) {
  const auto brdf = make_brdf("lambert:rho=0.5");
  const BandErrors errors = *measure_band_errors(make_directional_light(), *brdf);
  // The nearest of 4096 normals to the terminator, where the error has its kink, is nearer than this.
  constexpr double kNearest = 5e-4;
  EXPECT_NEAR(errors.bands[1].max, 0.25, kNearest);
  EXPECT_NEAR(errors.bands[2].max, 0.09375, kNearest);
  EXPECT_NEAR(errors.bands[4].max, 0.05859375, kNearest);
  EXPECT_NEAR(dot(errors.bands[2].worst_normal, kSunDirection), 0, 2 * kNearest);
  // Odd degrees but the first add nothing.
  EXPECT_EQ(errors.bands[3].max, errors.bands[2].max);
  // The mean square over the sphere is what is left of ∫ max(0, z)² = 2π/3, of which Basri and Jacobs print .9922.
  EXPECT_NEAR(errors.bands[2].rms, std::sqrt((1 - 127.0 / 128) / 6), 1e-5);
  EXPECT_NEAR(errors.largest.g, 2 * 0.5 / 3.14159265358979, 1e-3);
  EXPECT_EQ(errors.reference_error, 0);
}

TEST(BandError, EnergyOfTheCosineIsBasrisAndJacobss) {
  const BandErrors errors = *measure_band_errors(make_directional_light(), *make_brdf("lambert"));
  double sum = 0;
  const double expected[] = {0.375, 0.875, 0.9922, 0.9922, 0.9980};
  for (std::size_t l = 0; l < 5; ++l) {
    sum += errors.reflectance_energy[l];
    EXPECT_NEAR(sum / errors.reflectance_total, expected[l], 6e-5) << l;
  }
}

// A light that is four bands is all there with four; with less, it is off by what it was.
TEST(BandError, VanishesWithAllOfALightsBands) {
  RgbCoefficients radiance(4);
  for (std::size_t i = 0; i < radiance.size(); ++i) radiance[i] = {noise(1, i), noise(2, i), noise(3, i)};
  radiance[0] = {5, 5, 5};
  const CoefficientLight light(radiance);
  for (const char* material : {"lambert", "oren-nayar:sigma=0.6", "ward-aniso:sx=0.2,sy=0.4"}) {
    BandErrorParams params{.max_bands = 6};
    params.normals = {{{0, 1, 0}}, {{0.36, 0.48, 0.8}}, {{-0.6, -0.64, 0.48}}, {{0, 0, -1}}};
    const BandErrors errors = *measure_band_errors(light, *make_brdf(material), params);
    EXPECT_LT(errors.bands[3].max, 1e-12) << material;
    EXPECT_LT(errors.bands[5].max_local, 1e-12) << material;
    EXPECT_GT(errors.bands[1].max, 1e-3) << material;
  }
}

// What is said to be true at the worst normal and view, and the error there, by brute force.
TEST(BandError, WorstDirectionIsAsBadByBruteForce) {
  Environment environment{noise_image(32, 16, 7), Layout::kLatLong};
  environment.image.set_rgb(9, 4, {60, 40, 20});
  const ImageLight light(environment);
  for (const char* material :
       {"lambert:rho=0.8", "ward:rd=0.2,rs=0.4,sigma=0.2", "ward-aniso:rd=0.1,rs=0.4,sx=0.15,sy=0.4"}) {
    const auto brdf = make_brdf(material);
    const BandErrors errors = *measure_band_errors(light, *brdf, {.max_bands = 4});
    const BandError& error = errors.bands[3];
    const Vec3d n = error.worst_normal;
    const double s = std::sqrt(n.x * n.x + n.z * n.z);
    const Vec3d tangent = 1 / s * Vec3d{n.z, 0, -n.x};
    const Rotation to_local = {{tangent, cross(n, tangent), n}};
    const Rgb truth = reference_radiance(light, *brdf, to_local, error.worst_view).value;
    const RgbCoefficients local = rotate(to_local, light.project(4, 1));
    const RgbCoefficients f = project_brdf(*brdf, to_local(error.worst_view), 4).coefficients;
    Rgb sum;
    for (std::size_t i = 0; i < f.size(); ++i)
      sum += Rgb{local[i].r * f[i].r, local[i].g * f[i].g, local[i].b * f[i].b};
    const double worst =
        std::max({std::abs(sum.r - truth.r) / errors.largest.r, std::abs(sum.g - truth.g) / errors.largest.g,
                  std::abs(sum.b - truth.b) / errors.largest.b});
    // 2 x 2 points stand for the bright pixel, 11° wide, and the tail of the noise's bands is cut off.
    EXPECT_NEAR(worst, error.max, 5e-3) << material << ", " << errors.reference_error;
    EXPECT_GT(error.max, 0.02) << material;
  }
}

TEST(BandError, HasTheSameBitsOnAnyNumberOfThreads) {
  Environment environment{noise_image(32, 16, 7), Layout::kLatLong};
  environment.image.set_rgb(9, 4, {60, 40, 20});
  const ImageLight light(environment);
  BandErrorParams params;
  for (const Vec3d n : {Vec3d{0, 1, 0}, Vec3d{0.36, 0.48, 0.8}, Vec3d{-0.6, -0.64, 0.48}, Vec3d{0, 0, -1}})
    params.normals.push_back({n});
  for (const char* material : {"lambert", "ward:rd=0.2,rs=0.4,sigma=0.3"}) {
    const auto brdf = make_brdf(material);
    params.threads = 1;
    const BandErrors one = *measure_band_errors(light, *brdf, params);
    params.threads = 3;
    const BandErrors three = *measure_band_errors(light, *brdf, params);
    for (std::size_t i = 0; i < one.bands.size(); ++i) {
      EXPECT_EQ(one.bands[i].rms, three.bands[i].rms);
      EXPECT_EQ(one.bands[i].max_local, three.bands[i].max_local);
    }
    EXPECT_EQ(one.reference_error, three.reference_error);
  }
}

// A window that takes all but the mean away leaves the errors of one band.
TEST(BandError, IsMeasuredWithAWindowToo) {
  BandErrorParams params;
  params.shape = [](const RgbCoefficients& c) { return apply_window(Window::kHann, 1, c); };
  const BandErrors errors = *measure_band_errors(make_directional_light(), *make_brdf("lambert"), params);
  ASSERT_EQ(errors.shaped.size(), errors.bands.size());
  EXPECT_NEAR(errors.shaped[4].rms, errors.bands[0].rms, 1e-12);
  EXPECT_LT(errors.bands[4].rms, errors.bands[0].rms);
}

// Weights stand for how often a normal is there.
TEST(BandError, WeighsNormals) {
  const auto light = make_directional_light();
  const auto brdf = make_brdf("lambert");
  const Vec3d up = {0, 1, 0}, side = {1, 0, 0};
  BandErrorParams twice, weighted;
  twice.normals = {{up}, {side}, {side}, {side}};
  weighted.normals = {{up, 2}, {side, 6}};
  EXPECT_NEAR(measure_band_errors(light, *brdf, twice)->bands[2].rms,
              measure_band_errors(light, *brdf, weighted)->bands[2].rms, 1e-14);
}

TEST(BandError, OfABlackLightIsNothing) {
  EXPECT_FALSE(measure_band_errors(ImageLight({Image(8, 4), Layout::kLatLong}), *make_brdf("lambert")));
}

TEST(BandError, FindsEnoughBands) {
  std::vector<BandError> errors(4);
  const double rms[] = {0.5, 0.01, 0.02, 0.005};
  for (std::size_t i = 0; i < 4; ++i) errors[i].bands = static_cast<int>(i) + 1, errors[i].rms = rms[i];
  EXPECT_EQ(find_enough_bands(errors, &BandError::rms, 1), 1);
  EXPECT_EQ(find_enough_bands(errors, &BandError::rms, 0.02), 2);
  EXPECT_EQ(find_enough_bands(errors, &BandError::rms, 0.01), 4) << "three are worse than two";
  EXPECT_EQ(find_enough_bands(errors, &BandError::rms, 0.001), std::nullopt);
}

// Somebody else's quadrature in double, at 200 normals.
TEST(BandError, IsTheReferences) {
  const char* data = std::getenv("SHLIGHT_TEST_DATA");
  if (!data) GTEST_SKIP() << "SHLIGHT_TEST_DATA names no folder";
  const std::filesystem::path folder = data;
  for (const char* name : {"blender_city.exr", "blender_night.exr", "blender_studio.exr", "polyhaven_1k_city.hdr",
                           "polyhaven_1k_studio.hdr", "polyhaven_1k_sunset.hdr", "polyhaven_1k_venice.hdr"}) {
    std::ifstream file(folder / "references" / std::filesystem::path(name).replace_extension(".json"));
    const nlohmann::json reference = nlohmann::json::parse(file);
    BandErrorParams params;
    for (const auto& n : reference["irradiance_at"]) {
      const Vec3d v = {n[0], n[1], n[2]};
      params.normals.push_back({1 / std::sqrt(dot(v, v)) * v});
    }
    const auto light = load_light((folder / "lights" / name).string()).light;
    const BandErrors errors = *measure_band_errors(*light, *make_brdf("lambert"), params);
    for (const BandError& error : errors.bands) {
      const std::string coefficients = std::to_string(num_coefficients(error.bands));
      if (!reference["errors"].contains(coefficients)) continue;
      const auto& expected = reference["errors"][coefficients];
      // Degrees from 64 on, of the truth.
      constexpr double kTail = 2e-5;
      EXPECT_NEAR(error.mean, double(expected["mean_abs_over_maxE"]), kTail) << name << " " << coefficients;
      EXPECT_NEAR(error.max, double(expected["max_abs_over_maxE"]), 10 * kTail) << name << " " << coefficients;
      EXPECT_NEAR(error.mean_local, double(expected["mean_rel"]), 0.01 * double(expected["mean_rel"]) + kTail)
          << name << " " << coefficients;
      EXPECT_NEAR(error.max_local, double(expected["max_rel"]), 0.03 * double(expected["max_rel"]) + kTail)
          << name << " " << coefficients;
    }
  }
}

}  // namespace
}  // namespace shlight
