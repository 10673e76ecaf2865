#pragma once

// What the tests of the whole program share.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "run_tool.h"
#include "shlight/core/error.h"
#include "shlight/core/file.h"
#include "shlight/core/temporary_folder.h"
#include "shlight/image/image_io.h"
#include "shlight/render/context.h"

namespace shlight {

inline std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// A test with a folder of its own for inputs and outputs.
class ToolTest : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  // Writes a file into the folder and returns its path.
  std::string write(const std::string& name, const std::string& text) const {
    write_file(folder_ / name, text);
    return path(name);
  }

  // Runs a command that must succeed.
  static ToolRun run(const std::vector<std::string>& arguments) {
    const ToolRun run = run_tool(arguments);
    EXPECT_EQ(run.exit_code, 0) << testing::PrintToString(arguments) << "\n" << run;
    return run;
  }

  // The JSON that a command prints.
  static nlohmann::json run_json(std::vector<std::string> arguments) {
    arguments.push_back("--json");
    const ToolRun done = run(arguments);
    const auto json = nlohmann::json::parse(done.out, nullptr, false);
    EXPECT_FALSE(json.is_discarded()) << done;
    return json;
  }

  // The names of everything in the folder; of files, with what they hold.
  std::map<std::string, std::string> contents() const {
    std::map<std::string, std::string> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_.path()))
      files[entry.path().string()] = entry.is_regular_file() ? text_of(entry.path()) : "";
    return files;
  }

  // Expects `arguments` to fail with one line "shlight COMMAND: SUBJECT: …WRONG…: what would have been accepted", and
  // to leave the folder as it was.
  void expect_refused(const std::vector<std::string>& arguments, const std::string& subject, const std::string& wrong,
                      const RunToolParams& params = {}) const {
    const auto before = contents();
    const ToolRun run = run_tool(arguments, params);
    const auto where = testing::Message() << testing::PrintToString(arguments) << "\n" << run;
    EXPECT_EQ(run.exit_code, 1) << where;
    EXPECT_EQ(run.out, "") << where;
    const std::string start = "shlight " + arguments[0] + ": " + subject + ": ";
    if (!run.err.starts_with(start)) {
      ADD_FAILURE() << "expected on stderr: " << start << "…\n" << where;
    } else {
      const std::string rest = run.err.substr(start.size());
      EXPECT_NE(rest.find(wrong), std::string::npos) << "expected on stderr: " << wrong << "\n" << where;
      const auto accepted = rest.rfind(": ");
      EXPECT_TRUE(accepted != std::string::npos && accepted > 0 && rest.size() > accepted + 3) << where;
      EXPECT_EQ(rest.find('\n'), rest.size() - 1) << "one line\n" << where;
    }
    EXPECT_TRUE(contents() == before) << "the folder is as it was\n" << where;
  }

  TemporaryFolder folder_;
};

// A test whose runs draw. Skipped, visibly, where no context can be made.
class ToolDrawingTest : public ToolTest {
 protected:
  void SetUp() override {
    try {
      const HeadlessContext context;
    } catch (const Error& error) {
      GTEST_SKIP() << error.what();
    }
  }
};

// The folder of real inputs, a visible skip where there is none.
#define SHLIGHT_TEST_DATA_OR_SKIP(data)                      \
  const char* const data = std::getenv("SHLIGHT_TEST_DATA"); \
  if (!data) GTEST_SKIP() << "SHLIGHT_TEST_DATA names no folder"

}  // namespace shlight
