// Pictures compared: what is printed, the heat map, thresholds as other people's builds use them, what is refused.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "shlight/truth/heat_map.h"
#include "tool_test_util.h"

namespace shlight {
namespace {

class ToolCompare : public ToolTest {
 protected:
  std::string picture(const std::string& name, unsigned char grey, int width = 24, int height = 16) const {
    Image8 image{width, height, {}};
    image.values.resize(static_cast<std::size_t>(4 * width * height), grey);
    for (std::size_t i = 3; i < image.values.size(); i += 4) image.values[i] = 255;
    save_image8(path(name), image);
    return path(name);
  }
  std::string radiance(const std::string& name, double value, double of_one_pixel) const {
    Image image(24, 16);
    for (float& v : image.values) v = static_cast<float>(value);
    image.set_rgb(7, 3, {of_one_pixel, of_one_pixel, of_one_pixel});
    save_image(path(name), image);
    return path(name);
  }
};

TEST_F(ToolCompare, MeasuresWhatIsShown) {
  const auto json = run_json({"compare", picture("a.png", 138), picture("b.png", 128)});
  EXPECT_NEAR(json["rmse"], 10 / 255.0, 1e-6);
  EXPECT_NEAR(json["psnr"], 20 * std::log10(25.5), 1e-3);
  EXPECT_NEAR(json["max_error"], 10 / 255.0, 1e-6);
  EXPECT_LT(json["ssim"], 1);
  EXPECT_GT(json["flip"], 0.01);
  EXPECT_EQ(json["values"], "shown");
  EXPECT_EQ(json["worst"].size(), 2u) << "of a picture 24 wide, two columns are 16 apart";
}

TEST_F(ToolCompare, MeasuresRadiance) {
  const auto json = run_json({"compare", radiance("a.exr", 1, 3), radiance("b.exr", 1, 1)});
  EXPECT_NEAR(json["rmse"], 2 / std::sqrt(24 * 16), 1e-6);
  EXPECT_EQ(json["max_error"], 2);
  EXPECT_EQ(json["values"], "radiance");
  EXPECT_EQ(json["worst"][0]["x"], 7);
  EXPECT_EQ(json["worst"][0]["y"], 3);
  const ToolRun words = run({"compare", path("a.exr"), path("b.exr")});
  EXPECT_NE(words.out.find("7,    3  off by 2"), std::string::npos) << words;
}

TEST_F(ToolCompare, EqualPicturesHaveAnInfiniteRatio) {
  const auto json = run_json({"compare", picture("a.png", 138), path("a.png"), "--max-flip", "0", "--min-psnr", "99"});
  EXPECT_TRUE(json["psnr"].is_null());
  EXPECT_EQ(json["flip"], 0);
  EXPECT_EQ(json["worst"].size(), 0u);
}

TEST_F(ToolCompare, ThresholdsDecideTheExitStatus) {
  const std::string a = picture("a.png", 138), b = picture("b.png", 128);
  run({"compare", a, b, "--max-rmse", "0.05", "--min-psnr", "28", "--min-ssim", "0.9", "--max-flip", "0.5",
       "--max-error", "0.05", "--max-relative", "0.1"});
  for (const auto& [option, value, what] : {std::tuple{"--max-rmse", "0.03", "RMSE"},
                                            {"--max-relative", "0.05", "relative error"},
                                            {"--min-psnr", "29", "PSNR"},
                                            {"--min-ssim", "0.99999", "SSIM"},
                                            {"--max-flip", "0.001", "FLIP"},
                                            {"--max-error", "0.03", "largest error"}}) {
    const ToolRun failed = run_tool({"compare", a, b, option, value});
    EXPECT_EQ(failed.exit_code, 1) << option << failed;
    EXPECT_NE(failed.out, "") << "what was measured is told all the same";
    EXPECT_TRUE(failed.err.starts_with("shlight compare: " + a + ": " + what)) << failed;
  }
}

TEST_F(ToolCompare, DrawsAHeatMap) {
  for (const char* show : {"flip", "difference"}) {
    run({"compare", picture("a.png", 138), picture("b.png", 128), "-o", path("d.png"), "--show", show});
    const Image8 map = load_image8(path("d.png"));
    EXPECT_EQ(map.width, 24 + kScaleWidth);
    EXPECT_EQ(map.height, kScaleHeight);
  }
}

TEST_F(ToolCompare, RefusesWhatCannotBeCompared) {
  const std::string a = picture("a.png", 138), small = picture("small.png", 138, 8, 8);
  expect_refused({"compare", a, small, "-o", path("d.png")}, a, "24 x 16 pixels, but " + small + " has 8 x 8");
  expect_refused({"compare", a, radiance("r.exr", 1, 1)}, a, "holds radiance");
  expect_refused({"compare", a, path("none.png")}, path("none.png"), "");
  const std::string bad = radiance("bad.exr", 1, std::numeric_limits<double>::quiet_NaN());
  expect_refused({"compare", path("r.exr"), bad}, bad,
                 "1 pixels with NaN and 0 with infinite values, the first at 7, 3");
  const ToolRun repaired = run({"compare", path("r.exr"), bad, "--repair", "--json"});
  EXPECT_NE(repaired.err.find("bad.exr: 1 pixel"), std::string::npos) << repaired;
  EXPECT_EQ(nlohmann::json::parse(repaired.out)["max_error"], 1);
  EXPECT_EQ(run_tool({"compare", a, a, "-o", path("d.exr")}).exit_code, 2);
  EXPECT_EQ(run_tool({"compare", a}).exit_code, 2);
}

}  // namespace
}  // namespace shlight
