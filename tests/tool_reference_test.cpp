// render --method reference: what it writes and says, that it is what the other methods approximate, what is refused.

#include <gtest/gtest.h>

#include "tool_test_util.h"

namespace shlight {
namespace {

class ToolReference : public ToolTest {
 protected:
  nlohmann::json reference(std::vector<std::string> more) const {
    std::vector<std::string> arguments = {"render", "builtin:sphere", "--method", "reference", "--size", "60x40"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_json(arguments);
  }
};

TEST_F(ToolReference, WritesPicturesAndSaysWhatTheyTook) {
  const auto json = reference({"--transfer", "shadowed", "--samples", "20", "-o", path("a.exr"), "--deviation",
                               path("d.exr"), "--light", "fn:1"});
  EXPECT_EQ(json["method"], "reference");
  EXPECT_EQ(json["transfer"], "shadowed");
  EXPECT_EQ(json["samples"], 32) << "rounded up to a multiple of 16";
  EXPECT_GT(json["rays"], 60 * 40 * 32);
  EXPECT_GT(json["frame_ms"], 0);
  const Image picture = load_image(path("a.exr")).image, deviation = load_image(path("d.exr")).image;
  EXPECT_EQ(picture.rgb(0, 0), (Rgb{1, 1, 1})) << "the light behind the model";
  EXPECT_EQ(deviation.rgb(0, 0), Rgb{});
  EXPECT_NEAR(picture.rgb(30, 20).g, 0.8, 0.1) << "a grey sphere in uniform light";
  EXPECT_GT(deviation.rgb(30, 20).g, 0);
  EXPECT_NEAR(picture.rgb(30, 20).g, 0.8, 5 * deviation.rgb(30, 20).g + 1e-3);
}

TEST_F(ToolReference, ExposesAsTheOthersDo) {
  reference({"--samples", "16", "-o", path("a.png"), "--light", "fn:7"});
  // A uniform light is shown a stop above middle grey, through the tone mapper.
  const Image8 picture = load_image8(path("a.png"));
  EXPECT_GT(picture.values[0], 145);
  EXPECT_LT(picture.values[0], 180);
  reference({"--samples", "16", "-o", path("b.png"), "--light", "fn:7", "--exposure", "-30"});
  EXPECT_EQ(load_image8(path("b.png")).values[0], 0);
}

TEST_F(ToolReference, TakesABlackLight) {
  const auto json = reference({"--samples", "16", "-o", path("a.exr"), "--light", "fn:0"});
  EXPECT_EQ(json["noise"], 0);
  EXPECT_EQ(load_image(path("a.exr")).image.values, Image(60, 40).values);
}

TEST_F(ToolReference, OptionsWithoutMeaningAreWrongUsage) {
  for (const std::vector<std::string>& more : {std::vector<std::string>{"--bands", "3"},
                                               {"--frames", "2"},
                                               {"--mark-negative"},
                                               {"--window", "hann"},
                                               {"--transfer", "shadowed", "--bounces", "2"},
                                               {"--deviation", "d.png"}}) {
    std::vector<std::string> arguments = {"render", "--method", "reference", "-o", path("a.png")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ToolRun wrong = run_tool(arguments);
    EXPECT_EQ(wrong.exit_code, 2) << wrong;
    EXPECT_NE(wrong.err.find(more[more.size() > 2 ? 2 : 0]), std::string::npos) << wrong;
  }
  EXPECT_EQ(run_tool({"render", "--deviation", path("d.exr"), "-o", path("a.png")}).exit_code, 2);
}

TEST_F(ToolReference, RefusesWhatCannotBeWrittenBeforeItTraces) {
  expect_refused({"render", "--method", "reference", "--samples", "65536", "-o", path("none/a.png")},
                 path("none/a.png"), "");
}

class ToolReferenceDrawing : public ToolDrawingTest {};

// Nothing is approximated where the light has as many bands as are drawn: what is left is noise and how edges are
// averaged over a pixel, of which the graphics card takes four samples.
TEST_F(ToolReferenceDrawing, IsWhatIrradianceApproximates) {
  run({"project", "builtin:sky", "--bands", "3", "-o", path("sky.json")});
  const std::vector<std::string> same = {"--light",  path("sky.json"), "--size",         "96x64", "--no-background",
                                         "--camera", "30,20",          "--rotate-light", "50"};
  std::vector<std::string> irradiance = {"render", "builtin:knot", "-o", path("i.exr")};
  std::vector<std::string> traced = {"render",    "builtin:knot", "-o",     path("r.exr"), "--method",
                                     "reference", "--transfer",   "cosine", "--samples",   "256"};
  irradiance.insert(irradiance.end(), same.begin(), same.end());
  traced.insert(traced.end(), same.begin(), same.end());
  run(irradiance);
  run(traced);
  run({"compare", path("i.exr"), path("r.exr"), "--max-relative", "0.06", "--min-ssim", "0.98", "--max-flip", "0.04"});
}

}  // namespace
}  // namespace shlight
