#include "shlight/light/formula_light.h"

#include <gtest/gtest.h>

#include <string>

#include "shlight/core/error.h"
#include "shlight/light/builtin_light.h"
#include "shlight/sh/sphere_samples.h"

namespace shlight {
namespace {

std::string error_of(const std::string& formula) {
  try {
    make_formula_light(formula)->project(2);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(FormulaLight, EvaluatesItsVariables) {
  const Vec3d d = {.36, .48, .80};
  const auto value = [&](const char* formula) { return make_formula_light(formula)->radiance(d); };
  EXPECT_NEAR(value("x + 10*y + 100*z").g, .36 + 4.8 + 80, 1e-12);
  EXPECT_NEAR(value("cos(theta)").r, .80, 1e-12);
  EXPECT_NEAR(value("sin(theta)*sin(phi)").b, .48, 1e-12);
  EXPECT_EQ(value("r=1; b = 3"), (Rgb{1, 0, 3}));
  EXPECT_EQ(value("x == 1 ? 2 : 3"), (Rgb{3, 3, 3}));
  EXPECT_NEAR(value("clamp(z, 0, 0.5) + smoothstep(0, 1, 0.5)").r, 1, 1e-12);
}

TEST(FormulaLight, TheThesissFormulaIsTheThesissLight) {
  const auto formula = make_formula_light("max(0, 5*cos(theta)-4) + max(0, -4*sin(theta-pi)*cos(phi-2.5)-3)");
  const auto builtin = make_thesis_light();
  for (const Vec3d d : make_sphere_samples(0, 20, 8).directions)
    EXPECT_NEAR(formula->radiance(d).r, builtin->radiance(d).r, 1e-12);
}

TEST(FormulaLight, RefusesWhatDoesNotParse) {
  for (const char* formula : {"", " ", "max(", "x +", "sin", "q", "1, 2", "r=1; r=2", "r=1; q=2", "r=", "1;2", "x=1"}) {
    const std::string error = error_of(formula);
    EXPECT_TRUE(error.starts_with("fn: ")) << formula << ": " << error;
    EXPECT_NE(error.find("an expression in theta, phi, x, y, z"), std::string::npos) << error;
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
  }
  EXPECT_NE(error_of(std::string(20000, '1')), "no error");
  EXPECT_NE(error_of(std::string(5000, '(')), "no error");
}

TEST(FormulaLight, RefusesWhatIsNotFinite) {
  EXPECT_NE(error_of("sqrt(x)").find("is NaN at x = "), std::string::npos) << error_of("sqrt(x)");
  EXPECT_NE(error_of("exp(1000)").find("is infinite at x = "), std::string::npos);
}

}  // namespace
}  // namespace shlight
