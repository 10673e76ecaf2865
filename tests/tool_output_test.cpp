// Where results cannot be written.

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "shlight/light/coefficient_file.h"
#include "tool_test_util.h"

namespace shlight {
namespace {

constexpr const char* kCannotBeWritten = "cannot be written (";

class ToolOutput : public ToolTest {};

TEST_F(ToolOutput, PlacesThatTakeNoFile) {
  std::filesystem::create_directory(folder_ / "folder");
  ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
  const std::string file = write("file", "old");
  struct Case {
    std::string output, wrong;
  };
  for (const auto& [output, wrong] : {Case{path("missing/a.json"), kCannotBeWritten},
                                      {path("folder"), "is not a regular file"},
                                      {path("folder") + "/", "is not a regular file"},
                                      {path("pipe"), "is not a regular file"},
                                      {file + "/a.json", kCannotBeWritten},
                                      {"/proc/a.json", kCannotBeWritten},
                                      {"/dev/full", "is not a regular file"},
                                      {path(std::string(300, 'a')), kCannotBeWritten}})
    expect_refused({"project", "builtin:axes", "-o", output}, output, wrong);
}

// Nothing that was there before a failure is lost, and a success replaces it whole.
TEST_F(ToolOutput, OldFilesAreReplacedWholeOrKept) {
  const std::string file = write("a.json", std::string(100000, 'x'));
  expect_refused({"project", "fn:1/0", "-o", file}, "fn", "'1/0' is infinite");
  run({"project", "builtin:axes", "-o", file});
  EXPECT_EQ(text_of(file), run({"project", "builtin:axes", "--json"}).out);
  EXPECT_EQ(contents().size(), 1u);
}

TEST_F(ToolOutput, PermissionsStayAsTheyWere) {
  const std::string file = write("a.json", "old");
  std::filesystem::permissions(file, std::filesystem::perms(0640));
  run({"project", "builtin:axes", "-o", file});
  EXPECT_EQ(std::filesystem::status(file).permissions(), std::filesystem::perms(0640));
}

TEST_F(ToolOutput, StdoutThatTakesNothingIsAnError) {
  const std::vector<std::vector<std::string>> commands = {
      {"project", "builtin:axes"}, {"project", "fn:1", "--json"}, {"info", "fn:1"}};
  for (const auto& command : commands) {
    expect_refused(command, "stdout", "cannot be written (Bad file descriptor)", {.standard_output = Stdout::kClosed});
    expect_refused(command, "stdout", "cannot be written (No space left", {.standard_output = Stdout::kFullDisk});
    expect_refused(command, "stdout", "cannot be written (Broken pipe)", {.standard_output = Stdout::kNobodyReads});
  }
}

// Files that are opened while stdout is closed do not become stdout: nothing is printed into them.
TEST_F(ToolOutput, ClosedStdoutHarmsNoFile) {
  save_image(folder_ / "a.exr", Image(64, 32));
  const std::string image = text_of(path("a.exr"));
  expect_refused({"project", path("a.exr"), "--layout", "lat-long"}, "stdout", "Bad file descriptor",
                 {.standard_output = Stdout::kClosed});
  EXPECT_TRUE(text_of(path("a.exr")) == image);
  const ToolRun file_only =
      run_tool({"project", path("a.exr"), "-o", path("a.json")}, {.standard_output = Stdout::kClosed});
  EXPECT_EQ(file_only.exit_code, 0) << "nothing was to be printed\n" << file_only;
  EXPECT_EQ(text_of(path("a.json")), run({"project", path("a.exr"), "--json"}).out);
}

TEST_F(ToolOutput, HelpThatCannotBePrintedIsAnError) {
  for (const Stdout kind : {Stdout::kClosed, Stdout::kFullDisk, Stdout::kNobodyReads})
    for (const std::vector<std::string>& arguments : {std::vector<std::string>{"--help"}, {"--version"}}) {
      const ToolRun run = run_tool(arguments, {.standard_output = kind});
      EXPECT_EQ(run.exit_code, 1) << testing::PrintToString(arguments) << static_cast<int>(kind) << "\n" << run;
      EXPECT_TRUE(run.err.starts_with("shlight: stdout: cannot be written (")) << run;
    }
}

class ToolOutputDrawing : public ToolDrawingTest {};

TEST_F(ToolOutputDrawing, PicturesThatCannotBeWritten) {
  std::filesystem::create_directory(folder_ / "folder.png");
  const std::string light = path("light.json");  // no picture to make of it
  save_coefficients(light, RgbCoefficients(3));
  for (const std::string& output : {path("missing/a.png"), std::string("/proc/a.exr"), path("folder.png")})
    expect_refused({"render", "builtin:sphere", "--light", light, "--size", "8x8", "-o", output}, output, "");
  expect_refused({"render", "builtin:sphere", "--light", light, "--size", "8x8", "--json"}, "stdout", "No space left",
                 {.standard_output = Stdout::kFullDisk});
  expect_refused({"render", "builtin:sphere", "--light", light, "--size", "8x8", "--json"}, "stdout",
                 "Bad file descriptor", {.standard_output = Stdout::kClosed});
}

TEST_F(ToolOutputDrawing, DemoFoldersThatCannotBeMade) {
  const std::string file = write("file", "old");
  expect_refused({"demo", "-o", file + "/demo"}, file + "/demo", "cannot be made (");
  expect_refused({"demo", "-o", file}, file, "cannot be made (");
  expect_refused({"demo", "-o", "/proc/demo"}, "/proc/demo", "cannot be made (");
}

TEST_F(ToolOutputDrawing, PicturesTooLargeToDrawAreRefused) {
  const std::string light = path("light.json");
  save_coefficients(light, RgbCoefficients(3));
  expect_refused({"render", "builtin:sphere", "--light", light, "--size", "99999x1", "-o", path("a.png")}, "OpenGL",
                 "a picture of 99999x1 pixels cannot be drawn");
}

}  // namespace
}  // namespace shlight
