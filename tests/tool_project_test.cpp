// shlight project

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <sstream>

#include "shlight/light/builtin_light.h"
#include "shlight/light/coefficient_file.h"
#include "shlight/sh/basis.h"
#include "shlight/sh/rotation.h"
#include "shlight/sh/sphere_samples.h"
#include "shlight/sh/window.h"
#include "shlight/sh/zonal.h"
#include "tool_test_util.h"

namespace shlight {
namespace {

class ToolProject : public ToolTest {};

TEST_F(ToolProject, PrintsATableOfTheCoefficients) {
  const ToolRun table = run({"project", "builtin:axes", "--bands", "4"});
  EXPECT_EQ(table.err, "");
  const RgbCoefficients exact = make_axes_light()->project(4);
  std::istringstream lines(table.out);
  std::string heading;
  std::getline(lines, heading);
  EXPECT_EQ(heading, "  l   m           red         green          blue");
  for (int l = 0; l < 4; ++l)
    for (int m = -l; m <= l; ++m) {
      int shown_l = 0, shown_m = 0;
      Rgb c;
      ASSERT_TRUE(lines >> shown_l >> shown_m >> c.r >> c.g >> c.b) << table.out;
      EXPECT_EQ(shown_l, l);
      EXPECT_EQ(shown_m, m);
      // Six digits.
      EXPECT_NEAR(c.r, exact.at(l, m).r, 5e-6 * std::abs(exact.at(l, m).r));
      EXPECT_NEAR(c.g, exact.at(l, m).g, 5e-6 * std::abs(exact.at(l, m).g));
      EXPECT_NEAR(c.b, exact.at(l, m).b, 5e-6 * std::abs(exact.at(l, m).b));
    }
  std::string more;
  EXPECT_FALSE(lines >> more) << more;
}

TEST_F(ToolProject, PrintsAndWritesTheSameFile) {
  const ToolRun both = run({"project", "builtin:sky", "--bands", "3", "--json", "-o", path("a.json")});
  EXPECT_EQ(both.out, text_of(path("a.json")));
  EXPECT_EQ(load_coefficients(path("a.json")), load_light("builtin:sky").light->project(3));
  const ToolRun file_only = run({"project", "builtin:sky", "-o", path("b.json")});
  EXPECT_EQ(file_only.out, "");
  EXPECT_EQ(text_of(path("b.json")), text_of(path("a.json")));
}

TEST_F(ToolProject, ACoefficientFileIsItsOwnProjection) {
  run({"project", "builtin:studio", "--bands", "5", "-o", path("a.json")});
  EXPECT_EQ(run({"project", path("a.json"), "--bands", "5", "--json"}).out, text_of(path("a.json")));
  run({"project", path("a.json"), "--bands", "5", "-o", path("a.json")});
  EXPECT_EQ(load_coefficients(path("a.json")), load_light("builtin:studio").light->project(5));
}

TEST_F(ToolProject, BandsAreCutOffOrZero) {
  run({"project", "builtin:axes", "--bands", "4", "-o", path("four.json")});
  const RgbCoefficients four = load_coefficients(path("four.json"));
  EXPECT_EQ(four.bands(), 4);
  for (const int bands : {1, 2, 7}) {
    const ToolRun resized =
        run({"project", path("four.json"), "--bands", std::to_string(bands), "-o", path("resized.json")});
    EXPECT_EQ(load_coefficients(path("resized.json")), resize_bands(four, bands));
    EXPECT_EQ(resized.err,
              bands <= 4 ? "" : "warning: " + path("four.json") + ": holds 4 bands; those above are zero\n");
  }
}

TEST_F(ToolProject, LayoutsAreToldOrNamed) {
  const auto axes = make_axes_light();
  save_image(folder_ / "a.exr", axes->lat_long(256));
  EXPECT_EQ(run({"project", path("a.exr"), "-o", path("told.json")}).err,
            "info: " + path("a.exr") + ": 256 x 128 pixels, taken as lat-long\n");
  EXPECT_EQ(run({"project", path("a.exr"), "-o", path("named.json"), "--layout", "lat-long"}).err, "");
  EXPECT_EQ(text_of(path("told.json")), text_of(path("named.json")));
  run({"project", path("a.exr"), "-o", path("other.json"), "--layout", "openexr-lat-long"});
  EXPECT_NE(text_of(path("told.json")), text_of(path("other.json")));
}

TEST_F(ToolProject, MonteCarloIsWithinTheErrorItStates) {
  const RgbCoefficients exact = make_axes_light()->project(4);
  double last_error = 1e9;
  for (const int samples : {400, 40000}) {
    const ToolRun random = run({"project", "builtin:axes", "--bands", "4", "--method", "monte-carlo", "--samples",
                                std::to_string(samples), "-o", path("a.json")});
    int shown_samples = 0;
    double error = 0;
    ASSERT_EQ(std::sscanf(random.err.c_str(), "info: %d samples, largest standard error of a coefficient %lf",
                          &shown_samples, &error),
              2)
        << random;
    EXPECT_EQ(shown_samples, samples);
    const RgbCoefficients c = load_coefficients(path("a.json"));
    double largest = 0;
    for (std::size_t i = 0; i < c.size(); ++i) {
      const Rgb d = c[i] - exact[i];
      largest = std::max({largest, std::abs(d.r), std::abs(d.g), std::abs(d.b)});
    }
    // Stratified samples are better than their standard error says; 48 values rarely hold one of more than four.
    EXPECT_LT(largest, 4 * error);
    EXPECT_GT(largest, 0);
    EXPECT_LT(error, last_error / 5) << "a hundred times the samples, a tenth of the error";
    last_error = error;
  }
}

TEST_F(ToolProject, MonteCarloGivesTheSameForTheSameSeed) {
  const std::vector<std::string> command = {"project", "builtin:sky", "--method", "monte-carlo", "--json", "--seed"};
  const auto with_seed = [&](const char* seed) {
    auto arguments = command;
    arguments.push_back(seed);
    return run(arguments).out;
  };
  EXPECT_EQ(with_seed("7"), with_seed("7"));
  EXPECT_NE(with_seed("7"), with_seed("8"));
}

TEST_F(ToolProject, SameBitsForAnyNumberOfThreads) {
  save_image(folder_ / "a.exr", make_axes_light()->lat_long(512));
  for (const std::string& light : {path("a.exr"), std::string("fn:max(0, x + y^3)")}) {
    const std::string one = run({"project", light, "--bands", "6", "--json", "--threads", "1"}).out;
    for (const char* threads : {"2", "5"})
      EXPECT_EQ(run({"project", light, "--bands", "6", "--json", "--threads", threads}).out, one) << light;
  }
}

// The thesis's light is built in and can be written as a formula.
TEST_F(ToolProject, AFormulaIsALight) {
  const std::string formula = "fn:max(0, 5*cos(theta)-4) + max(0, -4*sin(theta-pi)*cos(phi-2.5)-3)";
  EXPECT_EQ(run({"project", formula, "--json"}).out, run({"project", "builtin:thesis", "--json"}).out);
  run({"project", "fn:r=1; b=y", "-o", path("a.json")});
  const RgbCoefficients c = load_coefficients(path("a.json"));
  EXPECT_NEAR(c.at(0, 0).r, std::sqrt(4 * M_PI), 1e-12);
  EXPECT_NEAR(c.at(1, -1).b, std::sqrt(4 * M_PI / 3), 1e-12);
  EXPECT_EQ(c.at(0, 0).g, 0);
}

TEST_F(ToolProject, MoreSamplesThanFitIntoMemoryAreRefused) {
  const ToolRun refused =
      run_tool({"project", "builtin:axes", "--method", "monte-carlo", "--bands", "256", "--samples", "100000000"});
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_EQ(refused.err,
            "shlight project: --samples 100000000: needs too much memory: at most 4096 samples at 256 bands\n");
}

TEST_F(ToolProject, RotateTurnsTheLight) {
  // A quarter turn about +Y takes +Z to +X: as angles about z, y, z, as a quaternion and as a matrix.
  const RgbCoefficients expected =
      rotate(rotation_about_y(std::numbers::pi / 2), load_light("builtin:sky").light->project(3));
  for (const char* rotation : {"0,90,0", "0.7071067811865476,0,0.7071067811865476,0", "0,0,1,0,1,0,-1,0,0"}) {
    run({"project", "builtin:sky", "--rotate", rotation, "-o", path("a.json")});
    const RgbCoefficients turned = load_coefficients(path("a.json"));
    for (std::size_t i = 0; i < 9; ++i) EXPECT_NEAR(turned[i].g, expected[i].g, 1e-12) << rotation;
  }
  for (const char* wrong : {"", "1", "1,2", "0,0,0,0", "1,2,x", "nan,0,0", "1,0,0,0,1,0,0,0,-1", "2,0,0,0,1,0,0,0,1"})
    EXPECT_EQ(run_tool({"project", "builtin:sky", "--rotate", wrong}).exit_code, 2) << wrong;
}

TEST_F(ToolProject, SplitsTheSunOff) {
  const ToolRun both = run({"project", "builtin:sky:elevation=20,azimuth=90", "--split-sun", "--rotate", "0,90,0",
                            "--json", "-o", path("a.json")});
  EXPECT_EQ(both.out, text_of(path("a.json")));
  EXPECT_NE(both.err.find("elevation 20.00 degrees, irradiance "), std::string::npos) << both.err;
  const CoefficientFile file = load_coefficient_file(path("a.json"));
  ASSERT_TRUE(file.sun);
  // About +Y by 90°, from +X to −Z, and the rest with it.
  const double degree = std::numbers::pi / 180;
  EXPECT_NEAR(file.sun->direction.y, std::sin(20 * degree), 1e-12);
  EXPECT_NEAR(file.sun->direction.z, -std::cos(20 * degree), 1e-12);
  const RgbCoefficients whole =
      rotate(rotation_about_y(90 * degree), load_light("builtin:sky:elevation=20,azimuth=90").light->project(3));
  const RgbCoefficients again = load_coefficients(path("a.json"));
  for (std::size_t i = 0; i < whole.size(); ++i) EXPECT_NEAR(again[i].g, whole[i].g, 1e-4 * whole[0].g) << i;
  // The file is a light like any other, with its sun in it or not.
  run({"project", path("a.json"), "-o", path("whole.json")});
  EXPECT_FALSE(load_coefficient_file(path("whole.json")).sun);
  EXPECT_EQ(load_coefficients(path("whole.json")), again);
  run({"project", path("a.json"), "--split-sun", "-o", path("same.json")});
  EXPECT_EQ(text_of(path("same.json")), text_of(path("a.json")));
  // A window smooths what is left, not the sun.
  run({"project", path("a.json"), "--split-sun", "--window", "hann:2", "-o", path("smooth.json")});
  EXPECT_EQ(load_coefficient_file(path("smooth.json")).sun->irradiance, file.sun->irradiance);
  EXPECT_EQ(load_coefficient_file(path("smooth.json")).coefficients,
            apply_window(Window::kHann, 0.5, file.coefficients));

  const ToolRun none = run({"project", "builtin:studio", "--split-sun", "-o", path("b.json")});
  EXPECT_NE(none.err.find("builtin:studio: has no sun"), std::string::npos) << none.err;
  EXPECT_FALSE(load_coefficient_file(path("b.json")).sun);
  EXPECT_EQ(load_coefficients(path("b.json")), load_light("builtin:studio").light->project(3));
}

TEST_F(ToolProject, WindowsTakeTheRingingAway) {
  // A low sun: cut off after three bands, its irradiance is negative on the far side.
  RgbCoefficients sun(3);
  add_delta({.36, .48, .80}, {1, 1, 1}, sun);
  save_coefficients(path("sun.json"), sun);
  const auto darkest = [&](const std::string& window) {
    run({"project", path("sun.json"), "--window", window, "-o", path("a.json")});
    const RgbCoefficients irradiance = irradiance_from_radiance(load_coefficients(path("a.json")));
    double smallest = 1;
    for (const Vec3d d : make_sphere_samples(0, 60, 1).directions)
      smallest = std::min(smallest, reconstruct(irradiance, d).g);
    return smallest;
  };
  EXPECT_LT(darkest("none"), -0.01);
  EXPECT_GE(darkest("auto"), 0);
  EXPECT_LT(darkest("auto"), 1e-3);  // and no smoother than that takes
  EXPECT_GT(darkest("laplacian:0.5"), 0);
  run({"project", path("sun.json"), "--window", "hann:3", "-o", path("hann.json")});
  EXPECT_EQ(load_coefficients(path("hann.json")), apply_window(Window::kHann, 1.0 / 3, sun));
  run({"project", path("sun.json"), "--window", "lanczos:4", "-o", path("lanczos.json")});
  EXPECT_EQ(load_coefficients(path("lanczos.json")), apply_window(Window::kLanczos, 1.0 / 4, sun));
  const ToolRun told = run({"project", path("sun.json"), "--window", "auto"});
  EXPECT_NE(told.err.find("certified to be at least 0"), std::string::npos) << told.err;
  for (const char* wrong : {"", "hann", "hann:0", "hann:x", "laplacian:-1", "boxcar:3", "auto:1"})
    EXPECT_EQ(run_tool({"project", "builtin:sky", "--window", wrong}).exit_code, 2) << wrong;
}

}  // namespace
}  // namespace shlight
