// shlight render and shlight demo

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "shlight/light/builtin_light.h"
#include "shlight/light/coefficient_file.h"
#include "shlight/scene/builtin_scene.h"
#include "tool_test_util.h"

namespace shlight {
namespace {

constexpr double kHalfPrecision = 1.0 / 1024;

class ToolRender : public ToolDrawingTest {
 protected:
  void SetUp() override {
    ToolDrawingTest::SetUp();
    save_image(axes_, make_axes_light()->lat_long(256));
  }

  // Draws a small picture of the built-in sphere, under the light of the axes if no other is given.
  Image draw(const std::vector<std::string>& more) const {
    std::vector<std::string> arguments = {"render", "builtin:sphere", "--size", "81x61", "-o", path("draw.exr")};
    if (std::ranges::find(more, "--light") == more.end()) arguments.insert(arguments.end(), {"--light", axes_});
    arguments.insert(arguments.end(), more.begin(), more.end());
    run(arguments);
    return load_image(folder_ / "draw.exr").image;
  }

  const std::string axes_ = path("axes.exr");
};

double mean_byte(const Image8& picture) {
  double sum = 0;
  for (std::size_t i = 0; i < picture.values.size(); ++i) sum += i % 4 == 3 ? 0 : picture.values[i];
  return sum / (0.75 * static_cast<double>(picture.values.size()));
}

double max_difference(const Image& a, const Image& b) {
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.height, b.height);
  double largest = 0;
  for (std::size_t i = 0; i < a.values.size(); ++i)
    largest = std::max(largest, static_cast<double>(std::abs(a.values[i] - b.values[i])));
  return largest;
}

TEST_F(ToolRender, WritesAPictureOfTheSizeAskedFor) {
  const ToolRun done = run({"render", "--size", "160x90", "-o", path("a.png")});
  EXPECT_EQ(done.out, "");
  EXPECT_TRUE(done.err.starts_with("info: " + path("a.png") + ": 160 x 90, ")) << done;
  const Image8 picture = load_image8(folder_ / "a.png");
  EXPECT_EQ(picture.width, 160);
  EXPECT_EQ(picture.height, 90);
  EXPECT_GT(mean_byte(picture), 40);
  EXPECT_LT(mean_byte(picture), 215);
}

TEST_F(ToolRender, TellsProgramsWhatItDid) {
  const auto json = run_json({"render", "builtin:sphere", "--light", axes_, "--size", "40x30"});
  EXPECT_GT(json["frame_ms"].get<double>(), 0);
  EXPECT_EQ(json["width"], 40);
  EXPECT_EQ(json["height"], 30);
  EXPECT_EQ(json["triangles"], run_json({"info", "builtin:sphere"})["triangles"]);
  EXPECT_FALSE(json["gl_renderer"].get<std::string>().empty());
  EXPECT_EQ(contents().size(), 1u) << "--json alone writes no picture";
}

// Furnace: under the same light from everywhere a surface's radiance is its reflectance times that light's, whatever
// its normal.
TEST_F(ToolRender, LinearPicturesHoldRadiance) {
  const Vec3f reflectance = make_sphere_scene().materials[0].base_color;
  for (const Rgb radiance : {Rgb{1, 1, 1}, {2, 20, 200000}}) {
    RgbCoefficients light(1);
    light[0] = std::sqrt(4 * std::numbers::pi) * radiance;
    save_coefficients(folder_ / "light.json", light);
    const Image image = draw({"--light", path("light.json"), "--exposure", "3"});
    for (const auto& [x, y] : {std::pair{40, 30}, {25, 20}, {40, 52}}) {
      EXPECT_NEAR(image.rgb(x, y).r / radiance.r, reflectance.x, kHalfPrecision) << x << " " << y;
      EXPECT_NEAR(image.rgb(x, y).g / radiance.g, reflectance.y, kHalfPrecision) << x << " " << y;
      EXPECT_NEAR(image.rgb(x, y).b / radiance.b, reflectance.z, kHalfPrecision) << x << " " << y;
    }
    EXPECT_NEAR(image.rgb(0, 0).r / radiance.r, 1, kHalfPrecision);
    EXPECT_NEAR(image.rgb(0, 0).g / radiance.g, 1, kHalfPrecision);
    EXPECT_NEAR(image.rgb(0, 0).b / radiance.b, 1, kHalfPrecision);
  }
}

TEST_F(ToolRender, ExposureBrightensThePicture) {
  double last = 0;
  for (const char* stops : {"-2", "0", "2"}) {
    run({"render", "builtin:sphere", "--light", axes_, "--size", "81x61", "--exposure", stops, "-o", path("a.png")});
    const double mean = mean_byte(load_image8(folder_ / "a.png"));
    EXPECT_GT(mean, last + 20);
    last = mean;
  }
}

TEST_F(ToolRender, ShowsNormalsAndVisibilityAsTheyAre) {
  const auto middle = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"render", "builtin:sphere", "--camera", "0,0", "--size",
                                          "81x61",  "--exposure",     "3",        "-o",  path("a.png")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    run(arguments);
    const Image8 picture = load_image8(folder_ / "a.png");
    const std::size_t at = 4 * (30 * 81 + 40);
    return std::array<int, 3>{picture.values[at], picture.values[at + 1], picture.values[at + 2]};
  };
  const auto normal = middle({"--show", "normals"});
  EXPECT_NEAR(normal[0], 128, 4) << "+Z, toward the camera, whatever the exposure";
  EXPECT_NEAR(normal[1], 128, 4);
  EXPECT_NEAR(normal[2], 255, 1);
  const auto open = middle({"--show", "visibility", "--method", "transfer", "--transfer", "cosine"});
  for (const int channel : open) EXPECT_NEAR(channel, 255, 1) << "a sphere is open everywhere";
}

// Degrees add up, where none of them is cut off at 0.
TEST_F(ToolRender, ShowsOneDegreeAlone) {
  const auto degree = [&](const std::string& l, const std::string& turn) {
    return draw({"--bands", "2", "--no-background", "--show", "degree:" + l, "--rotate-light", turn});
  };
  EXPECT_LT(max_difference(degree("0", "0"), draw({"--bands", "1", "--no-background"})), 2e-3);
  const Image all = draw({"--bands", "2", "--no-background"}), mean = degree("0", "0"), first = degree("1", "0");
  for (std::size_t i = 0; i < all.values.size(); ++i) {
    if (all.values[i] > 0 && first.values[i] > 0) {
      EXPECT_NEAR(mean.values[i] + first.values[i], all.values[i], 5e-3 * 6) << i;
    }
  }
}

TEST_F(ToolRender, LooksAtWhatItIsTold) {
  const Image still = draw({"--camera", "0,0"}), right = draw({"--camera", "0,0", "--look-at", "0.5,0,0"});
  EXPECT_GT(max_difference(still, right), 0.1);
  EXPECT_LT(max_difference(draw({"--camera", "0,0", "--look-at", "0,0,0"}), still), 1e-6);
}

TEST_F(ToolRender, SameInputSameBytes) {
  for (const char* name : {"a.png", "b.png"})
    run({"render", "builtin:knot", "--light", axes_, "--size", "160x120", "-o", path(name)});
  EXPECT_TRUE(text_of(path("a.png")) == text_of(path("b.png")));
  run({"render", "builtin:knot", "--light", axes_, "--size", "160x120", "--frames", "5", "-o", path("b.png")});
  EXPECT_TRUE(text_of(path("a.png")) == text_of(path("b.png"))) << "frames for the time change nothing";
}

TEST_F(ToolRender, AWholeTurnOfTheLightIsNone) {
  const Image none = draw({});
  for (const char* turn : {"360", "-720"})
    EXPECT_LT(max_difference(draw({"--rotate-light", turn}), none), 0.02) << turn;
  EXPECT_GT(max_difference(draw({"--rotate-light", "180"}), none), 1);
}

// A sphere looks the same from all sides, so turning its light and the camera together changes nothing.
TEST_F(ToolRender, LightAndCameraTurnTheSameWay) {
  const Image still = draw({"--camera", "20,15,0.6"});
  const Image turned = draw({"--camera", "110,15,0.6", "--rotate-light", "90"});
  EXPECT_LT(max_difference(turned, still), 0.05 * 6);
  const Image other_way = draw({"--camera", "110,15,0.6", "--rotate-light", "-90"});
  EXPECT_GT(max_difference(other_way, still), 1);
}

TEST_F(ToolRender, WithoutBackgroundOnlyTheModelIsSeen) {
  const Image with = draw({}), without = draw({"--no-background"});
  for (const int corner : {0, 80}) {
    EXPECT_EQ(without.rgb(corner, 0), Rgb());
    EXPECT_GT(luminance(with.rgb(corner, 0)), 0);
  }
  EXPECT_EQ(without.rgb(40, 30), with.rgb(40, 30));
}

// With one band, light comes from everywhere the same; with more, not.
TEST_F(ToolRender, BandsAreTheLightsDetail) {
  const Image one = draw({"--bands", "1"});
  EXPECT_EQ(one.rgb(40, 30), one.rgb(30, 20));
  const Image three = draw({"--bands", "3"}), nine = draw({"--bands", "9"});
  EXPECT_GT(std::abs(three.rgb(40, 30).g - three.rgb(30, 20).g), 0.1);
  EXPECT_GT(max_difference(three, nine), 0.01);
}

// A light's coefficients light as the light itself does, and stand behind the model blurred.
TEST_F(ToolRender, CoefficientsLightAsTheirLightDoes) {
  run({"project", axes_, "--bands", "3", "-o", path("a.json")});
  const Image from_file = draw({"--light", path("a.json"), "--no-background"});
  const Image from_light = draw({"--no-background"});
  EXPECT_LT(max_difference(from_file, from_light), 6 * kHalfPrecision);
  EXPECT_GT(luminance(draw({"--light", path("a.json")}).rgb(0, 0)), 0);
}

// Without shadows, transfer lights a sphere as the irradiance of its normals does, with any light and number of bands.
TEST_F(ToolRender, CosineTransferLooksLikeIrradiance) {
  const double brightest = 6;
  for (const char* bands : {"1", "3", "10"}) {
    const std::vector<std::string> view = {"--bands", bands, "--rotate-light", "40"};
    std::vector<std::string> transfer = view;
    transfer.insert(transfer.end(), {"--method", "transfer", "--transfer", "cosine"});
    const Image a = draw(transfer), b = draw(view);
    double sum = 0;
    for (std::size_t i = 0; i < a.values.size(); ++i) sum += std::abs(a.values[i] - b.values[i]);
    EXPECT_LT(sum / static_cast<double>(a.values.size()), 1e-3 * brightest) << bands;
    EXPECT_NEAR(luminance(a.rgb(40, 30)), luminance(b.rgb(40, 30)), 5e-3 * brightest) << bands;
  }
  const auto json =
      run_json({"render", "builtin:sphere", "--size", "40x30", "--method", "transfer", "--transfer", "cosine"});
  EXPECT_GT(json["frame_ms"].get<double>(), 0);
  EXPECT_EQ(json["method"], "transfer");
  EXPECT_EQ(json["transfer"], "cosine");
  EXPECT_EQ(json["vertices"], run_json({"info", "builtin:sphere"})["vertices"]);
  EXPECT_EQ(json["rays"], 0);
  EXPECT_GE(json["bake_seconds"].get<double>(), 0);
}

// A baked file is drawn as what was baked into it, which takes no bake: as the same transfer freshly baked where it
// was stored whole, and near it where it was compressed.
TEST_F(ToolRender, BakedFilesAreDrawnAsTheyAre) {
  const std::string glb = path("a.glb");
  const std::vector<std::string> view = {"--light", axes_, "--size", "80x60", "-o", path("a.exr")};
  const auto picture = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "render");
    arguments.insert(arguments.end(), view.begin(), view.end());
    const ToolRun drawn = run(arguments);
    return std::pair{load_image(path("a.exr")).image, drawn.err};
  };
  const Image fresh = picture({"builtin:knot", "--method", "transfer", "--transfer", "cosine", "--bands", "4"}).first;
  for (const auto& [compression, said, error] : {std::tuple{"", "32 bits", 0.0},
                                                 {"16", "16 bits", 2e-3},
                                                 {"8", "8 bits", 5e-2},
                                                 {"pca:16x15", "16 clusters of 15 components", 2e-3}}) {
    std::vector<std::string> bake = {"bake", "builtin:knot", "-o", glb, "--transfer", "cosine", "--bands", "4"};
    if (*compression) bake.insert(bake.end(), {"--compress", compression});
    run(bake);
    const auto [image, err] = picture({glb, "--method", "transfer"});
    EXPECT_NE(err.find("cosine transfer of"), std::string::npos) << err;
    EXPECT_NE(err.find(said), std::string::npos) << err;
    EXPECT_LE(max_difference(image, fresh), error * 6) << compression;
  }
  const Image two = picture({"builtin:knot", "--method", "transfer", "--transfer", "cosine", "--bands", "2"}).first;
  EXPECT_LT(max_difference(picture({glb, "--method", "transfer", "--bands", "2"}).first, two), 6 * 1e-2);

  const auto refuse = [&](const std::vector<std::string>& options, const std::string& wrong) {
    std::vector<std::string> arguments = {"render", glb, "--method", "transfer"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    expect_refused(arguments, glb, wrong);
  };
  refuse({"--bands", "5"}, "holds 4 bands and not 5: --bands 1 to 4");
  refuse({"--transfer", "shadowed"}, "holds cosine transfer, not shadowed");
  refuse({"--transfer", "interreflected", "--bounces", "5"}, "holds cosine transfer, not interreflected");
  refuse({"--samples", "64", "--transfer", "shadowed"}, "holds cosine transfer");
  refuse({"--samples", "64"}, "is baked already: --samples cannot change it");
}

// What is baked shadows glossy things, too; cosine transfer shadows nothing.
TEST_F(ToolRender, BakesShadowReflectance) {
  const auto picture = [&](const std::string& model, std::vector<std::string> more) {
    std::vector<std::string> arguments = {
        "render", model,   "--material", "ggx:alpha=0.4,f0=0.9", "--bands",        "3", "--light", axes_,
        "--size", "80x60", "-o",         path("a.exr"),          "--no-background"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    run(arguments);
    return load_image(path("a.exr")).image;
  };
  const std::string glb = path("a.glb");
  run({"bake", "builtin:knot", "-o", glb, "--transfer", "shadowed", "--bands", "3", "--samples", "64"});
  const Image open = picture("builtin:knot", {}), shadowed = picture(glb, {});
  EXPECT_LT(max_difference(picture("builtin:knot", {"--transfer", "cosine"}), open), 1e-3);
  EXPECT_EQ(picture("builtin:knot", {"--transfer", "shadowed", "--samples", "64"}).values, shadowed.values);
  EXPECT_LT(max_difference(picture(glb, {"--transfer", "cosine"}), open), 1e-3) << "without what was baked";
  double open_sum = 0, shadowed_sum = 0;
  for (const float v : open.values) open_sum += double{v};
  for (const float v : shadowed.values) shadowed_sum += double{v};
  EXPECT_LT(shadowed_sum, 0.95 * open_sum);
  EXPECT_GT(shadowed_sum, 0.3 * open_sum);
}

TEST_F(ToolRender, BenchTimesEveryMethod) {
  const auto bench = run_json({"bench", "render", "builtin:sphere", "--light", axes_, "--bands", "2", "--size", "32x24",
                               "--frames", "1", "--rounds", "1"});
  EXPECT_EQ(bench["width"], 32);
  EXPECT_EQ(bench["methods"].size(), 9u);
  EXPECT_EQ(bench["methods"][0]["ratio"], 1.0);
  for (const auto& method : bench["methods"]) EXPECT_GT(method["frame_ms"].get<double>(), 0) << method;
}

// Not after the hours that this would take to bake.
TEST_F(ToolRender, WhatCannotBeWrittenIsToldBeforeBaking) {
  const std::string output = path("missing/a.png");
  expect_refused(
      {"render", "builtin:scene", "--method", "transfer", "--samples", "65536", "--bands", "10", "-o", output}, output,
      "cannot be written (");
}

TEST_F(ToolRender, QuietSaysNothing) {
  EXPECT_EQ(run({"--quiet", "render", "builtin:sphere", "--light", axes_, "--size", "8x8", "-o", path("a.png")}).err,
            "");
}

class ToolDemo : public ToolDrawingTest {};

TEST_F(ToolDemo, MakesPicturesAndCoefficients) {
  const std::string folder = path("new/folder");
  const auto json = run_json({"demo", "-o", folder});
  std::size_t pictures = 0;
  for (const auto& file : json["files"]) {
    const std::filesystem::path name = file.get<std::string>();
    EXPECT_EQ(name.parent_path(), folder);
    if (name.extension() == ".png") {
      const Image8 picture = load_image8(name);
      EXPECT_GT(mean_byte(picture), 10) << name;
      ++pictures;
    } else {
      EXPECT_EQ(run_json({"info", name.string()})["kind"], "coefficients");
    }
  }
  EXPECT_GE(pictures, 4u);
  // What it names is there and nothing else: the two folders and the files.
  EXPECT_EQ(contents().size(), 2 + json["files"].size());
}

}  // namespace
}  // namespace shlight
