// shlight info

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "shlight/light/builtin_light.h"
#include "tool_test_util.h"

namespace shlight {
namespace {

class ToolInfo : public ToolTest {};

TEST_F(ToolInfo, Image) {
  Image image(64, 32);
  for (float& value : image.values) value = 0.5f;
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInfinity = std::numeric_limits<float>::infinity();
  for (int x = 0; x < 3; ++x) image.pixel(x, 0)[0] = kNan;
  for (int x = 0; x < 2; ++x) image.pixel(x, 1)[1] = kInfinity;
  image.pixel(5, 6)[2] = -2;
  image.pixel(7, 6)[2] = 8;
  save_image(folder_ / "a.exr", image);
  const auto info = run_json({"info", path("a.exr")});
  EXPECT_EQ(info["kind"], "image");
  EXPECT_EQ(info["layout"], "lat-long");
  EXPECT_EQ(info["width"], 64);
  EXPECT_EQ(info["height"], 32);
  EXPECT_EQ(info["nan"], 3);
  EXPECT_EQ(info["inf"], 2);
  EXPECT_EQ(info["negative"], 1);
  EXPECT_NE(info["bad_pixels"].get<std::string>().find("5, 6"), std::string::npos) << info["bad_pixels"];
  EXPECT_EQ(info["min"], -2);
  EXPECT_EQ(info["max"], 8);

  save_image(folder_ / "b.exr", Image(48, 48));
  EXPECT_EQ(run_json({"info", path("b.exr"), "--layout", "angular-map"})["layout"], "angular-map");
  EXPECT_EQ(run_json({"info", path("b.exr"), "--layout", "lat-long"})["layout"], "lat-long");
}

// Half of all directions at 3, clamped to 1; an EXPOSURE that is none.
TEST_F(ToolInfo, ClampsAndWarnings) {
  std::string file = "#?RADIANCE\nEXPOSURE=0\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 4\n";
  for (int pixel = 0; pixel < 8; ++pixel) file += pixel < 4 ? "\xc0\xc0\xc0\x82" : "\x80\x80\x80\x81";
  write("a.hdr", file);
  const auto info = run_json({"info", path("a.hdr"), "--clamp", "1"});
  EXPECT_EQ(info["warnings"], nlohmann::json({"1 EXPOSURE line without a positive, finite number, ignored"}));
  EXPECT_EQ(info["max"], 3);
  EXPECT_EQ(info["clamp"]["pixels_above"], 4);
  EXPECT_NEAR(info["clamp"]["lost_share"].get<double>(), 0.5, 1e-12);
  EXPECT_NEAR(info["mean_radiance"][0].get<double>(), 1, 1e-6);
  EXPECT_NEAR(info["energy"][0].get<double>(), 4 * std::numbers::pi, 1e-5);
  const ToolRun project = run({"project", path("a.hdr"), "--clamp", "1"});
  EXPECT_NE(project.err.find("1 EXPOSURE line without"), std::string::npos) << project;
  EXPECT_NE(project.err.find("4 pixels above, with 50 % of the light's luminance"), std::string::npos) << project;
}

TEST_F(ToolInfo, Coefficients) {
  run({"project", "builtin:axes", "--bands", "6", "-o", path("a.json")});
  const auto info = run_json({"info", path("a.json")});
  EXPECT_EQ(info["kind"], "coefficients");
  EXPECT_EQ(info["bands"], 6);
}

// The light 1 + y has the mean 1 and comes from above.
TEST_F(ToolInfo, Formula) {
  const auto info = run_json({"info", "fn:1 + y"});
  EXPECT_EQ(info["kind"], "formula");
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(info["mean_radiance"][c].get<double>(), 1, 1e-12);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(info["dominant_direction"][c].get<double>(), c == 1, 1e-12);
}

TEST_F(ToolInfo, Sun) {
  const auto sun = run_json({"info", "builtin:sky:elevation=40,azimuth=-30"})["sun"];
  EXPECT_NEAR(sun["elevation"].get<double>(), 40, 1e-9);
  EXPECT_NEAR(sun["azimuth"].get<double>(), -30, 1e-9);
  EXPECT_NEAR(sun["direction"][1].get<double>(), std::sin(40 * 3.141592653589793 / 180), 1e-12);
  EXPECT_GT(sun["irradiance"][0].get<double>(), sun["irradiance"][2].get<double>());
  EXPECT_GT(sun["share"].get<double>(), 0.2);
  EXPECT_LT(sun["share"].get<double>(), 0.8);
  EXPECT_FALSE(run_json({"info", "builtin:studio"}).contains("sun"));
  const ToolRun words = run({"info", "builtin:sky:elevation=40"});
  EXPECT_NE(words.out.find("elevation 40, irradiance "), std::string::npos) << words;
}

TEST_F(ToolInfo, Builtin) {
  for (const char* light : {"builtin:sky", "builtin:studio", "builtin:axes", "builtin:thesis"})
    EXPECT_EQ(run_json({"info", light})["kind"], "builtin") << light;
  for (const char* model : {"builtin:sphere", "builtin:knot", "builtin:scene"})
    EXPECT_EQ(run_json({"info", model})["kind"], "model") << model;
}

TEST_F(ToolInfo, Model) {
  // A square of two triangles, and one triangle without area.
  const std::string square = write("square.obj", "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\nf 1 1 2\n");
  const auto info = run_json({"info", square});
  EXPECT_EQ(info["kind"], "model");
  EXPECT_EQ(info["triangles"], 2);
  EXPECT_EQ(info["vertices"], 4);
  EXPECT_EQ(info["bounds_min"], nlohmann::json({0, 0, 0}));
  EXPECT_EQ(info["bounds_max"], nlohmann::json({2, 1, 0}));
}

// People and programs are told the same.
TEST_F(ToolInfo, WordsHoldWhatJsonHolds) {
  const ToolRun words = run({"info", "builtin:sphere"});
  EXPECT_EQ(words.err, "");
  EXPECT_TRUE(words.out.starts_with("builtin:sphere\n")) << words;
  const auto json = run_json({"info", "builtin:sphere"});
  for (const char* key : {"kind", "vertices", "triangles", "meshes"}) {
    const std::string value = json[key].is_string() ? json[key].get<std::string>() : json[key].dump();
    const auto line = words.out.find("\n  " + std::string(key));
    ASSERT_NE(line, std::string::npos) << key << words;
    EXPECT_NE(words.out.substr(line + 1, words.out.find('\n', line + 1) - line).find(value), std::string::npos) << key;
  }
}

}  // namespace
}  // namespace shlight
