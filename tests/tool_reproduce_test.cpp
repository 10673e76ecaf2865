// shlight reproduce

#include <gtest/gtest.h>

#include <set>

#include "tool_test_util.h"

namespace shlight {
namespace {

constexpr RunToolParams kPatient = {.timeout = 280};

nlohmann::json parse(const ToolRun& run) {
  const auto json = nlohmann::json::parse(run.out, nullptr, false);
  EXPECT_FALSE(json.is_discarded()) << run;
  return json;
}

nlohmann::json part_of(const nlohmann::json& report, const std::string& id) {
  for (const auto& part : report["parts"])
    if (part["id"] == id) return part;
  ADD_FAILURE() << "no part " << id;
  return {};
}

// What a report says that is not a time.
nlohmann::json values_of(const nlohmann::json& report) {
  nlohmann::json values;
  for (const auto& part : report["parts"]) values[part["id"].get<std::string>()] = part["values"];
  return values;
}

std::size_t count(const std::string& text, const std::string& word) {
  std::size_t number = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++number;
  return number;
}

class ToolReproduce : public ToolTest {};
class ToolReproduceDrawing : public ToolDrawingTest {};

TEST_F(ToolReproduceDrawing, QuickReportIsWhole) {
  const ToolRun run = run_tool(
      {"reproduce", "-o", path("report"), "--quick", "--samples", "900", "--model", "builtin:sphere", "--json"},
      kPatient);
  ASSERT_EQ(run.exit_code, 0) << run;
  const auto report = parse(run);
  const std::string page = text_of(path("report/thesis.html"));
  EXPECT_EQ(report["parts"].size(), 23u);
  for (const auto& part : report["parts"]) {
    EXPECT_FALSE(part.contains("missing")) << part;
    EXPECT_NE(page.find("id=\"" + part["id"].get<std::string>() + "\""), std::string::npos) << part["id"];
    for (const auto& file : part["files"]) EXPECT_FALSE(text_of(file.get<std::string>()).empty()) << file;
  }

  // It opens without a network: pictures are inside, and nothing is fetched.
  EXPECT_GT(count(page, "<img "), 30u);
  EXPECT_EQ(count(page, "<img "), count(page, "src=\"data:image/"));
  for (const char* fetched : {"=\"http", "url(", "@import", "<script", "<link"})
    EXPECT_EQ(page.find(fetched), std::string::npos) << fetched;
  EXPECT_GT(count(page, "<math"), 10u);
  EXPECT_EQ(page.find("{{"), std::string::npos);

  // By hand: (A_0² + A_1² + A_2²)/(2π/3) = (π/4 + π/3 + 5π/64)/(2π/3) = 127/128.
  EXPECT_NEAR(part_of(report, "claim-1")["values"]["cosine_energy"], 127.0 / 128, 1e-12);
  // More bands are nearer to the truth, by the samples' scatter and the reference's noise at most.
  const auto figures = part_of(report, "figures-17-22")["values"];
  EXPECT_GT(figures["figure-17"], 2 * double(figures["figure-18"]));
  EXPECT_GT(figures["figure-18"], 2 * double(figures["figure-19"]));
  EXPECT_LT(figures["classic_to_nine"], 0.02);
  for (const char* row : {"figures-31-32", "figures-35-36", "figures-37-38"}) {
    const auto errors = part_of(report, row)["values"];
    EXPECT_GT(errors["bands_3"], 1.5 * double(errors["bands_5"])) << row;
  }
}

// A light and a model that cannot be loaded cost the parts that need them, and no others. Two runs say the same.
TEST_F(ToolReproduce, BrokenInputsLeaveTheRest) {
  const std::string model = write("model.obj", "this is no model\n");
  const std::vector<std::string> command = {"reproduce", "-o",           path("report"), "--quick", "--samples", "100",
                                            "--light",   path("no.hdr"), "--model",      model,     "--json"};
  const ToolRun first = run_tool(command, kPatient), second = run_tool(command, kPatient);
  for (const ToolRun& run : {first, second}) {
    EXPECT_EQ(run.exit_code, 1) << run;
    EXPECT_NE(run.err.find("shlight reproduce: " + path("report/thesis.html") + ": "), std::string::npos) << run;
  }
  const auto report = parse(first);
  EXPECT_EQ(values_of(report), values_of(parse(second)));

  const std::set<std::string> whole = {"figure-11", "figure-12",        "figure-16",
                                       "table-3",   "errata-harmonics", "errata-reflection"};
  for (const std::string& id : whole) EXPECT_FALSE(part_of(report, id).contains("missing")) << id;
  const std::string page = text_of(path("report/thesis.html"));
  for (const auto& [id, why] :
       {std::pair{"figures-17-22", "no.hdr"}, {"table-1", "no.hdr"}, {"table-2", "model.obj"}}) {
    const auto part = part_of(report, id);
    ASSERT_TRUE(part.contains("missing")) << id;
    EXPECT_NE(part["missing"].get<std::string>().find(why), std::string::npos) << part;
    EXPECT_NE(page.find(part["title"].get<std::string>() + " is missing."), std::string::npos) << id;
  }
  EXPECT_FALSE(text_of(path("report/table-3.csv")).empty());
}

TEST_F(ToolReproduce, RefusesWhatCannotBe) {
  const std::string file = write("file", "taken");
  expect_refused({"reproduce", "-o", file}, file, "cannot be made");
  expect_refused({"reproduce", "-o", file + "/report"}, file + "/report", "cannot be made");
  EXPECT_EQ(run_tool({"reproduce", "--samples", "8"}).exit_code, 2);
}

}  // namespace
}  // namespace shlight
