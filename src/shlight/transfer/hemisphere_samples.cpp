#include "shlight/transfer/hemisphere_samples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>

#include "shlight/core/assert.h"
#include "shlight/core/parallel.h"
#include "shlight/sh/basis.h"
#include "shlight/sh/clones.h"
#include "shlight/transfer/sobol.h"
#include "shlight/transfer/transfer.h"

namespace shlight {
namespace {

constexpr std::size_t kWidth = std::size(Lanes{}.values);
constexpr std::size_t kMaxRowSize = kMaxTransferBands * kMaxTransferBands / kWidth;

// Sums that stay in registers: Width Lanes of each row.
template <std::size_t Width>
SHLIGHT_ALWAYS_INLINE inline void add_columns(const Lanes* rows, std::size_t row_size, const std::uint32_t* picks,
                                              const float* weights, std::size_t count, Lanes* sums) {
  Lanes sum[Width];
  for (std::size_t w = 0; w < Width; ++w) sum[w] = sums[w];
  for (std::size_t j = 0; j < count; ++j) {
    const Lanes* row = rows + picks[j] * row_size;
    for (std::size_t w = 0; w < Width; ++w)
      for (std::size_t k = 0; k < kWidth; ++k) sum[w].values[k] += weights[j] * row[w].values[k];
  }
  for (std::size_t w = 0; w < Width; ++w) sums[w] = sum[w];
}

SHLIGHT_CLONES void add_rows(const Lanes* rows, std::size_t row_size, const std::uint32_t* picks, const float* weights,
                             std::size_t count, Lanes* sums) {
  std::size_t w = 0;
  for (; w + 4 <= row_size; w += 4) add_columns<4>(rows + w, row_size, picks, weights, count, sums + w);
  for (; w + 2 <= row_size; w += 2) add_columns<2>(rows + w, row_size, picks, weights, count, sums + w);
  for (; w < row_size; ++w) add_columns<1>(rows + w, row_size, picks, weights, count, sums + w);
}

std::size_t cell_of(double u, double v) {
  return static_cast<std::size_t>(v * kCellSide) * kCellSide + static_cast<std::size_t>(u * kCellSide);
}

}  // namespace

// Malley's method: a point of the disc, lifted to the hemisphere, has the density cos θ/π. The square goes to the disc
// by Shirley & Chiu's concentric map, which takes squares to nearly square pieces and so keeps the points even.
Vec3d lift_to_hemisphere(double u, double v) {
  const double a = 2 * u - 1, b = 2 * v - 1;
  double radius = 0, angle = 0;
  if (std::abs(a) > std::abs(b))
    radius = a, angle = std::numbers::pi / 4 * (b / a);
  else if (b != 0)
    radius = b, angle = std::numbers::pi / 2 - std::numbers::pi / 4 * (a / b);
  return {radius * std::cos(angle), radius * std::sin(angle), std::sqrt(std::max(0.0, 1 - radius * radius))};
}

std::size_t row_size_of(int bands) {
  return (static_cast<std::size_t>(num_coefficients(bands)) + kWidth - 1) / kWidth;
}

HemisphereSamples make_hemisphere_samples(int bands, std::size_t set_size, bool by_cell, std::size_t num_sets,
                                          std::uint64_t seed, int threads) {
  HemisphereSamples samples;
  samples.bands = bands;
  samples.num_sets = num_sets;
  samples.set_size = set_size;
  const std::size_t n = static_cast<std::size_t>(num_coefficients(bands));
  samples.row_size = row_size_of(bands);
  const std::size_t total = set_size * num_sets;
  samples.x.resize(total), samples.y.resize(total), samples.z.resize(total);
  samples.rows.resize(total * samples.row_size);

  parallel_for(num_sets, threads, [&](std::size_t set) {
    std::vector<double> u(set_size), v(set_size), basis(n);
    make_scrambled_sobol(mix_bits(seed) + set, u, v);
    for (std::size_t j = 0; j < set_size; ++j) {
      // Any kCells consecutive points that begin at a multiple of it lie one in each cell.
      const std::size_t place = by_cell ? j / kCells * kCells + cell_of(u[j], v[j]) : j;
      const std::size_t k = set * set_size + place;
      const Vec3d direction = lift_to_hemisphere(u[j], v[j]);
      const Vec3f rounded = vec_cast<float>(direction);
      samples.x[k] = rounded.x, samples.y[k] = rounded.y, samples.z[k] = rounded.z;
      eval_basis(bands, direction, std::span<double>(basis));
      for (std::size_t i = 0; i < n; ++i)
        samples.rows[k * samples.row_size + i / kWidth].values[i % kWidth] = static_cast<float>(basis[i]);
    }
  });
  return samples;
}

void add_rows(const Lanes* rows, std::size_t row_size, std::span<const std::uint32_t> picks,
              std::span<const float> weights, std::span<double> sums) {
  SHLIGHT_ASSERT_EQ(picks.size(), weights.size());
  SHLIGHT_ASSERT_LE(row_size, kMaxRowSize);
  // Floats hold a few hundred samples without a loss that would show; the rest is summed in double.
  constexpr std::size_t kRun = 256;
  std::array<Lanes, kMaxRowSize> run;
  for (std::size_t first = 0; first < picks.size(); first += kRun) {
    std::fill_n(run.begin(), row_size, Lanes{});
    add_rows(rows, row_size, picks.data() + first, weights.data() + first, std::min(kRun, picks.size() - first),
             run.data());
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += double{run[i / kWidth].values[i % kWidth]};
  }
}

}  // namespace shlight
