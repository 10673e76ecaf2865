// Inputs that must be refused: exit code 1, one line that names them, nothing written.

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstring>

#include "shlight/light/builtin_light.h"
#include "shlight/light/coefficient_file.h"
#include "tool_test_util.h"

namespace shlight {
namespace {

class ToolBadInput : public ToolTest {
 protected:
  // A file or text in the place of a light; an old result stands where the new one would go.
  void expect_bad_light(const std::string& light, const std::string& subject, const std::string& wrong) const {
    write("old.json", "old");
    expect_refused({"project", light, "-o", path("old.json")}, subject, wrong);
  }
  void expect_bad_file(const std::string& file, const std::string& wrong) const { expect_bad_light(file, file, wrong); }
  void expect_bad_model(const std::string& model, const std::string& wrong) const {
    expect_refused({"render", model, "-o", path("new.png")}, model, wrong);
  }
};

std::string radiance_header(const std::string& size) {
  return "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n" + size + "\n";
}

// The bytes of numbers as they lie in memory.
template <class... Numbers>
std::string bytes_of(Numbers... numbers) {
  std::string bytes;
  (bytes.append(reinterpret_cast<const char*>(&numbers), sizeof numbers), ...);
  return bytes;
}

TEST_F(ToolBadInput, WhatIsNoFile) {
  std::filesystem::create_directory(folder_ / "folder.hdr");
  std::filesystem::create_directory(folder_ / "folder.json");
  std::filesystem::create_directory(folder_ / "folder.obj");
  for (const char* pipe : {"pipe.exr", "pipe.json", "pipe.obj"}) ASSERT_EQ(::mkfifo(path(pipe).c_str(), 0600), 0);
  expect_bad_file(path("missing.hdr"), "no such file");
  expect_bad_file(path("missing.json"), "cannot be read (No such file or directory)");
  expect_bad_file("", "no such file");
  expect_bad_file(path("folder.hdr"), "is a folder without a cube map");
  expect_bad_file(path("folder.json"), "is not a regular file");
  expect_bad_file(path("pipe.exr"), "is not a regular file");
  expect_bad_file(path("pipe.json"), "is not a regular file");
  expect_bad_file("/dev/zero", "is not a regular file");
  expect_bad_model(path("missing.obj"), "is not there");
  expect_bad_model(path("folder.obj"), "is a folder");
  expect_bad_model(path("pipe.obj"), "is not a regular file");
  expect_bad_model("builtin:nothing", "is no built-in model");
  expect_refused({"render", "builtin:sphere", "--light", path("missing.hdr"), "-o", path("new.png")},
                 path("missing.hdr"), "no such file");
  for (const char* name : {"missing", "pipe.exr", "pipe.obj"}) expect_refused({"info", path(name)}, path(name), "");
}

TEST_F(ToolBadInput, NamesOfSeveralLinesStayInOne) {
  const ToolRun run = run_tool({"info", path("two\nlines.hdr")});
  EXPECT_EQ(run.exit_code, 1) << run;
  EXPECT_EQ(run.err.find('\n'), run.err.size() - 1) << run;
}

TEST_F(ToolBadInput, Pictures) {
  save_image(folder_ / "good.exr", make_axes_light()->lat_long(64));
  const std::string good = text_of(path("good.exr"));
  expect_bad_file(write("empty.hdr", ""), "is not a readable picture");
  expect_bad_file(write("empty.exr", ""), "is not a readable picture");
  expect_bad_file(write("text.hdr", "no picture\n"), "is not a readable picture");
  expect_bad_file(write("header.exr", good.substr(0, 40)), "is not a readable picture");
  expect_bad_file(write("half.exr", good.substr(0, good.size() / 2)), "is not a readable picture");
  expect_bad_file(write("half.hdr", radiance_header("-Y 32 +X 64") + std::string(1000, '\1')),
                  "is not a readable picture");
  expect_bad_file(write("nothing.hdr", radiance_header("-Y 0 +X 0")), "");
  expect_bad_file(write("negative.hdr", radiance_header("-Y -32 +X 64")), "");
  expect_bad_file(write("huge.hdr", radiance_header("-Y 100000 +X 200000")), "has 200000 x 100000 pixels");
  expect_bad_file(write("endless.hdr", radiance_header("-Y 2000000000 +X 2000000000")), "");
}

TEST_F(ToolBadInput, PicturesOfUnknownLayoutOrTooManyPixels) {
  save_image(folder_ / "odd.exr", Image(100, 40));
  expect_bad_file(path("odd.exr"), "100 x 40 pixels tell no layout");
  EXPECT_EQ(run_tool({"project", path("odd.exr"), "--layout", "lat-long"}).exit_code, 0);
  expect_refused({"project", path("odd.exr"), "--layout", "lat-long", "--max-pixels", "3999"}, path("odd.exr"),
                 "has 100 x 40 pixels: at most 3999 pixels");
  EXPECT_EQ(run_tool({"project", path("odd.exr"), "--layout", "lat-long", "--max-pixels", "4000"}).exit_code, 0);
}

TEST_F(ToolBadInput, PicturesThatHoldNoLight) {
  const std::string header = "DDS " + bytes_of(124u, 0x1007u, 4u, 4u, 0u, 0u, 1u) + std::string(44, '\0');
  const std::string floats = bytes_of(32u, 4u, 116u, 0u, 0u, 0u, 0u, 0u) + bytes_of(0x1008u, 0xfe00u, 0u, 0u, 0u);
  expect_bad_file(write("short.dds", header + floats + std::string(6 * 16 * 16 - 1, '\0')), "it ends too soon");
  expect_bad_file(write("half.dds", header), "it ends within its header");
  expect_bad_file(write("odd.float", std::string(100, '\1')), "has 100 bytes");
  expect_bad_file(write("noise.float", std::string(12 * 64, '\x7e')), "holds no floats that can be light");
  expect_bad_file(write("format.hdr", "#?RADIANCE\nFORMAT=ascii\n\n-Y 1 +X 1\n\1\1\1\1"), "the format 'ascii'");
  expect_refused({"project", "builtin:sky", "--clamp", "1"}, "builtin:sky", "cannot be clamped");
}

TEST_F(ToolBadInput, Models) {
  for (const char* name : {"a.x", "a.ply", "a"}) expect_bad_model(write(name, ""), "is empty");
  for (const char* name : {"a.x", "a.obj", "a.ply", "a.stl", "a.glb"}) expect_bad_model(write(name, "no model\n"), "");

  const std::string corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  expect_bad_model(write("points.obj", corners), "");
  expect_bad_model(write("lines.obj", corners + "l 1 2 3\n"), "");
  expect_bad_model(write("flat.obj", corners + "f 1 2 2\n"), "holds no triangles");
  expect_bad_model(write("nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), "");
  expect_bad_model(write("elsewhere.obj", corners + "f 1 2 9\n"), "");
  expect_bad_model(write("elsewhere.gltf", R"({"asset": {"version": "2.0"}, "buffers": [{"uri": "missing.bin",
      "byteLength": 36}], "bufferViews": [{"buffer": 0, "byteLength": 36}], "accessors": [{"bufferView": 0, "count": 3,
      "componentType": 5126, "type": "VEC3"}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
      "nodes": [{"mesh": 0}], "scenes": [{"nodes": [0]}], "scene": 0})"),
                   "");
  // Sizes that the file cannot have.
  expect_bad_model(write("huge.ply",
                         "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty float x\nproperty "
                         "float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\n"
                         "end_header\n"),
                   "");
  expect_bad_model(write("huge.stl", std::string(80, ' ') + bytes_of(0xffffffffu) + std::string(50, '\0')), "");
  expect_bad_model(write("huge.glb", "glTF" + bytes_of(2u, 0xffffffffu, 0xfffffff0u) + "JSON{}"), "");
}

TEST_F(ToolBadInput, Formulas) {
  const auto expect_bad = [&](const std::string& formula, const std::string& wrong) {
    expect_bad_light("fn:" + formula, "fn", wrong);
  };
  expect_bad("", "'' does not parse");
  expect_bad("1 +", "'1 +' does not parse");
  expect_bad("w", "'w' does not parse");
  expect_bad("nosuch(x)", "'nosuch(x)' does not parse");
  expect_bad("1, 2", "'1, 2' has 2 values");
  expect_bad("y = 1", "'y = 1' has a '=' that compares nothing");
  expect_bad("r=1; q=2", "'q=2' is no part r=, g= or b=");
  expect_bad("r=1; r=2", "'r' is given twice");
  expect_bad("1/0", "'1/0' is infinite at x = ");
  expect_bad("sqrt(x)", "'sqrt(x)' is NaN at x = -");
  expect_bad(std::string(10001, '1'), "the formula has 10001 characters: at most 10000 characters");
  expect_bad(std::string(9999, '('), "does not parse");
}

TEST_F(ToolBadInput, BuiltinLights) {
  expect_bad_light("builtin:nothing", "builtin:nothing", "no such built-in light");
  expect_bad_light("builtin:", "builtin:", "no such built-in light");
  expect_bad_light("builtin:sky:elevation=91", "builtin", "elevation is 91: a number in [0, 90]");
  expect_bad_light("builtin:sky:elevation=nan", "builtin", "elevation is nan");
  expect_bad_light("builtin:sky:elevation=high", "builtin", "'elevation=high' is no parameter with a number");
  expect_bad_light("builtin:sky:height=3", "builtin", "'height=3' is no parameter with a number");
  expect_bad_light("builtin:axes:elevation=3", "builtin", "'elevation=3' is no parameter with a number");
}

// One edit of a good file each.
TEST_F(ToolBadInput, CoefficientFiles) {
  run({"project", "builtin:axes", "--bands", "2", "-o", path("good.json")});
  const std::string good = text_of(path("good.json"));
  const auto expect_bad = [&](const std::string& what, const std::string& by, const std::string& wrong) {
    const auto at = good.find(what);
    ASSERT_NE(at, std::string::npos) << what;
    expect_bad_file(write("bad.json", good.substr(0, at) + by + good.substr(at + what.size())), wrong);
  };
  expect_bad(good, "", "is no JSON");
  expect_bad(good, "[]", "is no coefficient file");
  expect_bad(good, good.substr(0, good.size() / 2), "is no JSON");
  expect_bad(good, std::string(1'000'000, '['), "is no JSON");
  expect_bad("\"shlight\": 1", "\"shlight\": 2", "is of version 2");
  expect_bad("\"bands\": 2", "\"bands\": 3", "\"coefficients\" has 4 entries: 9 entries for 3 bands");
  expect_bad("\"bands\": 2", "\"bands\": 0", "\"bands\" is 0: a whole number from 1 to 256");
  expect_bad("\"bands\": 2", "\"bands\": 2.5", "\"bands\" is 2.5");
  expect_bad("\"bands\": 2", "\"bands\": \"2\"", "\"bands\" is \"2\"");
  expect_bad("\"bands\": 2", "\"bands\": 2000000000", "\"bands\" is 2000000000");
  expect_bad("\"bands\": 2,", "", "\"bands\" is missing");
  expect_bad("\"condon_shortley_phase\": false", "\"condon_shortley_phase\": true",
             "\"convention\" has condon_shortley_phase true: \"condon_shortley_phase\": false");
  expect_bad("+Y up", "+Z up", "\"convention\" has frame");
  expect_bad("\"coefficients\": [\n    [", "\"coefficients\": [\n    [1, 2, 3], [", "has 5 entries");
  expect_bad("\"coefficients\": [\n    [", "\"coefficients\": [\n    [4, ", "coefficient 0 is [4,");
  expect_bad("\"coefficients\": [\n    [", "\"coefficients\": [\n    [\"one\", 2, 3], [", "has 5 entries");
  expect_bad("\"coefficients\": [\n    [", "\"coefficients\": [\n    null], [[", "is no JSON");
  expect_bad("]\n  ]", "], [null, 0, 0]\n  ]", "has 5 entries");
}

}  // namespace
}  // namespace shlight
