#include "shlight/brdf/project_brdf.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "shlight/brdf/brdf_test_util.h"
#include "shlight/brdf/make_brdf.h"
#include "shlight/sh/rotation.h"

namespace shlight {
namespace {

using std::numbers::pi;

// Kinks of Cook and Torrance's G, which no rule knows of, are what is left.
constexpr double kReferenceTolerance = 5e-6;

// The 55 cases of the thesis's models, integrated elsewhere, to l = 9. They are right to 5e-7 themselves.
TEST(ProjectBrdf, IsTheReferences) {
  const char* data = std::getenv("SHLIGHT_TEST_DATA");
  if (!data) GTEST_SKIP() << "SHLIGHT_TEST_DATA names no folder";
  const auto file = nlohmann::json::parse(std::ifstream(std::string(data) + "/references/brdf.json"));
  ASSERT_EQ(file["cases"].size(), 55u);
  for (const auto& reference : file["cases"]) {
    std::string material = reference["material"];
    char separator = ':';
    for (const auto& [key, value] : reference["parameters"].items()) {
      material += separator + key + "=" + value.dump();
      separator = ',';
    }
    const auto brdf = make_brdf(material);
    const Vec3d v = direction_at(reference["view_theta_deg"], reference["view_phi_deg"]);
    const BrdfProjection projection = project_brdf(*brdf, v, 10);
    RgbCoefficients expected(10);
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const double c = reference["coefs"][i];
      expected[i] = {c, c, c};
    }
    const double error = largest_error(projection.coefficients, expected) / largest_value(expected);
    EXPECT_LT(error, kReferenceTolerance) << material << " at " << reference["view_theta_deg"];
  }
}

// How much of the bare lobe exp(−tan²(θ/2)/m²) of half vectors, seen from the normal, is in 25 coefficients.
TEST(ProjectBrdf, TwentyFiveCoefficientsKeepTheirShareOfALobe) {
  for (const auto& [m, expected] : {std::pair{0.1, 0.388}, {0.2, 0.850}, {0.3, 0.986}}) {
    const auto lobe = [m = m](double z) { return std::exp(-(1 - z) / (1 + z) / (m * m)); };
    const auto brdf = make_function_brdf(
        [&](Vec3d s, Vec3d) {
          const double value = lobe(s.z) / s.z;
          return Rgb{value, value, value};
        },
        BrdfSymmetry::kIsotropic, true, m);
    const RgbCoefficients coefficients = project_brdf(*brdf, {0, 0, 1}, 5).coefficients;
    double kept = 0;
    for (const Rgb c : coefficients.values()) kept += c.g * c.g;
    const GaussLegendre rule = make_gauss_legendre(400);
    double all = 0;
    for (std::size_t i = 0; i < rule.nodes.size(); ++i)
      all += pi * rule.weights[i] * std::pow(lobe(0.5 * (1 + rule.nodes[i])), 2);
    EXPECT_NEAR(kept / all, expected, 5e-4) << "m = " << m;
  }
}

// An isotropic model, turned, is its coefficients turned; and only half of the azimuths is integrated. One that is not
// said to be isotropic takes all of them.
TEST(ProjectBrdf, IsotropyIsUsedRightly) {
  const auto brdf = make_brdf("cook-torrance:m=0.3,f0=0.5");
  const auto plain = make_function_brdf([&](Vec3d s, Vec3d v) { return brdf->eval(s, v); }, BrdfSymmetry::kNone, true);
  for (const double azimuth : {0.0, 77.0, 230.0}) {
    const RgbCoefficients quick = project_brdf(*brdf, direction_at(50, azimuth), 5).coefficients;
    const RgbCoefficients slow = project_brdf(*plain, direction_at(50, azimuth), 5).coefficients;
    EXPECT_LT(largest_error(quick, slow), 2e-5 * largest_value(slow)) << azimuth;
  }
}

// Slim highlights at grazing angles, where sampling would be noise.
TEST(ProjectBrdf, SlimHighlightsAreBruteForce) {
  for (const std::string material :
       {"ggx:alpha=0.02,f0=1", "ward-aniso:rd=0,rs=1,sx=0.02,sy=0.3", "cook-torrance:m=0.02"})
    for (const double degrees : {0.0, 60.0, 89.0}) {
      const auto brdf = make_brdf(material);
      const Vec3d v = direction_at(degrees, 25);
      const RgbCoefficients expected = project_by_brute_force(*brdf, v, 5, 500);
      EXPECT_LT(largest_error(project_brdf(*brdf, v, 5).coefficients, expected), 2e-5 * largest_value(expected))
          << material << " at " << degrees;
    }
}

// The thesis's way, in a frame of its own, comes to the same within its noise.
TEST(ProjectBrdf, MonteCarloIsTheSameInTheWorld) {
  const Rotation frame = rotation_zyz(0.7, 1.1, -0.4);
  const Vec3d normal = frame({0, 0, 1}), tangent = frame({1, 0, 0}), v = direction_at(50, 30);
  const auto brdf = make_brdf("ward-aniso:rd=0.2,rs=0.4,sx=0.3,sy=0.6");
  const RgbCoefficients expected = rotate(frame, project_brdf(*brdf, v, 5).coefficients);
  const SphereSamples samples = make_sphere_samples(5, 200, 3);
  const RgbCoefficients sampled = project_brdf_monte_carlo(*brdf, normal, tangent, frame(v), samples);
  // 40 000 stratified samples.
  EXPECT_LT(largest_error(sampled, expected), 5e-3 * largest_value(expected));
}

}  // namespace
}  // namespace shlight
