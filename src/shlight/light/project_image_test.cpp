#include "shlight/light/project_image.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>
#include <vector>

#include "shlight/image/pixels.h"
#include "shlight/light/light.h"
#include "shlight/sh/basis.h"
#include "shlight/sh/minimum.h"
#include "shlight/sh/window.h"
#include "shlight/sh/zonal.h"

namespace shlight {
namespace {

using std::numbers::pi;

// A picture without any symmetry, with a sun in it.
Environment some_environment(Layout layout, int width, int height) {
  Environment environment{Image(width, height), layout};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double u = (x + 0.5) / width, v = (y + 0.5) / height;
      environment.image.set_rgb(x, y, {1 + std::sin(7 * u + 3 * v), u * u + v, std::abs(std::cos(9 * v * u)) - 0.2});
    }
  environment.image.set_rgb(width / 3, height / 3, {900, 700, 500});
  return environment;
}

double largest(Rgb c) {
  return std::max({std::abs(c.r), std::abs(c.g), std::abs(c.b)});
}

void expect_near(const RgbCoefficients& a, const RgbCoefficients& b, double tolerance) {
  ASSERT_EQ(a.bands(), b.bands());
  for (std::size_t i = 0; i < a.size(); ++i)
    EXPECT_LE(largest(a[i] - b[i]), tolerance * largest(b[0]))
        << "coefficient " << i << ": " << a[i].r << " and " << b[i].r;
}

// Float moments carry 6e-8 a term; what is left of it after a row is far below this, as a share of L00.
constexpr double kFloatSums = 1e-6;

TEST(ProjectImage, SeparableEqualsPixelByPixel) {
  // Even and odd, folded and not, wider than a tile of float sums, narrower than a lane.
  for (const auto& [width, height] : {std::pair{64, 32}, {2, 1}, {1, 1}, {33, 17}, {38, 20}, {5, 40}, {2306, 24}})
    for (const int bands : {1, 2, 3, 4, 5, 8, 11}) {
      const Environment environment = some_environment(Layout::kLatLong, width, height);
      SCOPED_TRACE(testing::Message() << width << " x " << height << ", " << bands << " bands");
      expect_near(project_image(environment, bands), project_image_by_pixels(environment, bands), kFloatSums);
    }
}

TEST(ProjectImage, EveryLayoutEqualsPixelByPixel) {
  for (const Layout layout : all_layouts())
    for (const int bands : {1, 4, 9}) {
      const PictureSize size = picture_size(layout, size_from_horizon(layout, 60));
      const Environment environment = some_environment(layout, size.width, size.height);
      SCOPED_TRACE(testing::Message() << layout_name(layout) << ", " << bands << " bands");
      expect_near(project_image(environment, bands), project_image_by_pixels(environment, bands), kFloatSums);
    }
}

TEST(ProjectImage, ConstantRadianceIsOneCoefficient) {
  for (const Layout layout : all_layouts()) {
    const auto [width, height] = picture_size(layout, size_from_horizon(layout, 192));
    Environment environment{Image(width, height), layout};
    for (float& value : environment.image.values) value = 1;
    const RgbCoefficients c = project_image(environment, 10);
    EXPECT_NEAR(c[0].r, std::sqrt(4 * pi), 1e-6);
    for (std::size_t i = 1; i < c.size(); ++i) EXPECT_NEAR(c[i].r, 0, 1e-6) << layout_name(layout) << " " << i;
  }
}

// A single bright pixel is nearly a delta light: a flipped axis or a shift by half a pixel shows at once.
TEST(ProjectImage, ABrightPixelComesFromItsDirection) {
  for (const Layout layout : all_layouts()) {
    const PictureSize size = picture_size(layout, size_from_horizon(layout, 512));
    for (const ImagePoint seen : {ImagePoint{0.4, 0.25}, {0.66, 0.7}, {0.5, 0.45}, {0.9, 0.5}}) {
      const Pixel pixel = pixel_at(layout, size, point_of(layout, *direction_at(Layout::kLatLong, seen)));
      Environment environment{Image(size.width, size.height), layout};
      environment.image.set_rgb(pixel.x, pixel.y, {1 / pixel_solid_angle(layout, size, pixel), 0, 0});
      RgbCoefficients delta(6);
      add_delta(*direction_at(layout, pixel_centre(layout, size, pixel)), {1, 0, 0}, delta);
      const RgbCoefficients c = project_image(environment, 6);
      // A pixel has a size: degree l loses about l(l+1)/4 of its squared radius. Toward the rim of a mirror ball pixels
      // become long, and their middle is not that of their directions.
      const double tolerance = layout == Layout::kMirrorBall ? 0.05 : 2e-3;
      for (std::size_t i = 0; i < c.size(); ++i)
        EXPECT_NEAR(c[i].r, delta[i].r, tolerance) << layout_name(layout) << " " << i << " " << seen.u;
    }
  }
}

// The coefficients by brute force: each pixel cut into pieces x pieces quadrilaterals, each of those into two spherical
// triangles with the radiance times the basis at the middles of their sides. Knows direction_at, and no weights.
RgbCoefficients project_by_triangles(const Environment& environment, int bands, int pieces) {
  const auto solid_angle = [](Vec3d a, Vec3d b, Vec3d c) {
    return 2 * std::atan2(std::abs(dot(a, cross(b, c))), 1 + dot(a, b) + dot(b, c) + dot(c, a));
  };
  RgbCoefficients sum(bands);
  const auto add_triangle = [&](Vec3d a, Vec3d b, Vec3d c, Rgb radiance) {
    const double weight = solid_angle(a, b, c) / 3;
    for (const Vec3d& side : {a + b, b + c, c + a})
      if (weight > 0) add_delta(1 / std::sqrt(dot(side, side)) * side, weight * radiance, sum);
  };
  const auto [columns, rows] = face_grid(environment.layout);
  const auto& image = environment.image;
  const auto border = [&](int pixel, int pixels, int faces, double piece) {
    const int n = pixels / faces, face = pixel / n;
    const double i = pixel % n;
    const double from = centres_on_border(environment.layout) ? std::max(0.0, i - 0.5) / (n - 1) : i / n;
    const double to = centres_on_border(environment.layout) ? std::min(n - 1.0, i + 0.5) / (n - 1) : (i + 1) / n;
    // A hair inside: a face's edge would be its neighbour's in the picture.
    return (face + std::clamp(from + piece * (to - from), 1e-13, 1 - 1e-13)) / faces;
  };
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int i = 0; i < pieces; ++i)
        for (int j = 0; j < pieces; ++j) {
          const auto corner = [&](int right, int down) {
            return direction_at(environment.layout, {border(x, image.width, columns, double(j + right) / pieces),
                                                     border(y, image.height, rows, double(i + down) / pieces)});
          };
          const auto a = corner(0, 0), b = corner(1, 0), c = corner(0, 1), d = corner(1, 1);
          if (!a || !b || !c || !d) continue;
          // Cut the way of the octahedron's creases.
          const bool rising = (2 * x >= image.width) != (2 * y >= image.height);
          add_triangle(*a, *b, rising ? *d : *c, image.rgb(x, y));
          add_triangle(rising ? *a : *b, *c, *d, image.rgb(x, y));
        }
  return sum;
}

TEST(ProjectImage, EveryLayoutEqualsBruteForce) {
  constexpr int kBands = 4;
  for (const Layout layout : all_layouts()) {
    const PictureSize size = picture_size(layout, size_from_horizon(layout, 48));
    Environment environment = some_environment(layout, size.width, size.height);
    // Discs but for the pixels at their edge, which quadrilaterals do not fill.
    if (layout == Layout::kAngularMap || layout == Layout::kMirrorBall)
      for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
          if (std::hypot(2 * x + 1 - size.width, 2 * y + 1 - size.height) > 0.9 * size.width)
            environment.image.set_rgb(x, y, {});
    // The error falls with the square of the pieces: what is left of it is taken off.
    const RgbCoefficients coarse = project_by_triangles(environment, kBands, 6);
    RgbCoefficients fine = project_by_triangles(environment, kBands, 12);
    for (std::size_t i = 0; i < fine.size(); ++i) fine[i] += 1.0 / 3 * (fine[i] - coarse[i]);
    SCOPED_TRACE(layout_name(layout));
    expect_near(project_image(environment, kBands), fine, 1e-6);
  }
}

// Discs to their very edge: lookups in the directions of a fixed grid, which knows nothing of pixels.
TEST(ProjectImage, DiscsEqualLookups) {
  for (const Layout layout : {Layout::kAngularMap, Layout::kMirrorBall}) {
    Environment environment = some_environment(layout, 48, 48);
    environment.image.set_rgb(16, 16, {1, 1, 1});
    const RgbCoefficients c = project_image(environment, 4);
    RgbCoefficients sum(4);
    constexpr int kRows = 700;
    for (int i = 0; i < kRows; ++i)
      for (int j = 0; j < 2 * kRows; ++j) {
        const double y = (2 * i + 1.0) / kRows - 1, phi = pi * (j + 0.5) / kRows, s = std::sqrt(1 - y * y);
        const Vec3d d = {s * std::cos(phi), y, s * std::sin(phi)};
        add_delta(d, 4 * pi / (2.0 * kRows * kRows) * eval_nearest(environment, d), sum);
      }
    SCOPED_TRACE(layout_name(layout));
    expect_near(c, sum, 1e-4);  // what the edges of pixels cost a grid
  }
}

TEST(ProjectImage, SameBitsForAnyNumberOfThreads) {
  for (const Layout layout : all_layouts()) {
    const auto [width, height] = picture_size(layout, size_from_horizon(layout, 150));
    const Environment environment = some_environment(layout, width, height);
    const RgbCoefficients one = project_image(environment, 5, 1);
    EXPECT_EQ(project_image(environment, 5, 2), one);
    EXPECT_EQ(project_image(environment, 5, 0), one);
  }
}

// The same picture with every pixel made of 8 x 8: sums over 64 times as many pixels end in the same numbers.
TEST(ProjectImage, SumsDoNotDegradeAt4096x2048) {
  const Environment small = some_environment(Layout::kLatLong, 512, 256);
  Environment large{Image(4096, 2048), Layout::kLatLong};
  for (int y = 0; y < 2048; ++y)
    for (int x = 0; x < 4096; ++x) large.image.set_rgb(x, y, small.image.rgb(x / 8, y / 8));
  expect_near(project_image(large, 5), project_image(small, 5), kFloatSums);
}

TEST(ProjectImage, MoreBandsDoNotChangeTheFirst) {
  const Environment environment = some_environment(Layout::kLatLong, 256, 128);
  const RgbCoefficients many = project_image(environment, 40);
  expect_near(resize_bands(many, 5), project_image(environment, 5), 1e-9);
}

// Against the coefficients made for the real lights by 2 x 2 Gauss points a pixel in double precision.
class References : public testing::Test {
 protected:
  void SetUp() override {
    const char* data = std::getenv("SHLIGHT_TEST_DATA");
    if (!data) GTEST_SKIP() << "SHLIGHT_TEST_DATA names no folder";
    for (const char* name : {"blender_city.exr", "blender_night.exr", "blender_studio.exr", "polyhaven_1k_city.hdr",
                             "polyhaven_1k_studio.hdr", "polyhaven_1k_sunset.hdr", "polyhaven_1k_venice.hdr"}) {
      const std::filesystem::path folder = data;
      files.push_back(folder / "lights" / name);
      std::ifstream file(folder / "references" / std::filesystem::path(name).replace_extension(".json"));
      references.push_back(nlohmann::json::parse(file));
    }
  }
  static Rgb rgb(const nlohmann::json& entry) { return {entry[0], entry[1], entry[2]}; }
  static Vec3d vec(const nlohmann::json& entry) { return {entry[0], entry[1], entry[2]}; }

  std::vector<std::filesystem::path> files;
  std::vector<nlohmann::json> references;
};

TEST_F(References, CoefficientsOfTheSevenLatLongLights) {
  for (std::size_t k = 0; k < files.size(); ++k) {
    const auto light = load_light(files[k].string());
    const RgbCoefficients c = light.light->project(10);
    RgbCoefficients expected(10);
    for (std::size_t i = 0; i < 100; ++i) expected[i] = rgb(references[k]["coefs"][i]);
    double worst = 0;
    for (std::size_t i = 0; i < 100; ++i) worst = std::max(worst, largest(c[i] - expected[i]) / largest(expected[0]));
    // A hundred times tighter than what tells right from wrong.
    EXPECT_LT(worst, 1e-6) << files[k];
    std::ostringstream text;
    text << worst;
    RecordProperty(files[k].stem().string(), text.str());
    EXPECT_EQ(light.info.pixels.nan + light.info.pixels.inf, references[k]["nonfinite"].get<std::uint64_t>());
  }
}

// OpenEXR's own maps, in its own frame: one scene as a lat-long map and as a cube.
TEST_F(References, OpenExrEnvironmentMaps) {
  const std::filesystem::path folder = std::getenv("SHLIGHT_TEST_DATA");
  const auto rgb_coefficients = [](const nlohmann::json& reference) {
    RgbCoefficients c(10);
    for (std::size_t i = 0; i < 100; ++i) c[i] = rgb(reference["coefs"][i]);
    return c;
  };
  for (const auto& [name, agreement] : {std::pair{"Orientation", 1e-3}, {"WavyLines", 3e-4}}) {
    std::vector<RgbCoefficients> both;
    for (const auto& [kind, layout] : {std::pair{"LatLong", Layout::kOpenExrLatLong}, {"Cube", Layout::kOpenExrCube}}) {
      const std::string stem = std::string(name) + kind;
      const auto light = load_light((folder / "lights" / (stem + ".exr")).string());
      EXPECT_EQ(light.info.layout, layout);
      both.push_back(light.light->project(10));
      std::ifstream file(folder / "references" / (stem + ".json"));
      SCOPED_TRACE(stem);
      expect_near(both.back(), rgb_coefficients(nlohmann::json::parse(file)), agreement);
    }
    expect_near(both[0], both[1], agreement);
  }
}

// One real light in every other layout, through convert-map's resampling.
TEST_F(References, OneRealLightInEveryLayout) {
  {
    const auto path = files[5];
    const auto light = load_light(path.string()).light;
    const RgbCoefficients expected = light->project(5);
    for (const Layout layout : all_layouts()) {
      const Environment other = {light->picture({layout, size_from_horizon(layout, 1024)}, {}), layout};
      SCOPED_TRACE(testing::Message() << path << " as " << layout_name(layout));
      expect_near(project_image(other, 5), expected, 2e-3);
    }
  }
}

TEST_F(References, NineCoefficientIrradianceAndItsError) {
  for (std::size_t k = 0; k < files.size(); ++k) {
    const nlohmann::json& reference = references[k];
    const RgbCoefficients radiance = load_light(files[k].string()).light->project(3);
    const RgbCoefficients irradiance = irradiance_from_radiance(radiance);
    double largest_irradiance = 0, worst = 0;
    Rgb sum_of_errors, maxima;
    for (std::size_t j = 0; j < reference["irradiance"].size(); ++j) {
      const Vec3d n = vec(reference["irradiance_at"][j]);
      const Rgb exact = rgb(reference["irradiance"][j]), polynomial = eval_irradiance_polynomial(radiance, n);
      worst = std::max(worst, largest(polynomial - reconstruct(irradiance, n)));
      largest_irradiance = std::max(largest_irradiance, largest(exact));
      const Rgb error = polynomial - exact;
      sum_of_errors += {std::abs(error.r), std::abs(error.g), std::abs(error.b)};
      maxima = {std::max(maxima.r, exact.r), std::max(maxima.g, exact.g), std::max(maxima.b, exact.b)};
    }
    EXPECT_LT(worst, 1e-5 * largest_irradiance);
    // The references' normalisation: each channel over its own maximum, then the mean of the three.
    const double count = double(reference["irradiance"].size());
    const double mean_error =
        (sum_of_errors.r / maxima.r + sum_of_errors.g / maxima.g + sum_of_errors.b / maxima.b) / (3 * count);
    const double expected = reference["errors"]["9"]["mean_abs_over_maxE"];
    EXPECT_NEAR(mean_error, expected, 1e-4 * expected) << files[k];
  }
}

// Proved non-negative, and no smoother than needed: with 2 % less a negative value can be shown.
TEST_F(References, AutomaticWindowsOfRealLights) {
  // A value that the irradiance has somewhere, as near to its minimum as the search comes.
  const auto smallest = [](const RgbCoefficients& radiance) {
    const RgbCoefficients irradiance = irradiance_from_radiance(radiance);
    double value = std::numeric_limits<double>::infinity();
    for (const auto channel : {&Rgb::r, &Rgb::g, &Rgb::b}) {
      std::vector<double> values;
      for (const Rgb c : irradiance.values()) values.push_back(c.*channel);
      value = std::min(value, find_minimum(values, radiance.bands()).value);
    }
    return value;
  };
  int windowed = 0;
  for (const auto& file : files) {
    const RgbCoefficients all = load_light(file.string()).light->project(8);
    for (const int bands : {3, 5, 8}) {
      const RgbCoefficients radiance = resize_bands(all, bands);
      const AutoWindow result = make_auto_window(Window::kLaplacian, Positive::kIrradiance, radiance);
      EXPECT_GE(result.lower_bound, 0) << file;
      EXPECT_GE(smallest(result.coefficients), result.lower_bound) << file;
      if (result.strength == 0) continue;
      EXPECT_LT(smallest(apply_window(Window::kLaplacian, 0.98 * result.strength, radiance)), 0) << file;
      ++windowed;
    }
  }
  EXPECT_GT(windowed, 0);
}

}  // namespace
}  // namespace shlight
