// Every layout written by convert-map and read back by the other commands; cubes that are incomplete.

#include <gtest/gtest.h>

#include "shlight/image/cube_files.h"
#include "shlight/light/builtin_light.h"
#include "shlight/light/coefficient_file.h"
#include "tool_test_util.h"

namespace shlight {
namespace {

class ToolConvertMap : public ToolTest {
 protected:
  void SetUp() override {
    ToolTest::SetUp();
    run({"convert-map", "builtin:axes", "-o", path("source.exr"), "--size", "512"});
  }

  RgbCoefficients project(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "project");
    for (const std::string& more : {std::string("--bands"), std::string("5"), std::string("-o"), path("c.json")})
      arguments.push_back(more);
    run(arguments);
    return load_coefficients(path("c.json"));
  }
};

TEST_F(ToolConvertMap, EveryLayoutIsTheSameLight) {
  const RgbCoefficients expected = make_axes_light()->project(5);
  for (const Layout layout : all_layouts()) {
    const std::string name(layout_name(layout));
    // OpenEXR's own two say what they are in a header that .hdr has not.
    const std::string file = path(name + (centres_on_border(layout) ? ".exr" : ".hdr"));
    run({"convert-map", path("source.exr"), "-o", file, "--layout", name});
    // Recognised without being named: by the header, the names of the files, the word in the name, the shape.
    const std::string light = layout == Layout::kCube ? path("cube_ny.hdr") : file;
    const RgbCoefficients c = project({light});
    for (std::size_t i = 0; i < c.size(); ++i)
      EXPECT_NEAR(luminance(c[i]), luminance(expected[i]), 2e-3 * luminance(expected[0])) << name << " " << i;
    EXPECT_EQ(run_json({"info", light})["layout"], name);
  }
}

TEST_F(ToolConvertMap, SaysWhatItWrote) {
  const auto json =
      run_json({"convert-map", path("source.exr"), "-o", path("a.hdr"), "--layout", "vertical-cross", "--size", "16"});
  EXPECT_EQ(json["layout"], "vertical-cross");
  EXPECT_EQ(json["width"], 48);
  EXPECT_EQ(json["height"], 64);
  EXPECT_EQ(json["files"], std::vector<std::string>{path("a.hdr")});
  // The size follows the source's where it is not given: as many pixels round the horizon.
  EXPECT_EQ(run_json({"convert-map", path("a.hdr"), "-o", path("b.hdr")})["width"], 64);
  EXPECT_EQ(run_json({"convert-map", path("a.hdr"), "-o", path("b.hdr"), "--layout", "cube"})["files"].size(), 6u);
  EXPECT_EQ(run_json({"convert-map", path("a.hdr"), "--from", "lat-long", "-o", path("b.hdr")})["width"], 48);
}

TEST_F(ToolConvertMap, IncompleteAndCrookedMapsAreRefused) {
  run({"convert-map", "builtin:axes", "-o", path("sky.exr"), "--layout", "cube", "--size", "8"});
  run({"convert-map", "builtin:axes", "-o", path("big.exr"), "--layout", "cube", "--size", "16"});
  std::filesystem::rename(path("big_py.exr"), path("sky_py.exr"));
  expect_refused({"project", path("sky_px.exr")}, path("sky_py.exr"), "16 x 16 pixels");
  for (const char* name : {"sky_py.exr", "sky_ny.exr", "sky_nz.exr"}) std::filesystem::remove(path(name));
  expect_refused({"project", path("sky_px.exr")}, path("sky_px.exr"), "without sky_py.exr, sky_ny.exr, sky_nz.exr");
  expect_refused({"project", path("source.exr"), "--layout", "vertical-cross"}, path("source.exr"),
                 "512 x 256 pixels are no vertical-cross");
  run({"convert-map", "builtin:axes", "-o", path("square.exr"), "--layout", "octahedral", "--size", "8"});
  expect_refused({"render", "builtin:sphere", "--light", path("square.exr"), "-o", path("a.png")}, path("square.exr"),
                 "may be of several layouts");
  expect_refused({"convert-map", "builtin:axes", "-o", path("a.exr"), "--size", "4096", "--max-pixels", "1000"},
                 "--size 4096", "is too large");
}

}  // namespace
}  // namespace shlight
