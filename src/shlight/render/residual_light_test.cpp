#include "shlight/render/residual_light.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "shlight/brdf/make_brdf.h"
#include "shlight/light/builtin_light.h"
#include "shlight/render/highlight_light.h"
#include "shlight/render/render_test_util.h"
#include "shlight/sh/window.h"

namespace shlight {
namespace {

constexpr int kBands = 5;

struct StudioLight {
  StudioLight()
      : light(make_builtin_light("studio")), picture(light->lat_long(512)), coefficients(light->project(kBands)) {}
  std::unique_ptr<Light> light;
  Image picture;
  RgbCoefficients coefficients;
};

TEST(ResidualLight, AndReconstructionAreTheLight) {
  const StudioLight studio;
  const ResidualLight residual(studio.picture, studio.coefficients);
  const Environment picture = {studio.picture, Layout::kLatLong};
  double largest = 0, sum = 0;
  constexpr int kCount = 2000;
  for (int i = 0; i < kCount; ++i) {
    const Vec3d d = spiral_direction(i, kCount);
    const double expected = eval_bilinear(picture, d).g;
    const double both = residual.eval(d, 0).g + reconstruct(studio.coefficients, d).g;
    largest = std::max(largest, expected);
    sum += std::abs(both - expected);
  }
  // At the edges of lamps a pixel of one picture is part of two of the other.
  EXPECT_LT(sum / kCount, 5e-3 * largest);
}

TEST(ResidualLight, CoarseLevelsAreMeansOfFineOnes) {
  const StudioLight studio;
  const ResidualLight residual(studio.picture, studio.coefficients);
  // The mean of all is what the first bands already have: near nothing is left.
  Rgb mean;
  double size = 0;
  for (int i = 0; i < 500; ++i) {
    mean += 1.0 / 500 * residual.eval(spiral_direction(i, 500), 3);
    size += std::abs(residual.eval(spiral_direction(i, 500), 0).g) / 500;
  }
  EXPECT_LT(std::abs(mean.g), 0.05 * size);
}

TEST(SlimLobe, SamplesAreAKernelAroundTheNormal) {
  for (const char* material : {"ggx:alpha=0.2,f0=0.5", "ward-aniso:sx=0.1,sy=0.4", "blinn-phong"}) {
    const auto brdf = make_brdf(material);
    const auto slim = make_slim_lobes(*brdf);
    ASSERT_TRUE(slim) << material;
    Vec3d mean;
    double sum = 0;
    const LobeFromAbove lobe = sample_lobe_from_above(*slim, 256);
    for (const LobeSample& sample : lobe.samples) {
      EXPECT_NEAR(dot(sample.direction, sample.direction), 1, 1e-9);
      EXPECT_GT(sample.weight, 0);
      sum += sample.weight;
      mean = mean + sample.weight * sample.direction;
    }
    const bool anisotropic = brdf->traits().symmetry != BrdfSymmetry::kIsotropic;
    ASSERT_EQ(lobe.slopes.size(), anisotropic ? kLobeTaps : 1u) << material;
    for (std::size_t k = 0; k < lobe.slopes.size(); ++k)
      EXPECT_NEAR(lobe.slopes[k], -lobe.slopes[lobe.slopes.size() - 1 - k], 0.05) << material;
    EXPECT_NEAR(sum, 1, 1e-9) << material;
    EXPECT_NEAR(mean.x, 0, 0.02) << material;
    EXPECT_NEAR(mean.y, 0, 0.02) << material;
  }
  EXPECT_FALSE(make_slim_lobes(*make_brdf("lambert")));
  EXPECT_FALSE(make_slim_lobes(*make_brdf("oren-nayar")));
}

TEST(PrefilterCube, SamplesAndSumsOverAllPixelsAgree) {
  const StudioLight studio;
  const ResidualLight residual(studio.picture, studio.coefficients);
  const auto brdf = make_brdf("ggx:alpha=0.1,f0=1");
  const LobeFromAbove lobe = sample_lobe_from_above(*brdf, 256);
  const CubeFaces summed = prefilter_cube(residual, lobe, 32), sampled = prefilter_cube(residual, lobe, 128);
  double largest = 0, error = 0;
  for (std::size_t face = 0; face < 6; ++face)
    for (int y = 0; y < 32; ++y)
      for (int x = 0; x < 32; ++x) {
        // The four pixels around the same point.
        Rgb mean;
        for (const int dy : {1, 2})
          for (const int dx : {1, 2}) mean += 0.25 * sampled[face].rgb(4 * x + dx, 4 * y + dy);
        largest = std::max(largest, std::abs(mean.g));
        error += std::abs(mean.g - summed[face].rgb(x, y).g) / (6 * 32 * 32);
      }
  // Pixels of 1.4° in the one and of 0.7° in the other.
  EXPECT_LT(error, 0.01 * largest);
}

// From mirrors to wide lobes the sun goes from the cube maps to a directional light; nothing of it is lost on the way.
TEST(HighlightLight, SunAndCubesHaveTheSameFlux) {
  const auto sky = make_builtin_light("sky");
  const RenderLight light = {sky->project(kBands), sky->lat_long(1024)};
  std::vector<double> shares, fluxes;
  for (const double alpha : {0.01, 0.03, 0.1, 0.3, 0.5}) {
    const auto brdf = make_brdf("ggx:f0=1,alpha=" + std::to_string(alpha));
    const auto slim = make_slim_lobes(*brdf);
    SurfaceReflectance surface;
    surface.highlight.emplace().lobe = sample_lobe_from_above(*slim, 16);
    const HighlightLight highlights = make_highlight_light(std::vector{surface}, light, kBands);
    ASSERT_TRUE(highlights.sun);
    const auto& [cube, share] = highlights.surfaces[0];
    const int size = cube[0].width;
    const double in_bands = light.coefficients[0].g - share * highlights.sun_coefficients[0].g;
    double flux = share * highlights.sun->irradiance.g + std::sqrt(4 * std::numbers::pi) * in_bands;
    for (const Image& face : cube)
      for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
          const double a = (2 * x + 1.0) / size - 1, b = (2 * y + 1.0) / size - 1;
          flux += face.rgb(x, y).g * 4 / (size * size * std::pow(1 + a * a + b * b, 1.5));
        }
    shares.push_back(share);
    fluxes.push_back(flux);
  }
  for (const std::size_t none : {0u, 4u}) EXPECT_EQ(shares[none], 0);
  for (const std::size_t some : {1u, 3u}) EXPECT_TRUE(shares[some] > 0.1 && shares[some] < 0.9) << shares[some];
  EXPECT_EQ(shares[2], 1);
  const double all = std::sqrt(4 * std::numbers::pi) * light.coefficients[0].g;
  for (const double flux : fluxes) EXPECT_NEAR(flux, all, 0.01 * all);
}

TEST(HighlightLight, TheSunIsWindowedAsItsLightIs) {
  const auto sky = make_builtin_light("sky");
  const RgbCoefficients raw = sky->project(kBands);
  const RenderLight light = {apply_window(Window::kHann, 1.0 / kBands, raw), sky->lat_long(1024)};
  const HighlightLight highlights = make_highlight_light({}, light, kBands);
  ASSERT_TRUE(highlights.sun);
  RgbCoefficients expected(kBands);
  add_sun(*highlights.sun, expected);
  expected = apply_window(Window::kHann, 1.0 / kBands, expected);
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_NEAR(highlights.sun_coefficients[i].g, expected[i].g, 5e-3 * expected[0].g) << i;
}

TEST(SlimLobe, SlopesHaveADensity) {
  for (const char* material : {"ggx:alpha=0.2,f0=1", "cook-torrance:m=0.2,f0=1", "ggx-aniso:ax=0.3,ay=0.1,f0=1"}) {
    const auto brdf = make_brdf(material);
    const LobeFromAbove lobe = sample_lobe_from_above(*brdf, 64);
    ASSERT_EQ(lobe.slope_density.size(), kDensitySteps + 1u);
    const bool ggx = std::string(material).starts_with("ggx");
    const double along = lobe.wide_along_x ? 0.3 : 0.2, across = lobe.wide_along_x ? 0.1 : 0.2;
    for (const double r : {0.0, 0.1, 0.3}) {
      const auto i = static_cast<std::size_t>(std::lround(kDensitySteps * r / (r + lobe.width)));
      const double x = static_cast<double>(i) / kDensitySteps, slope = lobe.width * x / (1 - x);
      const double q = std::pow(slope / across, 2);
      const double expected = ggx ? 1 / (std::numbers::pi * along * across * std::pow(1 + q, 2))
                                  : std::exp(-q) / (std::numbers::pi * along * across);
      // The light's lobe has masking and Fresnel's term as well.
      EXPECT_NEAR(lobe.slope_density[i], expected, 0.07 * lobe.slope_density[0]) << material << " at " << slope;
    }
  }
}

TEST(PrefilterCube, FacesAreOpenGls) {
  // A light that is its direction: each face's middle is its axis, its first row and column the table's.
  Image picture(256, 128);
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const Vec3d d = *direction_at(Layout::kLatLong, {(x + 0.5) / picture.width, (y + 0.5) / picture.height});
      picture.set_rgb(x, y, {d.x, d.y, d.z});
    }
  const ResidualLight residual(picture, RgbCoefficients(1));
  LobeFromAbove narrow;  // about 6°
  for (int i = 0; i <= 100; ++i) narrow.profile.push_back(i <= 8 ? 1.0f : 0.0f);
  const CubeFaces faces = prefilter_cube(residual, narrow, 8);
  const Vec3d axes[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  const Vec3d right[] = {{0, 0, -1}, {0, 0, 1}, {1, 0, 0}, {1, 0, 0}, {1, 0, 0}, {-1, 0, 0}};
  const Vec3d down[] = {{0, -1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}, {0, -1, 0}, {0, -1, 0}};
  for (std::size_t face = 0; face < 6; ++face)
    for (const auto& [x, y] : {std::pair{0, 0}, {7, 0}, {3, 6}}) {
      const double a = (2 * x + 1) / 8.0 - 1, b = (2 * y + 1) / 8.0 - 1;
      const Vec3d d = axes[face] + a * right[face] + b * down[face], n = (1 / std::sqrt(dot(d, d))) * d;
      const Rgb c = faces[face].rgb(x, y);
      EXPECT_NEAR(c.r, n.x, 0.01) << face;
      EXPECT_NEAR(c.g, n.y, 0.01) << face;
      EXPECT_NEAR(c.b, n.z, 0.01) << face;
    }
}

}  // namespace
}  // namespace shlight
