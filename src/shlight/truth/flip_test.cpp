#include "shlight/truth/flip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "shlight/truth/truth_test_util.h"

namespace shlight {
namespace {

// --- the definition of [1], written down plainly: matrices with the digits of IEC 61966-2-1, filters summed up in two
// dimensions at every pixel.

struct Triple {
  double x = 0, y = 0, z = 0;
};

Triple xyz_of(Rgb c) {
  return {0.4124 * c.r + 0.3576 * c.g + 0.1805 * c.b, 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b,
          0.0193 * c.r + 0.1192 * c.g + 0.9505 * c.b};
}
constexpr Triple kWhite = {0.9505, 1, 1.0890};

Triple opponent_of(Rgb c) {
  const Triple v = xyz_of(c);
  return {116 * v.y / kWhite.y - 16, 500 * (v.x / kWhite.x - v.y / kWhite.y), 200 * (v.y / kWhite.y - v.z / kWhite.z)};
}

Rgb rgb_of_opponent(Triple c) {
  const double y = (c.x + 16) / 116;
  const double vx = kWhite.x * (y + c.y / 500), vy = kWhite.y * y, vz = kWhite.z * (y - c.z / 200);
  const auto clamped = [](double v) { return std::clamp(v, 0.0, 1.0); };
  return {clamped(3.2406 * vx - 1.5372 * vy - 0.4986 * vz), clamped(-0.9689 * vx + 1.8758 * vy + 0.0415 * vz),
          clamped(0.0557 * vx - 0.2040 * vy + 1.0570 * vz)};
}

Triple hunt_lab_of(Rgb c) {
  const Triple v = xyz_of(c);
  const auto f = [](double t) { return t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116; };
  const double l = 116 * f(v.y) - 16;
  return {l, 0.01 * l * 500 * (f(v.x / kWhite.x) - f(v.y)), 0.01 * l * 200 * (f(v.y) - f(v.z / kWhite.z))};
}

double hyab(Triple a, Triple b) {
  return std::abs(a.x - b.x) + std::sqrt((a.y - b.y) * (a.y - b.y) + (a.z - b.z) * (a.z - b.z));
}

double color_difference(Triple a, Triple b) {
  const double largest = std::pow(hyab(hunt_lab_of({0, 1, 0}), hunt_lab_of({0, 0, 1})), 0.7);
  const double d = std::pow(hyab(a, b), 0.7);
  return d < 0.4 * largest ? 0.95 * d / (0.4 * largest) : 0.95 + 0.05 * (d - 0.4 * largest) / (0.6 * largest);
}

// Σ weight(x, y) value(pixel + (x, y)) with the border drawn out, divided by the sum of weights where `normed`.
template <class Weight, class Value>
auto filtered(const Image& image, int px, int py, int radius, const Weight& weight, const Value& value) {
  decltype(value(Rgb{})) sum = 0;
  for (int y = -radius; y <= radius; ++y)
    for (int x = -radius; x <= radius; ++x)
      sum += weight(x, y) *
             value(image.rgb(std::clamp(px + x, 0, image.width - 1), std::clamp(py + y, 0, image.height - 1)));
  return sum;
}

double channel_by_definition(const Image& image, int px, int py, double ppd, int channel) {
  constexpr double kA1[] = {1, 1, 34.1}, kB1[] = {0.0047, 0.0053, 0.04}, kA2[] = {0, 0, 13.5}, kB2[] = {1, 1, 0.025};
  const int radius = static_cast<int>(std::ceil(3 * std::sqrt(0.04 / (2 * std::numbers::pi * std::numbers::pi)) * ppd));
  const auto weight = [&](int x, int y) {
    const double d2 = (x * x + y * y) / (ppd * ppd), pi = std::numbers::pi;
    return kA1[channel] * std::sqrt(pi / kB1[channel]) * std::exp(-pi * pi * d2 / kB1[channel]) +
           kA2[channel] * std::sqrt(pi / kB2[channel]) * std::exp(-pi * pi * d2 / kB2[channel]);
  };
  const auto value = [&](Rgb c) {
    const Triple o = opponent_of(c);
    return channel == 0 ? o.x : channel == 1 ? o.y : o.z;
  };
  const double total = filtered(image, px, py, radius, weight, [](Rgb) { return 1.0; });
  return filtered(image, px, py, radius, weight, value) / total;
}

// The lengths of the gradient and of the second derivatives.
std::array<double, 2> features_by_definition(const Image& image, int px, int py, double ppd) {
  const double sigma = 0.5 * 0.082 * ppd;
  const int radius = static_cast<int>(std::ceil(3 * sigma));
  std::array<double, 2> result;
  for (int kind = 0; kind < 2; ++kind) {
    const auto weight = [&](int x, int y) {
      const double g = std::exp(-(x * x + y * y) / (2 * sigma * sigma));
      return kind == 0 ? -x * g : (x * x / (sigma * sigma) - 1) * g;
    };
    double positive = 0, negative = 0;
    for (int y = -radius; y <= radius; ++y)
      for (int x = -radius; x <= radius; ++x) (weight(x, y) > 0 ? positive : negative) += std::abs(weight(x, y));
    const auto normed = [&](int x, int y) { return weight(x, y) / (weight(x, y) > 0 ? positive : negative); };
    const auto transposed = [&](int x, int y) { return normed(y, x); };
    const auto value = [](Rgb c) { return xyz_of(c).y; };
    result[static_cast<std::size_t>(kind)] =
        std::hypot(filtered(image, px, py, radius, normed, value), filtered(image, px, py, radius, transposed, value));
  }
  return result;
}

double flip_by_definition(const Image& a, const Image& b, int x, int y, double ppd) {
  const auto lab = [&](const Image& image) {
    return hunt_lab_of(
        rgb_of_opponent({channel_by_definition(image, x, y, ppd, 0), channel_by_definition(image, x, y, ppd, 1),
                         channel_by_definition(image, x, y, ppd, 2)}));
  };
  const auto fa = features_by_definition(a, x, y, ppd), fb = features_by_definition(b, x, y, ppd);
  const double feature = std::sqrt(std::max(std::abs(fa[0] - fb[0]), std::abs(fa[1] - fb[1])) / std::numbers::sqrt2);
  return std::pow(color_difference(lab(a), lab(b)), 1 - feature);
}

// The standard's matrices have four digits.
constexpr double kMatrixTolerance = 5e-4;

TEST(Flip, IsTheDefinition) {
  const Image a = noise_image(26, 20, 1), b = noise_image(26, 20, 2);
  for (const double ppd : {12.0, 40.0}) {
    const Plane map = flip_map(a, b, {ppd, 2});
    for (const auto& [x, y] : {std::pair{0, 0}, {25, 7}, {12, 10}, {3, 19}, {20, 4}})
      EXPECT_NEAR(map.at(x, y), flip_by_definition(a, b, x, y, ppd), kMatrixTolerance) << x << " " << y << " " << ppd;
  }
}

TEST(Flip, OfConstantsIsTheDifferenceOfColors) {
  for (const auto& [p, q] : {std::pair{Rgb{0, 0, 0}, Rgb{1, 1, 1}},
                             {Rgb{0.2, 0.2, 0.2}, Rgb{0.25, 0.2, 0.2}},
                             {Rgb{0.9, 0.1, 0.4}, Rgb{0.1, 0.5, 0.4}}}) {
    const Plane map = flip_map(constant_image(9, 7, p), constant_image(9, 7, q));
    for (const float v : map.values) EXPECT_NEAR(v, color_difference(hunt_lab_of(p), hunt_lab_of(q)), kMatrixTolerance);
  }
}

TEST(Flip, GreenAndBlueDifferMost) {
  const Plane map = flip_map(constant_image(4, 4, {0, 1, 0}), constant_image(4, 4, {0, 0, 1}));
  EXPECT_NEAR(mean(map), 1, 1e-5);
  EXPECT_LT(mean(flip_map(constant_image(4, 4, {1, 0, 0}), constant_image(4, 4, {0, 0, 1}))), 0.999);
}

TEST(Flip, EqualPicturesAreZeroAndPicturesAreExchangeable) {
  const Image a = noise_image(20, 14, 3), b = noise_image(20, 14, 4);
  EXPECT_EQ(mean(flip_map(a, a)), 0);
  EXPECT_EQ(flip_map(a, b).values, flip_map(b, a).values);
  const std::vector<float> values = flip_map(a, b).values;
  EXPECT_GE(*std::ranges::min_element(values), 0);
  EXPECT_LE(*std::ranges::max_element(values), 1);
}

TEST(Flip, GrowsWithTheDifferenceAndFallsWithDistance) {
  const Image a = constant_image(48, 48, {0.4, 0.4, 0.4}), n = noise_image(48, 48, 5);
  double before = 0;
  for (const float amount : {0.05f, 0.1f, 0.2f, 0.4f}) {
    Image b = a;
    for (std::size_t i = 0; i < b.values.size(); ++i) b.values[i] += amount * (n.values[i] - 0.5f);
    const double near = mean(flip_map(a, b, {30, 1})), far = mean(flip_map(a, b, {120, 1}));
    EXPECT_GT(near, before) << amount;
    EXPECT_LT(far, 0.8 * near) << "noise of single pixels drowns from afar";
    before = near;
  }
}

TEST(HdrFlip, ExposuresRunFromTheBrightestToTheMedian) {
  Image reference = constant_image(5, 3, {0.0625, 0.0625, 0.0625});
  reference.set_rgb(2, 1, {1, 1, 1});
  const FlipExposures exposures = flip_exposures(reference);
  EXPECT_NEAR(exposures.stop - exposures.start, 4, 1e-6);
  EXPECT_EQ(exposures.count, 4);
  EXPECT_NEAR(exposures.at(3), exposures.stop, 1e-12);
  // What is shown at 0.85 by Narkowicz's curve, whose unit is 0.6 of this.
  const double x = 0.6 * std::exp2(exposures.start);
  EXPECT_NEAR(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.85, 1e-9);
  EXPECT_EQ(flip_exposures(constant_image(2, 2, {})).count, 1);
}

TEST(HdrFlip, KnowsNoUnitOfRadiance) {
  Image a = noise_image(18, 12, 6), b = noise_image(18, 12, 7);
  for (float& v : b.values) v = v * v * 40;
  for (float& v : a.values) v = v * 30;
  const double there = mean(hdr_flip_map(a, b));
  for (Image* image : {&a, &b})
    for (float& v : image->values) v *= 1024;
  EXPECT_NEAR(mean(hdr_flip_map(a, b)), there, 1e-6);
  EXPECT_GT(there, 0.1);
  EXPECT_EQ(mean(hdr_flip_map(b, b)), 0);
}

// What is white in the dark's exposure is still looked at in the light's, and the other way round.
TEST(HdrFlip, SeesBothEndsOfTheRange) {
  Image reference = constant_image(40, 40, {0.01, 0.01, 0.01});
  for (int y = 0; y < 12; ++y)
    for (int x = 0; x < 40; ++x) reference.set_rgb(x, y, {100, 100, 100});
  Image bright = reference, dark = reference;
  bright.set_rgb(20, 4, {30, 30, 30});
  dark.set_rgb(20, 30, {0.003, 0.003, 0.003});
  EXPECT_GT(hdr_flip_map(bright, reference).at(20, 4), 0.1);
  EXPECT_GT(hdr_flip_map(dark, reference).at(20, 30), 0.1);
}

}  // namespace
}  // namespace shlight
