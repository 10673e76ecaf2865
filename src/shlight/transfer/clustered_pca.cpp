#include "shlight/transfer/clustered_pca.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>

#include "shlight/core/assert.h"
#include "shlight/core/parallel.h"
#include "shlight/sh/clones.h"
#include "shlight/transfer/sobol.h"

namespace shlight {
namespace {

// What clusters are found on: more vertices change the error by less than the choice of the seed does.
constexpr std::size_t kMaxTraining = 16384;
constexpr int kMeansIterations = 4;
constexpr int kPcaIterations = 12;
// Of the power iteration, which starts from the last components while clusters still move.
constexpr int kPowerSteps = 3, kFinalPowerSteps = 20;
constexpr std::size_t kBlock = 1024;  // vertices in work at a time
constexpr int kMostSteps = 32767;

// Components are taken so many at a time, filled up with zeros.
constexpr std::size_t kLanes = 8;

// A flat: a mean and orthonormal components, or zeros in the place of those that nothing needs.
struct Flat {
  std::vector<float> mean;
  std::vector<float> basis;  // value i of component j: [(j / kLanes · size of mean + i) · kLanes + j % kLanes]

  float& at(std::size_t i, std::size_t j) { return basis[index(i, j)]; }
  float at(std::size_t i, std::size_t j) const { return basis[index(i, j)]; }
  std::size_t num_lanes() const { return basis.size() / mean.size(); }

 private:
  std::size_t index(std::size_t i, std::size_t j) const { return (j / kLanes * mean.size() + i) * kLanes + j % kLanes; }
};

// The weights of x on the flat, num_lanes() of them, and the square of its distance from it: |x − m|² − Σ w_j², as
// components are orthonormal.
SHLIGHT_CLONES double project(const float* x, const float* mean, const float* basis, std::size_t size,
                              std::size_t lanes, double* weights) {
  double square = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const double r = double{x[i]} - double{mean[i]};
    square += r * r;
  }
  for (std::size_t j = 0; j < lanes; j += kLanes, basis += size * kLanes) {
    double sums[kLanes] = {};
    for (std::size_t i = 0; i < size; ++i) {
      const double r = double{x[i]} - double{mean[i]};
      for (std::size_t lane = 0; lane < kLanes; ++lane) sums[lane] += r * double{basis[i * kLanes + lane]};
    }
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      weights[j + lane] = sums[lane];
      square -= sums[lane] * sums[lane];
    }
  }
  return square;
}
double project(const float* x, const Flat& flat, double* weights) {
  return project(x, flat.mean.data(), flat.basis.data(), flat.mean.size(), flat.num_lanes(), weights);
}

// Those squares alone, of kTogether rows at a time, value i of row v at x[i · kTogether + v]; in float, to choose among
// flats. Here compression spends its time.
constexpr std::size_t kTogether = 16;
typedef float Lanes __attribute__((vector_size(kTogether * sizeof(float))));
SHLIGHT_CLONES void eval_distances(const float* x, const float* mean, const float* basis, std::size_t size,
                                   std::size_t lanes, float* squares) {
  Lanes square = {}, r;
  for (std::size_t i = 0; i < size; ++i) {
    std::memcpy(&r, x + i * kTogether, sizeof(r));
    r -= mean[i];
    square += r * r;
  }
  for (std::size_t j = 0; j < lanes; j += kLanes, basis += size * kLanes) {
    Lanes sums[kLanes] = {};
    for (std::size_t i = 0; i < size; ++i) {
      std::memcpy(&r, x + i * kTogether, sizeof(r));
      r -= mean[i];
      for (std::size_t lane = 0; lane < kLanes; ++lane) sums[lane] += r * basis[i * kLanes + lane];
    }
    for (const Lanes& sum : sums) square -= sum * sum;
  }
  std::memcpy(squares, &square, sizeof(square));
}

// Clusters of the rows of `data`, and their flats.
class Clusters {
 public:
  Clusters(std::span<const float> data, std::size_t row_size, const PcaParams& params)
      : data_(data),
        d_(row_size),
        params_(params),
        of_(data.size() / row_size),
        error_(of_.size()),
        flats_(static_cast<std::size_t>(params.clusters)) {
    for (Flat& flat : flats_) flat.mean.resize(d_);
  }
  // Those of other rows, found before.
  Clusters(std::span<const float> data, const Clusters& found)
      : data_(data),
        d_(found.d_),
        params_(found.params_),
        of_(data.size() / d_),
        error_(of_.size()),
        flats_(found.flats_),
        p_(found.p_) {}

  // Means far from each other: each next one is a row drawn with the square of its distance from those before it
  // (Arthur, Vassilvitskii 2007, k-means++).
  void spread_means() {
    if (of_.empty()) return;
    std::ranges::fill(error_, std::numeric_limits<float>::max());
    std::size_t chosen = random(0) % of_.size();
    for (std::size_t k = 0; k < flats_.size(); ++k) {
      std::copy_n(row(chosen), d_, flats_[k].mean.begin());
      for_blocks([&](std::size_t v) {
        error_[v] = std::min(error_[v], static_cast<float>(project(row(v), flats_[k], nullptr)));
      });
      double sum = 0;
      for (const float e : error_) sum += double{e};
      double left = sum * (static_cast<double>(random(k + 1) >> 11) * 0x1p-53);
      for (chosen = 0; chosen + 1 < of_.size() && (left -= double{error_[chosen]}) >= 0;) ++chosen;
    }
  }

  // Each row to the flat that it is nearest to.
  void assign() {
    parallel_for((of_.size() + kTogether - 1) / kTogether, params_.threads, [&](std::size_t block) {
      const std::size_t first = kTogether * block, count = std::min(kTogether, of_.size() - first);
      std::vector<float> x(d_ * kTogether);
      for (std::size_t v = 0; v < count; ++v)
        for (std::size_t i = 0; i < d_; ++i) x[i * kTogether + v] = row(first + v)[i];
      std::array<float, kTogether> least, square;
      least.fill(std::numeric_limits<float>::max());
      for (std::size_t k = 0; k < flats_.size(); ++k) {
        const Flat& flat = flats_[k];
        eval_distances(x.data(), flat.mean.data(), flat.basis.data(), d_, flat.num_lanes(), square.data());
        for (std::size_t v = 0; v < count; ++v)
          if (square[v] < least[v]) {
            least[v] = square[v];
            of_[first + v] = static_cast<std::uint32_t>(k);
          }
      }
      std::copy_n(least.begin(), count, error_.begin() + static_cast<std::ptrdiff_t>(first));
    });
  }

  // A cluster without rows takes the row that is worst off.
  void fill_empty() {
    if (of_.empty()) return;
    std::vector<std::size_t> sizes(flats_.size());
    for (const std::uint32_t k : of_) ++sizes[k];
    for (std::size_t k = 0; k < sizes.size(); ++k) {
      if (sizes[k] > 0) continue;
      const auto worst = static_cast<std::size_t>(std::ranges::max_element(error_) - error_.begin());
      if (!(error_[worst] > 0)) return;
      --sizes[of_[worst]], ++sizes[k];
      of_[worst] = static_cast<std::uint32_t>(k);
      error_[worst] = 0;
    }
  }

  // The flats of least error for the clusters as they are: the mean and the first `components` principal components of
  // each. Clusters without rows keep theirs.
  void fit(int components, int power_steps) {
    p_ = static_cast<std::size_t>(components);
    std::vector<std::vector<std::size_t>> members(flats_.size());
    for (std::size_t v = 0; v < of_.size(); ++v) members[of_[v]].push_back(v);
    parallel_for(flats_.size(), params_.threads, [&](std::size_t k) {
      flats_[k].basis.resize(d_ * num_lanes());
      if (members[k].empty()) return;
      fit_mean(members[k], flats_[k]);
      for (int step = 0; step < power_steps && p_ > 0; ++step) power_step(members[k], flats_[k], k);
    });
  }

  // Flats and rows' places on them, in steps.
  void write(ClusteredPca& pca) const {
    const std::size_t n = p_ + 1;
    std::vector<double> weights(of_.size() * p_), steps(flats_.size() * p_);
    for_blocks([&](std::size_t v) {
      std::array<double, kMaxLanes> all;
      project(row(v), flats_[of_[v]], all.data());
      std::copy_n(all.begin(), p_, weights.begin() + static_cast<std::ptrdiff_t>(v * p_));
    });
    for (std::size_t v = 0; v < of_.size(); ++v)
      for (std::size_t j = 0; j < p_; ++j) {
        double& step = steps[of_[v] * p_ + j];
        step = std::max(step, std::abs(weights[v * p_ + j]) / kMostSteps);
      }
    pca.table.resize(flats_.size() * n * d_);
    for (std::size_t k = 0; k < flats_.size(); ++k)
      for (std::size_t i = 0; i < d_; ++i) {
        pca.table[k * n * d_ + i] = flats_[k].mean[i];
        for (std::size_t j = 0; j < p_; ++j)
          pca.table[(k * n + 1 + j) * d_ + i] = static_cast<float>(steps[k * p_ + j] * double{flats_[k].at(i, j)});
      }
    pca.codes.resize(of_.size() * n);
    for (std::size_t v = 0; v < of_.size(); ++v) {
      pca.codes[v * n] = static_cast<std::int16_t>(of_[v]);
      for (std::size_t j = 0; j < p_; ++j)
        if (const double step = steps[of_[v] * p_ + j]; step > 0)
          pca.codes[v * n + 1 + j] = static_cast<std::int16_t>(std::lround(weights[v * p_ + j] / step));
    }
  }

  std::size_t size() const { return flats_.size(); }

 private:
  static constexpr std::size_t kMaxLanes = (kMaxPcaComponents + kLanes - 1) / kLanes * kLanes;
  std::size_t num_lanes() const { return (p_ + kLanes - 1) / kLanes * kLanes; }
  const float* row(std::size_t v) const { return data_.data() + v * d_; }
  std::uint64_t random(std::uint64_t i) const { return mix_bits(mix_bits(params_.seed) ^ i); }

  template <class Work>
  void for_blocks(const Work& work) const {
    parallel_for((of_.size() + kBlock - 1) / kBlock, params_.threads, [&](std::size_t block) {
      for (std::size_t v = kBlock * block; v < std::min(of_.size(), kBlock * (block + 1)); ++v) work(v);
    });
  }

  void fit_mean(std::span<const std::size_t> members, Flat& flat) const {
    std::vector<double> sum(d_);
    for (const std::size_t v : members)
      for (std::size_t i = 0; i < d_; ++i) sum[i] += double{row(v)[i]};
    for (std::size_t i = 0; i < d_; ++i)
      flat.mean[i] = static_cast<float>(sum[i] / static_cast<double>(members.size()));
  }

  // One step of the power iteration: the basis B becomes an orthonormal one of C B, C = Σ (x − m)(x − m)ᵀ, without ever
  // making C. It tends to the first principal components' space as far as their eigenvalues are apart; where they are
  // not, any space does as well.
  void power_step(std::span<const std::size_t> members, Flat& flat, std::size_t cluster) const {
    // What was not needed so far may be now.
    for (std::size_t j = 0; j < p_; ++j) {
      float largest = 0;
      for (std::size_t i = 0; i < d_; ++i) largest = std::max(largest, std::abs(flat.at(i, j)));
      for (std::size_t i = 0; i < d_ && largest == 0; ++i)
        flat.at(i, j) = static_cast<float>(random((cluster * p_ + j) * d_ + i) >> 40) * 0x1p-23f - 1;
    }
    std::vector<double> sum(d_ * p_);
    std::array<double, kMaxLanes> weights;
    for (const std::size_t v : members) {
      project(row(v), flat, weights.data());
      for (std::size_t i = 0; i < d_; ++i) {
        const double r = double{row(v)[i]} - double{flat.mean[i]};
        for (std::size_t j = 0; j < p_; ++j) sum[i * p_ + j] += r * weights[j];
      }
    }
    orthonormalise(sum);
    for (std::size_t i = 0; i < d_; ++i)
      for (std::size_t j = 0; j < p_; ++j) flat.at(i, j) = static_cast<float>(sum[i * p_ + j]);
  }

  // Gram-Schmidt, twice as is enough; what is left of a component that others span is rounding, and becomes 0.
  void orthonormalise(std::vector<double>& basis) const {
    constexpr double kRounding = 1e-9;
    const auto inner = [&](std::size_t a, std::size_t b) {
      double sum = 0;
      for (std::size_t i = 0; i < d_; ++i) sum += basis[i * p_ + a] * basis[i * p_ + b];
      return sum;
    };
    double largest = 0;
    for (std::size_t j = 0; j < p_; ++j) largest = std::max(largest, inner(j, j));
    for (std::size_t j = 0; j < p_; ++j) {
      for (int pass = 0; pass < 2; ++pass)
        for (std::size_t before = 0; before < j; ++before) {
          const double share = inner(j, before);
          for (std::size_t i = 0; i < d_; ++i) basis[i * p_ + j] -= share * basis[i * p_ + before];
        }
      const double square = inner(j, j);
      const double scale = square > kRounding * kRounding * largest ? 1 / std::sqrt(square) : 0;
      for (std::size_t i = 0; i < d_; ++i) basis[i * p_ + j] *= scale;
    }
  }

  std::span<const float> data_;
  std::size_t d_;
  PcaParams params_;
  std::vector<std::uint32_t> of_;  // each row's cluster
  std::vector<float> error_;       // and the square of its distance from that cluster's flat
  std::vector<Flat> flats_;
  std::size_t p_ = 0;
};

// Rows for training: one of every run of equal length.
std::vector<float> choose_training(std::span<const float> data, std::size_t row_size, std::uint64_t seed) {
  const std::size_t rows = data.size() / row_size;
  std::vector<float> training;
  for (std::size_t s = 0; s < kMaxTraining; ++s) {
    const std::size_t begin = s * rows / kMaxTraining, end = (s + 1) * rows / kMaxTraining;
    const std::size_t v = begin + mix_bits(seed ^ s) % (end - begin);
    training.insert(training.end(), data.begin() + static_cast<std::ptrdiff_t>(v * row_size),
                    data.begin() + static_cast<std::ptrdiff_t>((v + 1) * row_size));
  }
  return training;
}

}  // namespace

int num_pca_clusters(const PcaParams& params, std::size_t vertices) {
  SHLIGHT_ASSERT_LE(0, params.clusters);
  SHLIGHT_ASSERT_LE(params.clusters, kMaxPcaClusters);
  constexpr std::size_t kVerticesOfEach = 256, kMost = 256;
  const std::size_t wanted =
      params.clusters > 0 ? static_cast<std::size_t>(params.clusters) : std::min(vertices / kVerticesOfEach, kMost);
  return static_cast<int>(std::clamp<std::size_t>(wanted, 1, std::max<std::size_t>(1, vertices)));
}

ClusteredPca compress_pca(const Transfer& transfer, const PcaParams& params) {
  SHLIGHT_ASSERT_LE(1, params.components);
  SHLIGHT_ASSERT_LE(params.components, kMaxPcaComponents);
  ClusteredPca pca;
  pca.bands = transfer.bands;
  pca.channels = transfer.channels;
  pca.components = params.components;
  const std::size_t d = pca.row_size();
  const std::span<const float> data = transfer.coefficients;
  const bool many = data.size() / d > kMaxTraining;
  const std::vector<float> training = many ? choose_training(data, d, params.seed) : std::vector<float>();

  PcaParams sized = params;
  sized.clusters = num_pca_clusters(params, data.size() / d);
  Clusters found(many ? std::span<const float>(training) : data, d, sized);
  found.spread_means();
  for (int iteration = 0; iteration < kMeansIterations + kPcaIterations; ++iteration) {
    found.assign();
    found.fill_empty();
    found.fit(iteration < kMeansIterations ? 0 : params.components, kPowerSteps);
  }
  Clusters all(data, found);
  all.assign();
  all.fit(params.components, kFinalPowerSteps);
  all.assign();
  pca.clusters = static_cast<int>(all.size());
  all.write(pca);
  return pca;
}

std::vector<float> pca_coefficients(const ClusteredPca& pca) {
  const std::size_t d = pca.row_size(), n = pca.rows_per_cluster();
  std::vector<float> coefficients(pca.num_vertices() * d);
  for (std::size_t v = 0; v < pca.num_vertices(); ++v) {
    const std::int16_t* code = &pca.codes[v * n];
    const float* rows = &pca.table[static_cast<std::size_t>(code[0]) * n * d];
    for (std::size_t i = 0; i < d; ++i) {
      double sum = double{rows[i]};
      for (std::size_t j = 1; j < n; ++j) sum += code[j] * double{rows[j * d + i]};
      coefficients[v * d + i] = static_cast<float>(sum);
    }
  }
  return coefficients;
}

std::vector<Rgb> light_pca(const ClusteredPca& pca, const RgbCoefficients& light) {
  const auto n = static_cast<std::size_t>(num_coefficients(pca.bands));
  const auto channels = static_cast<std::size_t>(pca.channels);
  const std::size_t used = std::min(n, light.size());
  std::vector<Rgb> radiance(static_cast<std::size_t>(pca.clusters) * pca.rows_per_cluster());
  for (std::size_t k = 0; k < radiance.size(); ++k) {
    const float* row = &pca.table[k * channels * n];
    const float *red = row, *green = row + (channels - 1) / 2 * n, *blue = row + (channels - 1) * n;
    for (std::size_t i = 0; i < used; ++i)
      radiance[k] += {light[i].r * double{red[i]}, light[i].g * double{green[i]}, light[i].b * double{blue[i]}};
  }
  return radiance;
}

}  // namespace shlight
