// shlight view, in a window that nobody sees, driven by scripts

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <memory>
#include <sstream>

#include "shlight/light/builtin_light.h"
#include "shlight/light/coefficient_file.h"
#include "tool_test_util.h"
#include "virtual_display.h"

namespace shlight {
namespace {

class ToolView : public ToolTest {
 protected:
  static void SetUpTestSuite() { display_ = std::make_unique<VirtualDisplay>(1280, 800); }
  static void TearDownTestSuite() { display_.reset(); }
  void SetUp() override {
    if (!display_->problem().empty()) GTEST_SKIP() << display_->problem();
  }

  // Runs a script in a small window that shows a small model.
  ToolRun view(const std::string& script, std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments = {"view",  "builtin:sphere",    "--size",   "620x300",
                                          "--set", "method=irradiance", "--script", write("script", script)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_tool(arguments);
  }
  void view_well(const std::string& script, const std::vector<std::string>& more = {}) const {
    const ToolRun done = view(script, more);
    EXPECT_EQ(done.exit_code, 0) << script << done;
  }
  nlohmann::json report(const std::string& name) const { return nlohmann::json::parse(text_of(path(name))); }

  // Draws what the line that was copied says.
  Image8 draw_command(const std::string& file) const {
    std::istringstream stream(text_of(path(file)));
    std::vector<std::string> words;
    for (std::string word; stream >> word;) {
      if (word.size() > 1 && word.front() == '\'' && word.back() == '\'') word = word.substr(1, word.size() - 2);
      words.push_back(word == "picture.png" ? path("command.png") : word);
    }
    EXPECT_EQ(words.at(0), "shlight");
    words.erase(words.begin());
    run(words);
    return load_image8(path("command.png"));
  }

 private:
  static std::unique_ptr<VirtualDisplay> display_;
};
std::unique_ptr<VirtualDisplay> ToolView::display_;

// The largest difference of a channel, of 255.
int largest_difference(const Image8& a, const Image8& b) {
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.height, b.height);
  if (a.values.size() != b.values.size()) return 256;
  int largest = 0;
  for (std::size_t i = 0; i < a.values.size(); ++i) largest = std::max(largest, std::abs(a.values[i] - b.values[i]));
  return largest;
}

// Different colours, coarsely: a black window has one, a picture many.
std::size_t num_colors(const Image8& picture) {
  std::map<std::array<int, 3>, int> colors;
  for (std::size_t i = 0; i < picture.values.size(); i += 4)
    ++colors[{picture.values[i] / 8, picture.values[i + 1] / 8, picture.values[i + 2] / 8}];
  return colors.size();
}

TEST_F(ToolView, TakesAPictureOfItsWindowWithoutHands) {
  const ToolRun done = run({"view", "builtin:sphere", "--set", "method=irradiance", "--size", "700x400", "--screenshot",
                            path("window.png")});
  EXPECT_EQ(done.out, "");
  const Image8 window = load_image8(path("window.png"));
  EXPECT_EQ(window.width, 700);
  EXPECT_EQ(window.height, 400);
  EXPECT_GT(num_colors(window), 100u);
}

TEST_F(ToolView, ItsCommandDrawsTheSamePicture) {
  save_image(path("light.exr"), make_studio_light()->lat_long(64));
  const std::map<std::string, std::string> scripts = {
      {"turned and moved",
       "drag left 60 40 100 80\ndrag right 70 40 120 90\ndrag middle 80 80 95 70\nwheel -2\nset bands 4\n"
       "set window auto\nset exposure 0.7\n"},
      {"transfer", "set method transfer\nset transfer cosine\nset bands 3\n"},
      {"reflectance",
       "set method reflectance\nset bands 4\nset material ggx:alpha=0.3,f0=0.9/0.6/0.2\nset tone-map none\n"},
      {"hybrid", "set method hybrid\nset bands 3\nset material cook-torrance:m=0.3,f0=0.9\nset rotate-light 40\n"},
      {"one degree", "set bands 3\nset show degree:1\nset mark-negative on\nset background off\n"},
      {"normals", "set show normals\nset camera 120,-20,0.8\n"},
      {"visibility", "set method transfer\nset transfer cosine\nset show visibility\n"},
  };
  std::string script = "resize 240 180\nframes 3\n";
  for (const auto& [name, settings] : scripts)
    script += settings + "wait\npicture " + path(name + ".png") + "\ncommand " + path(name) + "\nreset\n";
  view_well(script, {"--light", path("light.exr")});
  for (const auto& [name, settings] : scripts) {
    const Image8 shown = load_image8(path(name + ".png"));
    EXPECT_EQ(shown.width, 240) << name;
    EXPECT_GT(num_colors(shown), 3u) << name;
    EXPECT_LE(largest_difference(shown, draw_command(name)), 2) << name << ": " << text_of(path(name));
  }
}

TEST_F(ToolView, ABrokenFileLeavesTheOldScene) {
  const std::string broken = write("broken.obj", "f 1 2 3\n"), bad_light = write("broken.hdr", "#?RADIANCE\n\nno\n");
  view_well("wait\npicture " + path("before.png") + "\nopen " + broken + "\nframes 3\nwait\nreport " + path("model") +
            "\nopen " + bad_light + "\nframes 3\nwait\nreport " + path("light") + "\npicture " + path("after.png") +
            "\n");
  EXPECT_NE(report("model")["last_error"].get<std::string>().find("broken.obj"), std::string::npos);
  EXPECT_EQ(report("model")["model"], "builtin:sphere");
  EXPECT_NE(report("light")["last_error"].get<std::string>().find("broken.hdr"), std::string::npos);
  EXPECT_EQ(report("light")["light"], "builtin:sky");
  EXPECT_EQ(largest_difference(load_image8(path("before.png")), load_image8(path("after.png"))), 0);
}

TEST_F(ToolView, OpensWhatIsDroppedAsWhatItIs) {
  run({"bake", "builtin:sphere", "--transfer", "cosine", "--bands", "3", "-o", path("baked.glb")});
  RgbCoefficients green(1);
  green[0] = {0, 3, 0};
  save_coefficients(path("green.json"), green);
  view_well("open " + path("baked.glb") + "\nopen " + path("green.json") + "\nframes 3\nwait\nreport " +
            path("report") + "\npicture " + path("shown.png") + "\ncommand " + path("line") + "\n");
  EXPECT_EQ(report("report")["method"], "transfer") << "a baked file is drawn as it was baked";
  EXPECT_LE(largest_difference(load_image8(path("shown.png")), draw_command("line")), 2);
}

TEST_F(ToolView, ABakedModelHasItsShadowsByAnyMethod) {
  run({"bake", "builtin:knot", "--transfer", "shadowed", "--samples", "64", "--bands", "3", "-o", path("baked.glb")});
  save_image(path("light.exr"), make_studio_light()->lat_long(64));
  const std::string look = "\nset material ggx:alpha=0.3,f0=0.9\nset bands 3\n";
  view_well("open " + path("baked.glb") + "\nframes 3\nwait\nresize 240 180\nset method hybrid" + look +
                "wait\npicture " + path("still.png") + "\nset rotate-light 70\nframes 3\nwait\npicture " +
                path("a.png") + "\ncommand " + path("a") + "\nset side b\nset method reflectance" + look +
                "set transfer cosine\nwait\npicture " + path("b.png") + "\ncommand " + path("b") +
                "\nset transfer shadowed\nset compare split\nset divider 0\nwait\npicture " + path("split.png") +
                "\ncommand " + path("split") + "\n",
            {"--light", path("light.exr")});
  for (const std::string name : {"a", "b", "split"})
    EXPECT_LE(largest_difference(load_image8(path(name + ".png")), draw_command(name)), 2) << text_of(path(name));
  EXPECT_EQ(text_of(path("a")).find("--transfer"), std::string::npos);
  EXPECT_NE(text_of(path("b")).find("--transfer cosine"), std::string::npos);
  EXPECT_GT(largest_difference(load_image8(path("b.png")), load_image8(path("split.png"))), 20) << "the shadows";
  EXPECT_GT(largest_difference(load_image8(path("a.png")), load_image8(path("still.png"))), 20) << "the light turned";
}

TEST_F(ToolView, ABakeGetsBetterAndCanBeStopped) {
  view_well(
      "set method transfer\nset transfer shadowed\nset samples 8192\nset bands 3\n"
      "frames 20\ncancel\nwait\nreport " +
      path("stopped") + "\npicture " + path("stopped.png") + "\n");
  EXPECT_EQ(report("stopped")["activity"], "");
  EXPECT_EQ(report("stopped")["last_error"], "") << "being stopped is no error";
  EXPECT_GT(num_colors(load_image8(path("stopped.png"))), 20u);
}

TEST_F(ToolView, TheReferenceConvergesBesideTheMethodAndIsCompared) {
  view_well(
      "set compare difference\nset side b\nset method reference\nset transfer cosine\nset side a\nset bands 3\n"
      "resize 400 200\nframes 3\nset controls off\nwait 64\nreport " +
      path("a") + "\npicture " + path("difference.png") + "\nset side b\nreport " + path("b") +
      "\nset compare split\nwait 64\npicture " + path("split.png") + "\nset side a\nset compare one\nwait\npicture " +
      path("a.png") + "\n");
  EXPECT_GE(report("b")["paths"].get<int>(), 64);
  EXPECT_GT(num_colors(load_image8(path("difference.png"))), 10u);
  // The left half of the split picture is A, and the right one, B, is about the same: B is what A approximates.
  const Image8 split = load_image8(path("split.png")), a = load_image8(path("a.png"));
  ASSERT_EQ(split.width, a.width);
  double right = 0;
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x)
      for (int c = 0; c < 3; ++c) {
        const auto i = static_cast<std::size_t>(4 * (y * a.width + x) + c);
        if (x < a.width / 2) {
          ASSERT_EQ(split.values[i], a.values[i]) << x << " " << y;
        } else {
          right += std::abs(split.values[i] - a.values[i]);
        }
      }
  EXPECT_GT(right, 0) << "noise";
  EXPECT_LT(right / (1.5 * a.width * a.height), 6) << "of 255, on average";
}

TEST_F(ToolView, IsDrawnInWindowsOfAnySize) {
  view_well(
      "resize 1 1\nframes 4\nresize 60 900\nframes 4\nresize 620 300\nframes 4\nset insight on\nset timing on\n"
      "set keys on\nframes 3\nresize 1270 790\nframes 3\nwait\nscreenshot " +
      path("window.png") + "\n");
  const Image8 window = load_image8(path("window.png"));
  EXPECT_EQ(window.width, 1270);
  EXPECT_EQ(window.height, 790);
}

TEST_F(ToolView, AWaitEndsWhereWhatWorksIsHidden) {
  view_well("resize 1200 700\nwait\nset insight on\nframes 2\nset insight off\nwait\n");
}

TEST_F(ToolView, ATinyWindowAndOneOfNothingComeBack) {
  view_well("wait\npicture " + path("before.png") + "\nresize 60 40\nframes 4\nwait\nscreenshot " + path("tiny.png") +
            "\nresize 1 1\nframes 4\nreport " + path("nothing") + "\nresize 620 300\nframes 4\nwait\npicture " +
            path("after.png") + "\n");
  const Image8 tiny = load_image8(path("tiny.png"));
  EXPECT_EQ(tiny.width, 60);
  EXPECT_EQ(tiny.height, 40);
  EXPECT_GT(num_colors(tiny), 5u) << "the picture has what there is";
  EXPECT_EQ(report("nothing")["last_error"], "");
  EXPECT_EQ(largest_difference(load_image8(path("before.png")), load_image8(path("after.png"))), 0);
}

TEST_F(ToolView, FillsAScreenOfFourThousandPixels) {
  const VirtualDisplay large(3840, 2160);
  ASSERT_EQ(large.problem(), "");
  save_image(path("light.exr"), make_studio_light()->lat_long(64));
  view_well("set controls off\nresize 3840 2160\nframes 1\nwait\npicture " + path("large.png") + "\nreport " +
                path("report") + "\n",
            {"--light", path("light.exr")});
  const Image8 picture = load_image8(path("large.png"));
  EXPECT_EQ(picture.width, 3840);
  EXPECT_EQ(picture.height, 2160);
  EXPECT_GT(num_colors(picture), 50u);
  EXPECT_EQ(report("report")["last_error"], "");
}

TEST_F(ToolView, ControlsOfTwiceTheSizeFitTheirWindow) {
  view_well("resize 1240 780\nframes 3\nwait\nreport " + path("report") + "\nscreenshot " + path("large.png") + "\n",
            {"--scale", "2"});
  EXPECT_EQ(report("report")["scale"], 2);
  EXPECT_EQ(report("report")["width"], 1240 - 600) << "panels are twice as wide";
  EXPECT_GT(num_colors(load_image8(path("large.png"))), 100u);
}

TEST_F(ToolView, ADragEndsWhereTheWindowLosesTheFocus) {
  view_well("wait\ncommand " + path("before") + "\ndrag left 400 100 500 150 unfocus\nframes 3\ncommand " +
            path("unfocused") + "\ndrag left 400 100 500 150\nframes 3\ncommand " + path("dragged") + "\n");
  EXPECT_EQ(text_of(path("unfocused")), text_of(path("before")));
  EXPECT_NE(text_of(path("dragged")), text_of(path("before")));
}

TEST_F(ToolView, KeysAndResetDoWhatTheyState) {
  view_well("wait\npicture " + path("before.png") + "\npress M\npress 7\npress S\nframes 3\nreport " + path("keys") +
            "\ndrag left 400 100 500 150\nreset\nframes 3\nwait\nreport " + path("reset") + "\npicture " +
            path("after.png") + "\n");
  EXPECT_EQ(report("keys")["method"], "transfer");
  EXPECT_EQ(report("reset")["method"], "irradiance");
  EXPECT_EQ(largest_difference(load_image8(path("before.png")), load_image8(path("after.png"))), 0);
}

TEST_F(ToolView, ExportsTheLightAsItIsDrawn) {
  view_well("set bands 4\nset window hann:5\nwait\nexport " + path("light.json") + "\n");
  const RgbCoefficients exported = load_coefficients(path("light.json"));
  run({"project", "builtin:sky", "--bands", "4", "--window", "hann:5", "-o", path("projected.json")});
  const RgbCoefficients projected = load_coefficients(path("projected.json"));
  ASSERT_EQ(exported.bands(), 4);
  for (std::size_t i = 0; i < exported.size(); ++i) EXPECT_NEAR(exported[i].g, projected[i].g, 1e-6 * projected[0].g);
}

TEST_F(ToolView, RefusesWhatItCannotDo) {
  expect_refused({"view", "builtin:sphere", "--script", write("bad", "wait\njump 3\n")}, path("bad") + ":2",
                 "'jump' is no command");
  expect_refused({"view", "builtin:sphere", "--script", write("bad2", "set bands eleven\n")}, path("bad2") + ":1",
                 "'eleven'");
  expect_refused({"view", "builtin:sphere", "--script", write("bad3", "resize 0 0\n")}, path("bad3") + ":1",
                 "'0': is no side of a window");
  expect_refused({"view", "nowhere.obj", "--screenshot", path("a.png")}, "nowhere.obj", "");
}

TEST(ToolViewAlone, WithoutADisplayItSuggestsRender) {
  ::unsetenv("DISPLAY");
  ::unsetenv("WAYLAND_DISPLAY");
  const ToolRun run = run_tool({"view"});
  EXPECT_EQ(run.exit_code, 1) << run;
  EXPECT_TRUE(run.err.starts_with("shlight view: window: cannot be opened")) << run;
  EXPECT_NE(run.err.find("shlight render"), std::string::npos) << run;
}

}  // namespace
}  // namespace shlight
