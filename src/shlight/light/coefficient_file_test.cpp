#include "shlight/light/coefficient_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "shlight/core/error.h"
#include "shlight/core/file.h"
#include "shlight/core/temporary_folder.h"

namespace shlight {
namespace {

RgbCoefficients some_coefficients() {
  RgbCoefficients c(4);
  for (std::size_t i = 0; i < c.size(); ++i) c[i] = {std::sin(double(i)), -1e-30 * double(i), 1e6 / (1.0 + double(i))};
  return c;
}

TEST(CoefficientFile, RoundTripIsExact) {
  const TemporaryFolder folder;
  const RgbCoefficients c = some_coefficients();
  save_coefficients(folder / "a.json", c);
  EXPECT_EQ(load_coefficients(folder / "a.json"), c);
}

// One edit of a good file each, and a word of the error that must follow.
TEST(CoefficientFile, RefusesDamagedFiles) {
  const TemporaryFolder folder;
  const std::string good = format_coefficients(some_coefficients());
  const auto edited = [&](const std::string& what, const std::string& by) {
    const auto at = good.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return good.substr(0, at) + by + good.substr(at + what.size());
  };
  const std::pair<std::string, const char*> files[] = {
      {"", "is no JSON"},
      {good.substr(0, good.size() / 2), "is no JSON"},
      {"[1, 2]", "\"shlight\" is missing"},
      {edited("\"shlight\": 1", "\"shlight\": 2"), "is of version 2"},
      {edited("\"bands\": 4", "\"bands\": 5"), "16 entries: 25 entries"},
      {edited("\"bands\": 4", "\"bands\": 3"), "16 entries: 9 entries"},
      {edited("\"bands\": 4", "\"bands\": -1"), "\"bands\" is -1"},
      {edited("\"bands\": 4", "\"bands\": 1e9"), "\"bands\" is "},
      {edited("\"bands\": 4", "\"bands\": \"four\""), "\"bands\" is \"four\""},
      {edited("false", "true"), "condon_shortley_phase true"},
      {edited("nothing folded in", "pi folded in"), "\"quantity\": \"radiance, nothing folded in\""},
      {edited("\"frame\"", "\"farme\""), "frame missing"},
      {edited("[0.0,", "[null,"), "coefficient 0 is [null"},
      {edited("[0.0,", "[\"0\","), "coefficient 0 is"},
      {edited("[0.0,", "[0.0,1,"), "three finite numbers"},
      {edited("[0.0,", "[1e999,"), "JSON"},
      {edited("\"coefficients\": [", "\"coefficients\": 7, \"x\": ["), "has 0 entries"},
      {std::string(100000, '['), "is no JSON"},
  };
  for (const auto& [text, expected] : files) {
    write_file(folder / "a.json", text);
    try {
      load_coefficients(folder / "a.json");
      ADD_FAILURE() << "accepted: " << text.substr(0, 300);
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(expected), std::string::npos) << error.what();
      EXPECT_TRUE(std::string(error.what()).starts_with((folder / "a.json").string()));
    }
  }
}

}  // namespace
}  // namespace shlight
