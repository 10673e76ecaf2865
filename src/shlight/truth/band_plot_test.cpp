#include "shlight/truth/band_plot.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

namespace shlight {
namespace {

BandErrors make_errors() {
  BandErrors errors;
  for (int n = 1; n <= 4; ++n) {
    BandError error;
    error.bands = n;
    error.rms = std::pow(10, -n), error.p99 = 2 * error.rms, error.max = 3 * error.rms;
    error.rms_local = error.p99_local = error.max_local = 5 * error.rms;
    errors.bands.push_back(error);
    errors.light_energy.push_back(0.2);
    errors.reflectance_energy.push_back(n == 4 ? 0 : 0.5);
  }
  errors.light_total = 1, errors.reflectance_total = 1.5;
  return errors;
}

// The y of each point of the first path of a class.
std::vector<double> heights_of(const std::string& svg, const std::string& style) {
  std::vector<double> heights;
  const auto end = svg.find("\" class=\"" + style + "\"");
  if (end == std::string::npos) return heights;
  const auto begin = svg.rfind("d=\"", end) + 3;
  std::string path = svg.substr(begin, end - begin);
  double x = 0, y = 0;
  for (std::size_t at = 0; at < path.size(); at = path.find_first_of("ML", at + 1))
    if (std::sscanf(path.c_str() + at, "%*c%lf %lf", &x, &y) == 2) heights.push_back(y);
  return heights;
}

// A tenth of the error lies a fixed step lower.
TEST(BandPlot, IsLogarithmic) {
  const std::string svg = make_band_plot(make_errors(), {"title", "rms", 0.01, ""});
  const auto y = heights_of(svg, "curve rms");
  ASSERT_EQ(y.size(), 4u);
  EXPECT_GT(y[1], y[0] + 10) << "smaller errors are lower on the page";
  for (std::size_t i = 2; i < 4; ++i) EXPECT_NEAR(y[i] - y[i - 1], y[1] - y[0], 0.2) << "to the digits of the path";
}

TEST(BandPlot, SaysHowManyBandsAreEnough) {
  EXPECT_NE(make_band_plot(make_errors(), {"title", "rms", 0.01, ""}).find("1 %: 2 bands"), std::string::npos);
  EXPECT_NE(make_band_plot(make_errors(), {"title", "max", 0.01, ""}).find("1 %: 3 bands"), std::string::npos);
  BandErrors errors = make_errors();
  errors.bands.back().rms = 1;
  EXPECT_NE(make_band_plot(errors, {"title", "rms", 0.01, ""}).find("1 %: not reached"), std::string::npos);
}

TEST(BandPlot, EscapesTitles) {
  const std::string svg = make_band_plot(make_errors(), {"fn:max(0, z<1 & x>0)", "rms", 0.01, ""});
  EXPECT_NE(svg.find("fn:max(0, z&lt;1 &amp; x&gt;0)"), std::string::npos);
}

// An error of nothing has no logarithm; it lies at the lower end, and so does all of a light that is one band.
TEST(BandPlot, DrawsZeros) {
  BandErrors errors = make_errors();
  errors.bands[3].rms = 0;
  const std::string svg = make_band_plot(errors, {"title", "rms", 0.01, ""});
  EXPECT_EQ(svg.find("inf"), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  for (BandError& error : errors.bands) {
    const int n = error.bands;
    error = BandError();
    error.bands = n;
  }
  EXPECT_EQ(make_band_plot(errors, {"title", "rms", 0.01, ""}).find("nan"), std::string::npos);
}

TEST(BandPlot, ShowsErrorsWithAWindow) {
  BandErrors errors = make_errors();
  errors.shaped = errors.bands;
  const std::string svg = make_band_plot(errors, {"title", "rms", 0.01, "window hann:6"});
  EXPECT_EQ(heights_of(svg, "curve max windowed"), heights_of(svg, "curve max"));
  EXPECT_NE(svg.find("window hann:6"), std::string::npos);
}

}  // namespace
}  // namespace shlight
