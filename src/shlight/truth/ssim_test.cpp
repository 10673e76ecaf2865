#include "shlight/truth/ssim.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "shlight/truth/truth_test_util.h"

namespace shlight {
namespace {

// Variances of values up to 1 are differences of floats, over C2 = 9e-4.
constexpr double kTolerance = 1e-3;

TEST(Ssim, EqualPicturesAreOne) {
  const Plane a = noise_plane(30, 20, 1);
  for (const float v : ssim_map(a, a).values) EXPECT_NEAR(v, 1, 1e-6);
}

TEST(Ssim, IsSymmetricAndNoMoreThanOne) {
  const Plane a = noise_plane(30, 20, 1), b = noise_plane(30, 20, 2);
  const Plane ab = ssim_map(a, b);
  EXPECT_EQ(ab.values, ssim_map(b, a).values);
  EXPECT_LT(*std::ranges::max_element(ab.values), 1);
  EXPECT_LT(std::abs(mean_ssim(ab)), 0.2) << "independent noise is similar in its mean only";
}

// Without variance only the first factor is left.
TEST(Ssim, OfConstantsIsItsFormula) {
  Plane a(16, 16), b(16, 16);
  std::ranges::fill(a.values, 0.5f), std::ranges::fill(b.values, 0.25f);
  const double expected = (2 * 0.5 * 0.25 + 1e-4) / (0.25 + 0.0625 + 1e-4);
  EXPECT_NEAR(mean_ssim(ssim_map(a, b)), expected, 1e-5);
}

// The definition at one pixel, with the window summed up in two dimensions and variances about the means.
TEST(Ssim, IsTheDefinition) {
  const Plane a = noise_plane(24, 24, 3);
  Plane b = noise_plane(24, 24, 4);
  for (std::size_t i = 0; i < b.values.size(); ++i) b.values[i] = 0.7f * a.values[i] + 0.3f * b.values[i];
  const Plane map = ssim_map(a, b);
  for (const auto& [px, py] : {std::pair{5, 5}, {12, 9}, {18, 18}}) {
    double sum = 0, ma = 0, mb = 0, va = 0, vb = 0, cov = 0;
    const auto for_window = [&, x0 = px, y0 = py](const auto& f) {
      for (int j = -5; j <= 5; ++j)
        for (int i = -5; i <= 5; ++i)
          f(std::exp(-(i * i + j * j) / (2 * 1.5 * 1.5)), double{a.at(x0 + i, y0 + j)}, double{b.at(x0 + i, y0 + j)});
    };
    for_window([&](double w, double va_, double vb_) { sum += w, ma += w * va_, mb += w * vb_; });
    ma /= sum, mb /= sum;
    for_window([&](double w, double p, double q) {
      va += w / sum * (p - ma) * (p - ma), vb += w / sum * (q - mb) * (q - mb), cov += w / sum * (p - ma) * (q - mb);
    });
    const double expected = (2 * ma * mb + 1e-4) * (2 * cov + 9e-4) / ((ma * ma + mb * mb + 1e-4) * (va + vb + 9e-4));
    EXPECT_NEAR(map.at(px, py), expected, kTolerance) << px << " " << py;
  }
}

TEST(Ssim, FallsAsNoiseGrows) {
  const Plane a = noise_plane(40, 40, 5), n = noise_plane(40, 40, 6);
  double before = 1;
  for (const float amount : {0.05f, 0.1f, 0.2f, 0.4f}) {
    Plane b = a;
    for (std::size_t i = 0; i < b.values.size(); ++i) b.values[i] += amount * (n.values[i] - 0.5f);
    const double ssim = mean_ssim(ssim_map(a, b));
    EXPECT_LT(ssim, before) << amount;
    before = ssim;
  }
}

TEST(Ssim, PicturesSmallerThanAWindowHaveOne) {
  const Plane a = noise_plane(3, 2, 7);
  EXPECT_NEAR(mean_ssim(ssim_map(a, a)), 1, 1e-6);
  EXPECT_LT(mean_ssim(ssim_map(a, noise_plane(3, 2, 8))), 1);
}

}  // namespace
}  // namespace shlight
