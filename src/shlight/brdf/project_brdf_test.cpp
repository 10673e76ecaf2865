#include "shlight/brdf/project_brdf.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "shlight/brdf/brdf_test_util.h"
#include "shlight/brdf/lambert.h"
#include "shlight/brdf/make_brdf.h"

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

}  // namespace
}  // namespace shlight
