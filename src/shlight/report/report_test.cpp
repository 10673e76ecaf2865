#include "shlight/report/report.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <numbers>

#include "shlight/core/error.h"
#include "shlight/core/temporary_folder.h"
#include "shlight/report/basis_figures.h"
#include "shlight/report/line_plot.h"
#include "shlight/report/picture.h"

namespace shlight {
namespace {

// Whoever stops a report gets the page of what is finished.
TEST(Report, StopsWithItsPage) {
  const TemporaryFolder folder;
  int calls = 0;
  const ReportWatcher stop = [&](const std::string&, double) { return ++calls, false; };
  EXPECT_THROW(reproduce_thesis(folder / "report", {}, stop), Cancelled);
  EXPECT_EQ(calls, 1) << "stopped once";
  std::ifstream page(folder / "report" / "thesis.html");
  const std::string html(std::istreambuf_iterator<char>(page), {});
  EXPECT_NE(html.find("This report is not complete."), std::string::npos);
  EXPECT_NE(html.find("Table 2: classic transfer is missing."), std::string::npos);
  EXPECT_TRUE(html.ends_with("</html>\n"));
}

TEST(Report, NeedsAFolder) {
  const TemporaryFolder folder;
  std::ofstream(folder / "file") << "taken";
  EXPECT_THROW(reproduce_thesis(folder / "file", {}), Error);
}

// By hand: differences 0.5 and 0 in the three channels of two pixels, noise 0.01 in each: √((3·0.25 − 6·0.01)/(3·(2.25
// + 4) − 6·0.01)).
TEST(Report, ErrorsAreWithoutTheReferencesNoise) {
  Image test(2, 1), truth(2, 1), variance(2, 1);
  test.set_rgb(0, 0, {1, 1, 1}), test.set_rgb(1, 0, {2, 2, 2});
  truth.set_rgb(0, 0, {1.5, 1.5, 1.5}), truth.set_rgb(1, 0, {2, 2, 2});
  for (float& v : variance.values) v = 0.01f;
  EXPECT_NEAR(measure_picture(test, {truth, variance, 0}).value, std::sqrt(0.69 / 18.69), 1e-6);
  EXPECT_NEAR(measure_difference({test, variance, 0}, {truth, variance, 0}).value, std::sqrt(0.63 / 18.63), 1e-6);
  EXPECT_EQ(to_text(measure_picture(test, {truth, variance, 0})), "19 %");
  const PictureError none = measure_picture(truth, {truth, variance, 0});
  EXPECT_EQ(none.value, 0) << "noise alone is no error";
  // Two deviations of a sum of six squares: 2 √(6 · 2 · 0.01²).
  EXPECT_NEAR(none.resolution, std::sqrt(2 * std::sqrt(12e-4) / 18.69), 1e-6);
  EXPECT_EQ(to_text(none), "below 6.1 %");
}

TEST(Report, BlocksAreAveraged) {
  Image image(4, 2);
  for (int x = 0; x < 4; ++x)
    for (int y = 0; y < 2; ++y) image.set_rgb(x, y, {double(x), double(y), 1});
  const Image small = average_blocks(image, 2);
  ASSERT_EQ(small.width, 2);
  ASSERT_EQ(small.height, 1);
  EXPECT_EQ(small.rgb(0, 0), (Rgb{0.5, 0.5, 1}));
  EXPECT_EQ(small.rgb(1, 0), (Rgb{2.5, 0.5, 1}));
}

// As the thesis's recursion has them, phase and all.
TEST(BasisFigures, LegendrePolynomialsAreThoseOfTheThesis) {
  for (const double x : {-1.0, -0.4, 0.0, 0.3, 1.0}) {
    const double s = std::sqrt(1 - x * x);
    EXPECT_NEAR(eval_associated_legendre(0, 0, x), 1, 1e-14);
    EXPECT_NEAR(eval_associated_legendre(1, 0, x), x, 1e-14);
    EXPECT_NEAR(eval_associated_legendre(1, 1, x), -s, 1e-14);
    EXPECT_NEAR(eval_associated_legendre(2, 0, x), (3 * x * x - 1) / 2, 1e-14);
    EXPECT_NEAR(eval_associated_legendre(2, 1, x), -3 * x * s, 1e-14);
    EXPECT_NEAR(eval_associated_legendre(2, 2, x), 3 * s * s, 1e-14);
  }
}

// Y_10 is two balls on the z axis, one above the other: |p − z/2| = 1/2 above, scaled to the radius.
TEST(BasisFigures, BalloonOfDegreeOneIsTwoBalls) {
  const Mesh balloon = make_balloon(1, 0, 1);
  double furthest = 0;
  for (std::size_t i = 0; i < balloon.positions.size(); ++i) {
    const Vec3d p = vec_cast<double>(balloon.positions[i]), center = {0, 0, p.z >= 0 ? 0.5 : -0.5};
    const double radius = std::sqrt(dot(p - center, p - center));
    // The furthest vertex is a step of the mesh away from the axis.
    EXPECT_NEAR(radius, 0.5, 2e-3);
    furthest = std::max(furthest, std::sqrt(dot(p, p)));
    if (dot(p, p) > 0.01) {
      EXPECT_GT(dot(vec_cast<double>(balloon.normals[i]), p - center), 0.49) << "points outward";
    }
  }
  EXPECT_NEAR(furthest, 1, 1e-6);
}

// Of one band, Σ Y_0² is N/4π whatever the samples; the grid beats chance on three.
TEST(BasisFigures, StratifiedSamplesAreMoreOrthonormal) {
  EXPECT_LT(orthonormality_error(make_independent_samples(1, 50)), 1e-12);
  EXPECT_LT(3 * orthonormality_error(make_sphere_samples(3, 30, 1)),
            orthonormality_error(make_independent_samples(3, 900)));
}

TEST(LinePlot, AxesHaveTheirTicks) {
  const PlotAxis axis = make_axis(-1, 1, 0.5, "x");
  ASSERT_EQ(axis.ticks.size(), 5u);
  EXPECT_EQ(axis.ticks.front().second, "-1");
  EXPECT_EQ(axis.ticks[2].second, "0");
  EXPECT_EQ(axis.ticks.back().second, "1");
}

TEST(LinePlot, HigherIsHigher) {
  const std::string svg = make_line_plot(make_axis(0, 1, 1, "x"), make_axis(0, 1, 1, "y"),
                                         {{"a < b", {{0, 0.25}, {1, 0.75}}, true, false}});
  const auto path = svg.find("class=\"curve c0\"");
  ASSERT_NE(path, std::string::npos);
  double x1 = 0, y1 = 0, x2 = 0, y2 = 0;
  ASSERT_EQ(std::sscanf(svg.c_str() + svg.rfind("d=\"", path), "d=\"M%lf %lfL%lf %lf", &x1, &y1, &x2, &y2), 4);
  EXPECT_LT(x1, x2);
  EXPECT_GT(y1, y2) << "larger values are higher on the page";
  EXPECT_NE(svg.find("a &lt; b"), std::string::npos);
}

}  // namespace
}  // namespace shlight
