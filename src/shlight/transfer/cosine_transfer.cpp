#include "shlight/transfer/cosine_transfer.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numbers>
#include <vector>

#include "shlight/core/assert.h"
#include "shlight/core/parallel.h"
#include "shlight/sh/basis.h"
#include "shlight/sh/clones.h"
#include "shlight/sh/sphere_samples.h"
#include "shlight/sh/zonal.h"

namespace shlight {
namespace {

using std::numbers::pi;

// Normals that are worked on together: their basis values stay in the first cache at 5 bands.
constexpr std::size_t kBlock = 256;

// From coefficient by coefficient to normal by normal, times each coefficient's factor.
SHLIGHT_CLONES void scale_and_transpose(const float* values, std::size_t count, const float* factors, std::size_t n,
                                        float* result) {
  for (std::size_t j = 0; j < count; ++j)
    for (std::size_t i = 0; i < n; ++i) result[j * n + i] = factors[i] * values[i * count + j];
}

// sums += Σ_j max(0, n·s_j) Y(s_j): basis values lie direction by direction, `n` each.
SHLIGHT_CLONES void add_samples(std::span<const Vec3f> directions, const float* basis, std::size_t n, Vec3f normal,
                                float* sums) {
  for (std::size_t j = 0; j < directions.size(); ++j) {
    const float cosine = normal.x * directions[j].x + normal.y * directions[j].y + normal.z * directions[j].z;
    if (cosine <= 0) continue;
    const float* y = basis + j * n;
    for (std::size_t i = 0; i < n; ++i) sums[i] += cosine * y[i];
  }
}

template <class Body>
void for_each_block(std::size_t count, int threads, const Body& body) {
  parallel_for((count + kBlock - 1) / kBlock, threads,
               [&](std::size_t b) { body(b * kBlock, std::min(kBlock, count - b * kBlock)); });
}

}  // namespace

void eval_cosine_transfer(int bands, std::span<const Vec3f> normals, std::span<float> coefficients, int threads) {
  const std::size_t n = static_cast<std::size_t>(num_coefficients(bands));
  SHLIGHT_ASSERT_EQ(coefficients.size(), n * normals.size());
  std::vector<float> factors(n);
  for (int l = 0; l < bands; ++l)
    for (int m = -l; m <= l; ++m) factors[coefficient_index(l, m)] = static_cast<float>(cosine_lobe_hat(l) / pi);

  for_each_block(normals.size(), threads, [&](std::size_t begin, std::size_t count) {
    std::array<float, 3 * kBlock> components;
    const std::span<float> x(components.data(), count), y(components.data() + kBlock, count),
        z(components.data() + 2 * kBlock, count);
    for (std::size_t j = 0; j < count; ++j) {
      const Vec3f normal = normals[begin + j];
      x[j] = normal.x, y[j] = normal.y, z[j] = normal.z;
    }
    std::vector<float> values(n * count);
    eval_basis(bands, x, y, z, values);
    scale_and_transpose(values.data(), count, factors.data(), n, coefficients.data() + n * begin);
  });
}

void sample_cosine_transfer(int bands, std::span<const Vec3f> normals, int samples, std::uint64_t seed,
                            std::span<float> coefficients, int threads) {
  const std::size_t n = static_cast<std::size_t>(num_coefficients(bands));
  SHLIGHT_ASSERT_EQ(coefficients.size(), n * normals.size());
  SHLIGHT_ASSERT_GE(samples, 1);
  const SphereSamples exact = make_sphere_samples(bands, strata_for(samples), seed);
  std::vector<Vec3f> directions;
  for (const Vec3d& d : exact.directions) directions.push_back(vec_cast<float>(d));
  const std::vector<float> basis(exact.basis.begin(), exact.basis.end());

  for_each_block(normals.size(), threads, [&](std::size_t begin, std::size_t count) {
    std::vector<float> sums(n);
    std::vector<double> total(n);
    for (std::size_t j = begin; j < begin + count; ++j) {
      // Floats hold a few hundred samples without loss that would show; the rest is summed in double.
      constexpr std::size_t kRun = 256;
      std::ranges::fill(total, 0.0);
      for (std::size_t first = 0; first < directions.size(); first += kRun) {
        const std::size_t run = std::min(kRun, directions.size() - first);
        std::ranges::fill(sums, 0.0f);
        add_samples(std::span(directions).subspan(first, run), basis.data() + first * n, n, normals[j], sums.data());
        for (std::size_t i = 0; i < n; ++i) total[i] += double{sums[i]};
      }
      const double weight = 4 / static_cast<double>(directions.size());
      for (std::size_t i = 0; i < n; ++i) coefficients[j * n + i] = static_cast<float>(weight * total[i]);
    }
  });
}

}  // namespace shlight
