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

TEST(CoefficientFile, ASunStandsBesideTheCoefficients) {
  const TemporaryFolder folder;
  const RgbCoefficients c = some_coefficients();
  const Sun sun = {{.36, .48, .80}, {1e5, 2.5, 0}};
  save_coefficients(folder / "a.json", c, sun);
  const CoefficientFile file = load_coefficient_file(folder / "a.json");
  EXPECT_EQ(file.coefficients, c);
  ASSERT_TRUE(file.sun);
  EXPECT_EQ(file.sun->direction, sun.direction);
  EXPECT_EQ(file.sun->irradiance, sun.irradiance);
  // Who asks for coefficients alone gets all of the light.
  RgbCoefficients both = c;
  add_sun(sun, both);
  EXPECT_EQ(load_coefficients(folder / "a.json"), both);
  save_coefficients(folder / "a.json", c);
  EXPECT_FALSE(load_coefficient_file(folder / "a.json").sun);
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
      {edited("\"bands\": 4", "\"bands\": 4, \"sun\": null"), "\"sun\" is null"},
      {edited("\"bands\": 4", "\"bands\": 4, \"sun\": {\"direction\": [0, 1, 0]}"), "\"irradiance\": [r, g, b]}"},
      {edited("\"bands\": 4", "\"bands\": 4, \"sun\": {\"direction\": [0, 2, 0], \"irradiance\": [1, 1, 1]}"),
       "of length 1"},
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
