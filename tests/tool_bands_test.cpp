// shlight bands

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tool_test_util.h"

namespace shlight {
namespace {

class ToolBands : public ToolTest {};

// A light that is all there with two bands, brighter from above.
const std::vector<std::string> kTwoBands = {"bands", "--light", "fn:2+z"};

std::vector<std::string> with(std::vector<std::string> arguments, const std::vector<std::string>& more) {
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

TEST_F(ToolBands, FindsHowManyAreEnough) {
  const auto json = run_json(with(kTwoBands, {"--bands", "4"}));
  EXPECT_EQ(json["enough"], 2);
  EXPECT_EQ(json["measure"], "p99");
  EXPECT_EQ(json["tolerance"], 0.01);
  ASSERT_EQ(json["bands"].size(), 4u);
  for (int i = 0; i < 4; ++i) {
    const auto& band = json["bands"][static_cast<std::size_t>(i)];
    EXPECT_EQ(band["n"], i + 1);
    for (const char* key : {"rms", "p99", "max", "rms_local", "max_local"})
      if (i == 0)
        EXPECT_GT(band[key], 0.05) << key;
      else
        EXPECT_LT(band[key], 1e-6) << key;
  }
  // E = 2π + 2π/3 z, of which one band leaves the second part out.
  EXPECT_NEAR(json["bands"][0]["max"], (2.0 / 3) / (2 + 2.0 / 3), 1e-3);
  EXPECT_NEAR(json["bands"][0]["max_local"], (2.0 / 3) / (2 - 2.0 / 3), 1e-3);
  EXPECT_NEAR(json["bands"][0]["light_share"], 4 / (4 + 1.0 / 3), 1e-6);
  EXPECT_NEAR(json["bands"][1]["reflectance_share"], 0.5, 1e-5) << "Basri and Jacobs: 37.5 %, then 87.5 %";
}

TEST_F(ToolBands, PrintsATableAndDrawsAPlot) {
  const ToolRun plain = run(with(kTwoBands, {"--bands", "3", "-o", path("plot.svg")}));
  EXPECT_NE(plain.out.find("2 bands are enough for 1 % (99 % of directions, of the largest)"), std::string::npos)
      << plain;
  const std::string svg = text_of(path("plot.svg"));
  EXPECT_TRUE(svg.starts_with("<svg ") && svg.ends_with("</svg>\n"));
  EXPECT_NE(svg.find("fn:2+z on lambert"), std::string::npos);
}

TEST_F(ToolBands, TakesMaterialsAndWindows) {
  const auto json =
      run_json(with(kTwoBands, {"--bands", "3", "--material", "oren-nayar:sigma=0.5", "--window", "hann:2"}));
  EXPECT_EQ(json["material"], "oren-nayar:sigma=0.5");
  EXPECT_EQ(json["window"], "hann:2");
  EXPECT_EQ(json["enough"], 2);
  // The window halves degree 1, at any number of bands.
  EXPECT_EQ(json["enough_windowed"], nullptr);
  EXPECT_NEAR(json["windowed"][2]["rms"], 0.5 * double(json["bands"][0]["rms"]), 1e-6);
}

TEST_F(ToolBands, TakesModels) {
  const auto open = run_json(with(kTwoBands, {"--bands", "3", "--model", "builtin:sphere", "--transfer", "cosine"}));
  EXPECT_EQ(open["model"], "builtin:sphere");
  EXPECT_EQ(open["enough"], 2);
  EXPECT_EQ(run_tool(with(kTwoBands, {"--transfer", "cosine"})).exit_code, 2);
  EXPECT_EQ(run_tool(with(kTwoBands, {"--model", "builtin:sphere", "--material", "ward"})).exit_code, 2);
  expect_refused(with(kTwoBands, {"--model", path("none.obj")}), path("none.obj"), "");
}

TEST_F(ToolBands, RefusesWhatCannotBe) {
  expect_refused({"bands", "--light", "fn:0"}, "fn:0", "gives no light");
  expect_refused(with(kTwoBands, {"--material", "lambert:rho=0"}), "fn:2+z", "gives no light");
  expect_refused(with(kTwoBands, {"--material", "phong"}), "material 'phong'", "is not known");
  expect_refused({"bands", "--light", path("none.hdr")}, path("none.hdr"), "");
  EXPECT_EQ(run_tool(with(kTwoBands, {"--measure", "mean"})).exit_code, 2);
  EXPECT_EQ(run_tool(with(kTwoBands, {"-o", path("plot.png")})).exit_code, 2);
}

// The errors are said all the same.
TEST_F(ToolBands, FailsWhereNoNumberOfBandsIsEnough) {
  const ToolRun failed = run_tool({"bands", "--light", "builtin:sky", "--bands", "5", "--tolerance", "1e-6"});
  EXPECT_EQ(failed.exit_code, 1) << failed;
  EXPECT_NE(failed.err.find("shlight bands: builtin:sky: no 1 to 5 bands come within --tolerance 1e-06 (99 % of "
                            "directions, of the largest); the best are 5, with "),
            std::string::npos)
      << failed;
  EXPECT_NE(failed.out.find("No 1 to 5 bands are within 0.0001 %"), std::string::npos) << failed;
  // A tolerance that was not asked for is none to fail for.
  EXPECT_EQ(run_json({"bands", "--light", "builtin:sky", "--bands", "2"})["enough"], nullptr);
}

class ToolBandsDrawing : public ToolDrawingTest {
 protected:
  struct Hit {
    Vec3d normal;  // in the camera's frame
    double seen;   // its cosine to the view
    double area;   // of the sphere in the pixel, relative to that of others
  };

  // The unit sphere in the middle of a pixel of pictures of 48 x 48, where its radius is 0.47 of their side.
  static Hit hit_sphere(int x, int y) {
    const double half = std::tan(35.0 / 2 * std::numbers::pi / 180), outline = 2 * 0.47 * half;
    const double distance = std::sqrt(1 + 1 / (outline * outline));
    const Vec3d ray = {(x - 23.5) / 24 * half, (23.5 - y) / 24 * half, -1};
    const double length2 = dot(ray, ray), inside = distance * distance - length2 * (distance * distance - 1);
    if (inside <= 0) return {{0, 0, 1}, 0, 0};
    const double t = (distance - std::sqrt(inside)) / length2, length = std::sqrt(length2);
    const Vec3d n = Vec3d{0, 0, distance} + t * ray;
    const double seen = -dot(n, ray) / length;
    return {n, seen, t * t / (length * seen)};
  }
};

// A drawn sphere, seen from six sides, is as far from the path-traced one as `bands` says.
TEST_F(ToolBandsDrawing, PredictsTheErrorOfASphere) {
  const std::string light = "builtin:studio";
  for (const std::string material : {"lambert:rho=0.8", "ward:rd=0.2,rs=0.4,sigma=0.3"}) {
    const bool is_lambertian = material.starts_with("lambert");
    const auto json = run_json({"bands", "--light", light, "--material", material, "--bands", "3"});
    double squares = 0, count = 0;
    for (const char* camera : {"0,0", "90,0", "180,0", "270,0", "0,90", "0,-90"}) {
      const std::vector<std::string> both = {"render",     "builtin:sphere", "--light",        light,
                                             "--material", material,         "--camera",       camera,
                                             "--size",     "48x48",          "--no-background"};
      run(with(both, {"--method", "reflectance", "--bands", "3", "-o", path("drawn.exr")}));
      run(with(both, {"--method", "reference", "--transfer", "cosine", "--samples", "512", "--deviation",
                      path("noise.exr"), "-o", path("true.exr")}));
      const Image drawn = load_image(path("drawn.exr")).image, truth = load_image(path("true.exr")).image;
      const Image noise = load_image(path("noise.exr")).image;
      for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 48; ++x) {
          const Rgb a = drawn.rgb(x, y), b = truth.rgb(x, y), sigma = noise.rgb(x, y);
          const auto [n, seen, weight_of_area] = hit_sphere(x, y);
          // Pixels of the outline are partly empty, and their share differs between the two.
          if (b.g <= 0 || seen < 0.3) continue;
          // `bands` weights all normals alike. What depends on the normal alone is taken from the view that faces it
          // most; what depends on the view too, from every view, as often as pixels see it.
          if (is_lambertian && (n.z < std::abs(n.x) || n.z < std::abs(n.y))) continue;
          const double weight = is_lambertian ? weight_of_area : 1;
          const double channels[][4] = {{a.r, b.r, sigma.r, json["largest"][0]},
                                        {a.g, b.g, sigma.g, json["largest"][1]},
                                        {a.b, b.b, sigma.b, json["largest"][2]}};
          for (const auto& [value, expected, deviation, largest] : channels) {
            const double error = (value - expected) / largest, traced = deviation / largest;
            // The reference's own noise is not the drawing's error.
            squares += weight * (error * error - traced * traced);
            count += weight;
          }
        }
    }
    const double expected = json["bands"][2]["rms"];
    EXPECT_NEAR(std::sqrt(squares / count), expected, 0.1 * expected) << material;
  }
}

// The picture holds three of the size that was asked for, a scale and words.
TEST_F(ToolBandsDrawing, ComparesWithTheReference) {
  const auto json = run_json({"render", "builtin:sphere", "--light", "builtin:studio", "--bands", "2", "--size",
                              "120x90", "--compare", "--compare-samples", "64", "-o", path("compare.png")});
  const Image picture = load_image(path("compare.png")).image;
  EXPECT_GT(picture.width, 3 * 120);
  EXPECT_GT(picture.height, 90 + 20);
  EXPECT_EQ(json["compare"]["samples"], 64);
  EXPECT_GT(json["compare"]["relative"], 0.01) << "two bands are too few";
  EXPECT_LT(json["compare"]["relative"], 0.5);
  EXPECT_EQ(run_tool({"render", "--compare", "-o", path("compare.exr")}).exit_code, 2);
  EXPECT_EQ(run_tool({"render", "--compare", "--method", "reference"}).exit_code, 2);
  EXPECT_EQ(run_tool({"render", "--compare-samples", "16"}).exit_code, 2);
}

}  // namespace
}  // namespace shlight
