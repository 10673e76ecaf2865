#include "shlight/truth/light_sampler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "shlight/light/builtin_light.h"
#include "shlight/truth/truth_test_util.h"

namespace shlight {
namespace {

// Cumulative probabilities are floats.
constexpr double kCdfTolerance = 1e-3;

ImageLight dotted_light() {
  Image image(16, 8);
  image.set_rgb(3, 2, {1, 2, 3});
  image.set_rgb(4, 2, {1, 1, 1});
  image.set_rgb(15, 7, {0, 0, 5});
  image.set_rgb(9, 0, {-1, 0, 0});
  return ImageLight({image, Layout::kLatLong});
}

TEST(LightSampler, DensityIsTheBrightnessOfPixels) {
  const ImageLight light = dotted_light();
  const LightSampler sampler(light);
  // Only what is bright is drawn, and where it is drawn brightness over density is the integral of the brightness.
  double integral = 0;
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 16; ++x) {
      const Rgb c = light.environment().image.rgb(x, y);
      integral +=
          (std::abs(c.r) + std::abs(c.g) + std::abs(c.b)) / 3 * pixel_solid_angle(Layout::kLatLong, {16, 8}, {x, y});
    }
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const auto sample = sampler.sample(noise(1, i), noise(2, i));
    const Rgb c = light.radiance(sample.direction);
    const double brightness = (std::abs(c.r) + std::abs(c.g) + std::abs(c.b)) / 3;
    ASSERT_GT(brightness, 0) << i;
    EXPECT_NEAR(brightness / sample.pdf, integral, kCdfTolerance * integral) << i;
    EXPECT_NEAR(dot(sample.direction, sample.direction), 1, 1e-12);
    EXPECT_NEAR(sampler.pdf(sample.direction), sample.pdf, 1e-9 * sample.pdf);
  }
}

TEST(LightSampler, DensityIntegratesToOne) {
  for (const char* name : {"builtin:sky", "builtin:studio", "builtin:axes"}) {
    const auto light = load_light(name).light;
    const LightSampler sampler(*light);
    constexpr int kWidth = 1024, kHeight = 512;
    double integral = 0;
    const auto pdf_at = [&](double x, double height) {
      const double azimuth = 2 * std::numbers::pi * (x / kWidth - 0.5), radius = std::sqrt(1 - height * height);
      return sampler.pdf({radius * std::sin(azimuth), height, -radius * std::cos(azimuth)});
    };
    for (int y = 0; y < kHeight; ++y) {
      const double top = std::cos(std::numbers::pi * y / kHeight),
                   bottom = std::cos(std::numbers::pi * (y + 1) / kHeight);
      const double solid_angle = 2 * std::numbers::pi / kWidth * (top - bottom);
      for (int x = 0; x < kWidth; ++x) {
        // Bright pixels are parted: 32 x 32 parts, each as much of the height.
        const double middle = pdf_at(x + 0.5, 0.5 * (top + bottom));
        constexpr int kParts = 32;
        double sum = 0;
        const bool is_parted =
            std::max({middle, pdf_at(x + 0.1, std::lerp(top, bottom, 0.1)),
                      pdf_at(x + 0.9, std::lerp(top, bottom, 0.1)), pdf_at(x + 0.1, std::lerp(top, bottom, 0.9)),
                      pdf_at(x + 0.9, std::lerp(top, bottom, 0.9))}) > 5;
        for (int k = 0; is_parted && k < kParts * kParts; ++k)
          sum += pdf_at(x + (k % kParts + 0.5) / kParts, std::lerp(top, bottom, (k / kParts + 0.5) / kParts));
        integral += solid_angle * (is_parted ? sum / (kParts * kParts) : middle);
      }
    }
    EXPECT_NEAR(integral, 1, 1e-5) << name;
  }
}

// Where a pixel is parted, within the parts too: the density is that of the sample.
TEST(LightSampler, DensityOfPartsIsThatOfTheirSamples) {
  const auto light = load_light("builtin:sky").light;
  const LightSampler sampler(*light);
  int of_sun = 0;
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const auto sample = sampler.sample(noise(7, i), noise(8, i));
    EXPECT_NEAR(sampler.pdf(sample.direction), sample.pdf, 1e-9 * sample.pdf) << i;
    of_sun += sample.pdf > 100;
  }
  EXPECT_GT(of_sun, 500);
}

// Radiance over density, averaged over what is drawn, is the integral of the radiance.
TEST(LightSampler, SamplesHaveTheDensityThatTheySay) {
  const auto light = load_light("builtin:sky").light;
  const LightSampler sampler(*light);
  constexpr int kSamples = 40'000;
  double sum = 0, squares = 0;
  for (std::uint64_t i = 0; i < kSamples; ++i) {
    const auto sample = sampler.sample(noise(3, i), noise(4, i));
    const double estimate = luminance(light->radiance(sample.direction)) / sample.pdf;
    sum += estimate, squares += estimate * estimate;
  }
  const double mean = sum / kSamples, deviation = std::sqrt((squares / kSamples - mean * mean) / kSamples);
  const double expected = std::sqrt(4 * std::numbers::pi) * luminance(light->project(1)[0]);
  EXPECT_NEAR(mean, expected, 4 * deviation);
  // Without parts, every other sample of the sun's pixels would miss it: a deviation of 1/200.
  EXPECT_LT(deviation, 0.0025 * expected);
}

TEST(LightSampler, BlackLightsAreSampledEvenly) {
  const LightSampler sampler(ImageLight({Image(16, 8), Layout::kLatLong}));
  for (std::uint64_t i = 0; i < 100; ++i)
    EXPECT_NEAR(sampler.sample(noise(5, i), noise(6, i)).pdf, 1 / (4 * std::numbers::pi), 1e-6);
}

}  // namespace
}  // namespace shlight
