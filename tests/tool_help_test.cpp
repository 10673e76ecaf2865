// Help, version and wrong usage.

#include <gtest/gtest.h>

#include "tool_test_util.h"

namespace shlight {
namespace {

class ToolHelp : public ToolTest {};

TEST_F(ToolHelp, EveryCommandHasAnExample) {
  const ToolRun program = run({"--help"});
  EXPECT_EQ(program.err, "");
  for (const std::string command : {"project", "project-brdf", "render", "bake", "info", "demo", "convert-map",
                                    "compare", "bands", "bench", "reproduce", "view"}) {
    EXPECT_NE(program.out.find("\n  " + command + " "), std::string::npos) << program;
    const ToolRun help = run({command, "--help"});
    EXPECT_EQ(help.err, "");
    EXPECT_NE(help.out.find("Usage: shlight " + command), std::string::npos) << help;
    EXPECT_NE(help.out.find("\n  shlight " + command + " "), std::string::npos) << "an example\n" << help;
  }
}

TEST_F(ToolHelp, SaysItsVersion) {
  const ToolRun version = run({"--version"});
  EXPECT_EQ(version.out, SHLIGHT_VERSION "\n");
  EXPECT_EQ(version.err, "");
}

// Each wrong in one way, with what the message must name.
TEST_F(ToolHelp, WrongUsageIsExplained) {
  struct Case {
    std::vector<std::string> arguments;
    std::string named;
  };
  const std::string png = path("a.png");
  for (const auto& [arguments, named] :
       {Case{{}, "A subcommand is required"},
        {{"rendr"}, "rendr"},
        {{"--no-such-option"}, "--no-such-option"},
        {{"project"}, "LIGHT is required"},
        {{"project", "builtin:sky", "builtin:axes"}, "builtin:axes"},
        {{"project", "builtin:sky", "--bands", "0"}, "--bands: Value 0 not in range 1 to 256"},
        {{"project", "builtin:sky", "--bands"}, "--bands"},
        {{"project", "builtin:sky", "--layout", "spherical"}, "spherical"},
        {{"project", "builtin:sky", "--samples", "1"}, "--samples: Value 1 not in range 9 to"},
        {{"project", "builtin:axes", "-o", ""}, "--output: the file's name is empty"},
        {{"project-brdf"}, "MATERIAL is required"},
        {{"project-brdf", "lambert"}, "--view is required"},
        {{"project-brdf", "lambert", "--view", "90,0"}, "'90,0' is no view"},
        {{"project-brdf", "lambert", "--view", "45"}, "'45' is no view"},
        {{"project-brdf", "lambert", "--view", "nan,0"}, "'nan,0' is no view"},
        {{"project-brdf", "lambert", "--view", "45,0,0"}, "'45,0,0' is no view"},
        {{"info"}, "FILE is required"},
        {{"info", "builtin:sky", "--max-pixels", "0"}, "--max-pixels"},
        {{"info", "builtin:sky", "--clamp", "0"}, "--clamp: '0' is no number from"},
        {{"info", "builtin:sky", "--clamp", "nan"}, "--clamp: 'nan' is no number from"},
        {{"compare", png}, "B is required"},
        {{"compare", png, png, "-o", path("a.exr")}, "a.exr' does not end in .png"},
        {{"compare", png, png, "--max-flip", "nan"}, "--max-flip: 'nan' is no number from"},
        {{"render", "-o", path("a.jpg")}, "a.jpg' ends neither in .png nor in .exr"},
        {{"render", "-o", png, "--size", "0x0"}, "'0x0' is no size such as 1280x720"},
        {{"render", "-o", png, "--size", "640x480x3"}, "'640x480x3' is no size"},
        {{"render", "-o", png, "--size", "-5x5"}, "'-5x5' is no size"},
        {{"render", "-o", png, "--camera", "0,91"}, "'0,91' is no camera"},
        {{"render", "-o", png, "--camera", "0,nan"}, "'0,nan' is no camera"},
        {{"render", "-o", png, "--camera", "0,0,0"}, "'0,0,0' is no camera"},
        {{"render", "-o", png, "--camera", "0,0,1,"}, "'0,0,1,' is no camera"},
        {{"render", "-o", png, "--look-at", "0,0"}, "'0,0' is no point"},
        {{"render", "-o", png, "--look-at", "0,nan,0"}, "'0,nan,0' is no point"},
        {{"render", "-o", png, "--tone-map", "curve"}, "--tone-map: Check curve"},
        {{"render", "-o", png, "--show", "everything"}, "'everything' is none of normals"},
        {{"render", "-o", png, "--show", "degree:10"}, "'degree:10' is none of normals"},
        {{"render", "-o", png, "--bands", "3", "--show", "degree:3"}, "3 bands have the degrees 0 to 2"},
        {{"render", "-o", png, "--show", "visibility"}, "visibility only with --method transfer"},
        {{"view", "--set", "bands=eleven"}, "'eleven'"},
        {{"view", "--set", "colour=red"}, "'colour': is nothing that can be set"},
        {{"view", "--set", "material=velvet"}, "velvet"},
        {{"view", "--size", "0x0"}, "'0x0' is no size"},
        {{"view", "--scale", "nan"}, "--scale: 'nan' is no number"},
        {{"render", "-o", png, "--bands", "11"}, "--bands: Value 11 not in range 1 to 10"},
        {{"render", "-o", png, "--frames", "0"}, "--frames: Value 0 not in range 1 to"},
        {{"render", "-o", png, "--exposure", "inf"}, "'inf' is no number from -60 to 60"},
        {{"render", "-o", png, "--rotate-light", "nan"}, "'nan' is no number from -36000 to 36000"},
        {{"render", "-o", png, "--method", "magic"},
         "--method: magic not in {irradiance,transfer,reflectance,hybrid,reference}"},
        {{"render", "-o", png, "--transfer", "shadowed"}, "--transfer: not with --method irradiance"},
        {{"render", "-o", png, "--samples", "64"}, "--samples: not with --method irradiance"},
        {{"render", "-o", png, "--method", "irradiance", "--bounces", "2"}, "--bounces: not with --method irradiance"},
        {{"render", "-o", png, "--method", "transfer", "--transfer", "soft"}, "--transfer: Check soft"},
        {{"render", "-o", png, "--method", "transfer", "--samples", "many"},
         "'many' is neither auto nor a number from 1"},
        {{"render", "-o", png, "--method", "transfer", "--samples", "0"}, "'0' is neither auto nor a number from 1"},
        {{"render", "-o", png, "--method", "transfer", "--samples", "65537"}, "'65537' is neither auto nor"},
        {{"render", "-o", png, "--method", "transfer", "--bounces", "65"}, "--bounces: Value 65 not in range 0 to 64"},
        {{"render", "-o", png, "--method", "transfer", "--bands", "11"}, "--bands: Value 11 not in range 1 to 10"},
        {{"render", "-o", png, "--method", "transfer", "--transfer", "cosine", "--samples", "9"}, "is exact"},
        {{"render", "-o", png, "--method", "transfer", "--transfer", "shadowed", "--bounces", "1"},
         "--bounces: only with --transfer interreflected"},
        {{"convert-map", "builtin:sky"}, "--output is required"},
        {{"convert-map", "builtin:sky", "-o", png}, "ends neither in .exr nor in .hdr"},
        {{"convert-map", "builtin:sky", "-o", path("a.exr"), "--layout", "cross"}, "cross"},
        {{"demo", "here"}, "here"}}) {
    const ToolRun run = run_tool(arguments);
    const auto where = testing::Message() << testing::PrintToString(arguments) << "\n" << run;
    EXPECT_EQ(run.exit_code, 2) << where;
    EXPECT_EQ(run.out, "") << where;
    EXPECT_NE(run.err.find(named), std::string::npos) << where;
    EXPECT_NE(run.err.find("--help"), std::string::npos) << where;
  }
  EXPECT_TRUE(contents().empty());
}

}  // namespace
}  // namespace shlight
