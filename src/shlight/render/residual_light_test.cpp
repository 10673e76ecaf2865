#include "shlight/render/residual_light.h"

#include <gtest/gtest.h>

#include <cmath>

#include "shlight/brdf/make_brdf.h"
#include "shlight/light/builtin_light.h"
#include "shlight/render/render_test_util.h"

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
