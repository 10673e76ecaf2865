// Real and damaged files.

#include <gtest/gtest.h>

#include <algorithm>

#include "tool_test_util.h"

namespace shlight {
namespace {

class ToolData : public ToolDrawingTest {};

// Whatever a file holds, the program ends by itself and soon, with an answer or with one line that names the file.
void expect_answer_or_refusal(const std::filesystem::path& file) {
  const ToolRun run = run_tool({"info", file.string(), "--json"}, {.timeout = 40});
  EXPECT_EQ(run.signal, 0) << file << "\n" << run;
  EXPECT_LT(run.seconds, 30) << file;
  if (run.exit_code == 0) {
    EXPECT_TRUE(nlohmann::json::accept(run.out)) << file << "\n" << run;
    return;
  }
  EXPECT_EQ(run.exit_code, 1) << file << "\n" << run;
  EXPECT_EQ(run.out, "") << file;
  EXPECT_TRUE(run.err.starts_with("shlight info: " + file.string() + ": ")) << file << "\n" << run;
  EXPECT_EQ(run.err.find('\n'), run.err.size() - 1) << file << "\n" << run;
}

TEST_F(ToolData, DamagedFilesAreAnsweredOrRefused) {
  SHLIGHT_TEST_DATA_OR_SKIP(data);
  int files = 0;
  for (const char* folder : {"bad/image/oiio", "bad/image/magnum_exr", "bad/image/magnum_dds",
                             "bad/mesh/assimp_invalid", "bad/mesh/magnum_stl"})
    for (const auto& entry : std::filesystem::recursive_directory_iterator(std::filesystem::path(data) / folder))
      if (entry.is_regular_file()) {
        expect_answer_or_refusal(entry.path());
        ++files;
      }
  EXPECT_GT(files, 30);
}

// The middle of a picture of `model`, and how bright the darkest and the brightest of its pixels are.
struct Drawn {
  double middle[3] = {0, 0, 0};
  int darkest = 255, brightest = 0;
};
Drawn measure(const Image8& picture) {
  Drawn drawn;
  int count = 0;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const unsigned char* pixel = &picture.values[4 * static_cast<std::size_t>(y * picture.width + x)];
      drawn.darkest = std::min<int>(drawn.darkest, pixel[1]);
      drawn.brightest = std::max<int>(drawn.brightest, pixel[1]);
      const bool middle =
          std::abs(2 * x - picture.width) < picture.width / 6 && std::abs(2 * y - picture.height) < picture.height / 6;
      if (!middle) continue;
      for (int c = 0; c < 3; ++c) drawn.middle[c] += pixel[c];
      ++count;
    }
  for (double& c : drawn.middle) c /= count;
  return drawn;
}

TEST_F(ToolData, RealModelsUnderARealLight) {
  SHLIGHT_TEST_DATA_OR_SKIP(data);
  const std::string folder = data;
  for (const std::string model : {"dx_skullocc.x", "Duck.glb"}) {
    const ToolRun done = run({"render", folder + "/models/" + model, "--light",
                              folder + "/lights/polyhaven_1k_venice.hdr", "--size", "160x120", "-o", path("a.png")});
    EXPECT_EQ(done.out, "");
    const Drawn drawn = measure(load_image8(folder_ / "a.png"));
    EXPECT_GT(drawn.brightest, drawn.darkest + 60) << model;
    EXPECT_GT(drawn.middle[1], 40) << model;
    // The duck is yellow.
    if (model == "Duck.glb") {
      EXPECT_GT(drawn.middle[0], 1.5 * drawn.middle[2]);
      EXPECT_GT(drawn.middle[1], 1.3 * drawn.middle[2]);
    }
  }
}

}  // namespace
}  // namespace shlight
