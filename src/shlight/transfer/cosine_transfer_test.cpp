#include "shlight/transfer/cosine_transfer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "shlight/sh/coefficients.h"
#include "shlight/sh/project.h"
#include "shlight/sh/sphere_samples.h"

namespace shlight {
namespace {

using std::numbers::pi;

std::vector<Vec3f> scattered_normals(int strata) {
  std::vector<Vec3f> normals;
  for (const Vec3d& d : make_sphere_samples(0, strata, 5).directions) normals.push_back(vec_cast<float>(d));
  return normals;
}

std::vector<float> eval_cosine_transfer(int bands, std::span<const Vec3f> normals) {
  std::vector<float> coefficients(normals.size() * static_cast<std::size_t>(num_coefficients(bands)));
  eval_cosine_transfer(bands, normals, coefficients);
  return coefficients;
}

TEST(CosineTransfer, ClosedFormIsTheQuadrature) {
  // The quadrature splits the sphere at the horizon, so it knows the clamped cosine of the vertical normal to rounding;
  // elsewhere the kink leaves an error of second order in its node distance.
  constexpr double kTolerance = 1e-6;
  for (const Vec3f normal : {Vec3f{0, 1, 0}, Vec3f{.36f, .48f, .80f}, Vec3f{-.6f, 0, .8f}})
    for (const int bands : {1, 5, 10}) {
      const Vec3d n = vec_cast<double>(normal);
      const auto f = [&](Vec3d s) { return std::max(0.0, dot(n, s)) / pi * Rgb{1, 1, 1}; };
      const RgbCoefficients expected = project_quadrature(f, bands).coefficients;
      const std::vector<float> actual = eval_cosine_transfer(bands, std::span(&normal, 1));
      for (std::size_t i = 0; i < actual.size(); ++i)
        EXPECT_NEAR(actual[i], expected[i].r, kTolerance) << bands << " bands, coefficient " << i;
    }
}

TEST(CosineTransfer, SampledIsTheClosedFormWithinItsStandardError) {
  constexpr int kBands = 5, kSamples = 10000;
  const std::vector<Vec3f> normals = scattered_normals(6);
  const std::vector<float> exact = eval_cosine_transfer(kBands, normals);
  std::vector<float> sampled(exact.size());
  sample_cosine_transfer(kBands, normals, kSamples, 7, sampled);

  // The standard errors come from projecting the same function on the same samples in double.
  const SphereSamples samples = make_sphere_samples(kBands, strata_for(kSamples), 7);
  double sum_of_squares = 0;
  for (std::size_t v = 0; v < normals.size(); ++v) {
    const Vec3d n = vec_cast<double>(normals[v]);
    const auto f = [&](Vec3d s) { return std::max(0.0, dot(n, s)) / pi * Rgb{1, 1, 1}; };
    const MonteCarloProjection projection = project_monte_carlo(f, samples);
    for (std::size_t i = 0; i < projection.coefficients.size(); ++i) {
      const std::size_t k = v * projection.coefficients.size() + i;
      EXPECT_NEAR(sampled[k], projection.coefficients[i].r, 1e-6);  // float against double
      const double error = (double{sampled[k]} - exact[k]) / projection.standard_error[i].r;
      EXPECT_LT(std::abs(error), 5) << "vertex " << v << ", coefficient " << i;
      sum_of_squares += error * error;
    }
  }
  // The estimated standard error errs to the large side, but is no mere bound.
  const double rms = std::sqrt(sum_of_squares / static_cast<double>(exact.size()));
  EXPECT_LT(rms, 1.1);
  EXPECT_GT(rms, 0.5);
}

TEST(CosineTransfer, SampledConvergesFasterThanRandomPointsWould) {
  // Jittered points: N^-3/4 or better for a function with a kink; random ones: N^-1/2.
  const std::vector<Vec3f> normals = scattered_normals(10);
  const std::vector<float> exact = eval_cosine_transfer(3, normals);
  const auto rms_error = [&](int samples) {
    std::vector<float> sampled(exact.size());
    sample_cosine_transfer(3, normals, samples, 3, sampled);
    double sum = 0;
    for (std::size_t k = 0; k < exact.size(); ++k) sum += std::pow(double{sampled[k]} - exact[k], 2);
    return std::sqrt(sum / static_cast<double>(exact.size()));
  };
  EXPECT_LT(rms_error(25600), rms_error(100) / std::pow(256, 0.7));
}

TEST(CosineTransfer, UniformLightLeavesAWhiteSurfaceAtOne) {
  const std::vector<Vec3f> normals = scattered_normals(4);
  const std::vector<float> transfer = eval_cosine_transfer(4, normals);
  for (std::size_t v = 0; v < normals.size(); ++v) EXPECT_NEAR(std::sqrt(4 * pi) * transfer[16 * v], 1, 1e-6);
}

TEST(CosineTransfer, NothingInNothingOut) {
  EXPECT_TRUE(eval_cosine_transfer(5, {}).empty());
  std::vector<float> none;
  sample_cosine_transfer(5, {}, 100, 1, none);
}

}  // namespace
}  // namespace shlight
