// shlight project-brdf

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>

#include "shlight/brdf/make_brdf.h"
#include "shlight/brdf/project_brdf.h"
#include "shlight/sh/zonal.h"
#include "tool_test_util.h"

namespace shlight {
namespace {

class ToolProjectBrdf : public ToolTest {};

TEST_F(ToolProjectBrdf, PrintsTheCoefficients) {
  const auto json = run_json({"project-brdf", "cook-torrance:m=0.3,f0=0.9/0.5/0.1", "--view", "50,30", "--bands", "4"});
  EXPECT_EQ(json["bands"], 4);
  EXPECT_EQ(json["view"]["theta"], 50);
  EXPECT_EQ(json["view"]["phi"], 30);
  ASSERT_EQ(json["coefficients"].size(), 16u);
  const double t = 50 * std::numbers::pi / 180, p = 30 * std::numbers::pi / 180;
  const RgbCoefficients expected = project_brdf(*make_brdf("cook-torrance:m=0.3,f0=0.9/0.5/0.1"),
                                                {std::sin(t) * std::cos(p), std::sin(t) * std::sin(p), std::cos(t)}, 4)
                                       .coefficients;
  for (std::size_t i = 0; i < 16; ++i) {
    EXPECT_NEAR(json["coefficients"][i][0], expected[i].r, 1e-12) << i;
    EXPECT_NEAR(json["coefficients"][i][2], expected[i].b, 1e-12) << i;
  }
}

TEST_F(ToolProjectBrdf, PrintsATable) {
  const ToolRun table = run({"project-brdf", "lambert:rho=0.5", "--view", "20,0", "--bands", "3"});
  EXPECT_NE(table.err.find("reflects 0.5 0.5 0.5 of uniform light"), std::string::npos) << table;
  std::istringstream lines(table.out);
  std::string heading;
  std::getline(lines, heading);
  for (int l = 0; l < 3; ++l)
    for (int m = -l; m <= l; ++m) {
      int shown_l = 0, shown_m = 0;
      double r = 0, g = 0, b = 0;
      ASSERT_TRUE(lines >> shown_l >> shown_m >> r >> g >> b) << table;
      EXPECT_EQ(shown_l, l);
      EXPECT_EQ(shown_m, m);
      EXPECT_NEAR(g, m == 0 ? 0.5 / std::numbers::pi * cosine_lobe(l) : 0, 1e-6);
    }
}

TEST_F(ToolProjectBrdf, MonteCarloIsNearlyTheSame) {
  const std::vector<std::string> arguments = {"project-brdf", "oren-nayar:sigma=0.5", "--view", "60,0"};
  const auto exact = run_json(arguments);
  auto sampled = arguments;
  sampled.insert(sampled.end(), {"--method", "monte-carlo", "--samples", "40000"});
  const auto json = run_json(sampled);
  for (std::size_t i = 0; i < 25; ++i)
    EXPECT_NEAR(json["coefficients"][i][1], double(exact["coefficients"][i][1]), 2e-3);
}

TEST_F(ToolProjectBrdf, BadMaterialsAreRefused) {
  expect_refused({"project-brdf", "phong", "--view", "0,0"}, "material 'phong'", "is not known");
  expect_refused({"project-brdf", "ward", "--view", "0,0", "--method", "monte-carlo", "--samples", "20000000"},
                 "--samples 20000000", "too much memory");
  expect_refused({"project-brdf", "ward:sigma=2", "--view", "0,0"}, "ward", "sigma is 2");
  expect_refused({"project-brdf", "merl:" + path("none.binary"), "--view", "0,0"}, path("none.binary"), "");
  expect_refused({"project-brdf", "merl:" + write("short.binary", "MERL"), "--view", "0,0"}, path("short.binary"),
                 "has 4 bytes");
  expect_refused({"project-brdf", "cornell:" + write("short.txt", "0.1 0 0.1 0 1 2\n"), "--view", "0,0"},
                 path("short.txt"), "line 1 has not 35 numbers");
}

// The thesis's models, integrated elsewhere, from one of the polar angles; test ProjectBrdf.IsTheReferences has all.
TEST_F(ToolProjectBrdf, IsTheReferences) {
  SHLIGHT_TEST_DATA_OR_SKIP(data);
  const auto file = nlohmann::json::parse(std::ifstream(std::string(data) + "/references/brdf.json"));
  for (const auto& reference : file["cases"]) {
    if (reference["view_theta_deg"] != 70) continue;
    std::string material = reference["material"];
    char separator = ':';
    for (const auto& [key, value] : reference["parameters"].items()) {
      material += separator + key + "=" + value.dump();
      separator = ',';
    }
    const std::string view = reference["view_theta_deg"].dump() + "," + reference["view_phi_deg"].dump();
    const auto json = run_json({"project-brdf", material, "--view", view, "--bands", "10"});
    double largest = 0, error = 0;
    for (std::size_t i = 0; i < 100; ++i) {
      const double expected = reference["coefs"][i];
      largest = std::max(largest, std::abs(expected));
      error = std::max(error, std::abs(double(json["coefficients"][i][0]) - expected));
    }
    // Kinks of Cook and Torrance's G, and the references' own error, leave some 1e-6.
    EXPECT_LT(error, 1e-5 * largest) << material << " from " << view;
  }
}

}  // namespace
}  // namespace shlight
