#include "shlight/light/project_image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <numbers>
#include <vector>

#include "shlight/core/assert.h"
#include "shlight/core/parallel.h"
#include "shlight/image/pixels.h"
#include "shlight/sh/basis.h"
#include "shlight/sh/clones.h"
#include "shlight/sh/project.h"
#include "shlight/sh/separable.h"

// The separable projection of a lat-long map of W x H pixels. About the vertical, pixel (x, y) covers a rectangle in
// azimuth and height, so that with p_lm the normalised Legendre functions
//
//     ∫ L Y_lm = Σ_y [∫_row p_lm(cos θ) sin θ dθ] · Σ_x L(x, y) [∫_pixel cos(mφ) dφ]
//
// and likewise with sines for −m. The inner sums, 2n−1 moments a row, are all the work that each pixel sees; and
// ∫_pixel cos(mφ) dφ = cos(mφ_x) (2/m) sin(mπ/W) leaves plain cosines of the pixel centres in them.
//
// Two pixels half a turn apart have the same cos(mφ) and sin(mφ) up to the sign (−1)^m. Adding them first for even m,
// subtracting them for odd m, halves the work once more.

namespace shlight {
namespace {

using std::numbers::pi;

typedef float Lanes __attribute__((vector_size(64)));
constexpr std::size_t kLanes = sizeof(Lanes) / sizeof(float);

// Floats are summed over at most so many pixels before the sum goes on in double.
constexpr std::size_t kTile = 1024;

std::size_t rounded_up(std::size_t count) {
  return (count + kLanes - 1) / kLanes * kLanes;
}

// cos(mφ), then sin(mφ), at the pixel centres of a row, for all m; zero behind the last, up to a whole number of lanes.
struct AzimuthTable {
  std::size_t length = 0;  // pixels of a folded row, or of a whole row of odd width
  bool folded = false;
  std::vector<float> values;

  AzimuthTable(int width, int bands) : length(static_cast<std::size_t>(width)), folded(width % 2 == 0) {
    if (folded) length /= 2;
    values.resize(2 * rounded_up(length) * static_cast<std::size_t>(bands));
    for (int m = 0; m < bands; ++m)
      for (std::size_t x = 0; x < length; ++x) {
        const double phi = 2 * pi * (static_cast<double>(x) + 0.5) / width - pi;
        cosines(m)[x] = static_cast<float>(std::cos(m * phi));
        sines(m)[x] = static_cast<float>(std::sin(m * phi));
      }
  }
  float* cosines(int m) { return values.data() + 2 * static_cast<std::size_t>(m) * rounded_up(length); }
  float* sines(int m) { return cosines(m) + rounded_up(length); }
  const float* cosines(int m) const { return const_cast<AzimuthTable*>(this)->cosines(m); }
};

// One row with its channels apart, as even and as odd m need it.
struct FoldedRow {
  std::size_t stride;
  std::vector<float> values;  // even r, g, b, odd r, g, b

  explicit FoldedRow(const AzimuthTable& table) : stride(rounded_up(table.length)), values(6 * stride) {}
  const float* channels(int m) const { return values.data() + static_cast<std::size_t>(3 * (m % 2)) * stride; }
};

// Eight pixels, 24 floats r g b r g b …, to their channels.
typedef float Lanes8 __attribute__((vector_size(32)));
typedef int Mask8 __attribute__((vector_size(32)));
SHLIGHT_ALWAYS_INLINE inline void store_channels(const Lanes8& a, const Lanes8& b, const Lanes8& c, float* r, float* g,
                                                 float* bl) {
  const Lanes8 red =
      __builtin_shuffle(__builtin_shuffle(a, b, Mask8{0, 3, 6, 9, 12, 15, 0, 0}), c, Mask8{0, 1, 2, 3, 4, 5, 10, 13});
  const Lanes8 green =
      __builtin_shuffle(__builtin_shuffle(a, b, Mask8{1, 4, 7, 10, 13, 0, 0, 0}), c, Mask8{0, 1, 2, 3, 4, 8, 11, 14});
  const Lanes8 blue =
      __builtin_shuffle(__builtin_shuffle(a, b, Mask8{2, 5, 8, 11, 14, 0, 0, 0}), c, Mask8{0, 1, 2, 3, 4, 9, 12, 15});
  std::memcpy(r, &red, sizeof red);
  std::memcpy(g, &green, sizeof green);
  std::memcpy(bl, &blue, sizeof blue);
}

// `length` pixels of a row and as many from its middle on.
SHLIGHT_CLONES void fold_row(const float* row, std::size_t length, float* values, std::size_t stride) {
  const float* opposite = row + 3 * length;
  float* odd = values + 3 * stride;
  std::size_t x = 0;
  for (; x + 8 <= length; x += 8) {
    Lanes8 near[3], far[3];
    std::memcpy(near, row + 3 * x, sizeof near);
    std::memcpy(far, opposite + 3 * x, sizeof far);
    store_channels(near[0] + far[0], near[1] + far[1], near[2] + far[2], values + x, values + stride + x,
                   values + 2 * stride + x);
    store_channels(near[0] - far[0], near[1] - far[1], near[2] - far[2], odd + x, odd + stride + x,
                   odd + 2 * stride + x);
  }
  for (; x < length; ++x)
    for (std::size_t c = 0; c < 3; ++c) {
      values[c * stride + x] = row[3 * x + c] + opposite[3 * x + c];
      odd[c * stride + x] = row[3 * x + c] - opposite[3 * x + c];
    }
}

SHLIGHT_ALWAYS_INLINE inline void load(const float* p, Lanes& lanes) {
  std::memcpy(&lanes, p, sizeof lanes);
}

SHLIGHT_ALWAYS_INLINE inline double sum_of(const Lanes& lanes) {
  float v[kLanes];
  std::memcpy(v, &lanes, sizeof v);
  for (std::size_t width = kLanes / 2; width > 0; width /= 2)
    for (std::size_t i = 0; i < width; ++i) v[i] += v[i + width];
  return static_cast<double>(v[0]);
}

// Adds Σ_x channel_c(x) · weights_w(x) over `count` pixels to sums[3w + c]. The channels and the rows of weights lie
// `count` floats apart from each other in each of the two blocks of weights.
template <int Blocks, int RowsABlock>
SHLIGHT_ALWAYS_INLINE inline void add_products(const float* channels, const float* const* weights, std::size_t count,
                                               double* sums) {
  constexpr int kRows = Blocks * RowsABlock;
  for (std::size_t begin = 0; begin < count; begin += kTile) {
    Lanes partial[3 * kRows] = {};
    const std::size_t end = begin + kTile < count ? begin + kTile : count;
    for (std::size_t x = begin; x < end; x += kLanes) {
      Lanes r, g, b, weight;
      load(channels + x, r), load(channels + count + x, g), load(channels + 2 * count + x, b);
      for (int w = 0; w < kRows; ++w) {
        load(weights[w / RowsABlock] + static_cast<std::size_t>(w % RowsABlock) * count + x, weight);
        partial[3 * w] += weight * r, partial[3 * w + 1] += weight * g, partial[3 * w + 2] += weight * b;
      }
    }
    for (int i = 0; i < 3 * kRows; ++i) sums[i] += sum_of(partial[i]);
  }
}

// For one row of weights, the cosines of m = 0; for the cosines and sines of one m; and for those of two.
SHLIGHT_CLONES void add_products_of_constant(const float* channels, const float* const* weights, std::size_t count,
                                             double* sums) {
  add_products<1, 1>(channels, weights, count, sums);
}
SHLIGHT_CLONES void add_products_of_one(const float* channels, const float* const* weights, std::size_t count,
                                        double* sums) {
  add_products<1, 2>(channels, weights, count, sums);
}
SHLIGHT_CLONES void add_products_of_two(const float* channels, const float* const* weights, std::size_t count,
                                        double* sums) {
  add_products<2, 2>(channels, weights, count, sums);
}

// Σ_x L cos(mφ_x) at 2m and Σ_x L sin(mφ_x) at 2m + 1. Two degrees of one parity at a time where there are two: they
// share the loads of the pixels.
void row_moments(std::span<const float> row, const AzimuthTable& table, FoldedRow& folded, std::span<Rgb> moments) {
  if (table.folded) {
    fold_row(row.data(), table.length, folded.values.data(), folded.stride);
  } else {
    for (std::size_t x = 0; x < table.length; ++x)
      for (std::size_t c = 0; c < 3; ++c)
        folded.values[c * folded.stride + x] = folded.values[(c + 3) * folded.stride + x] = row[3 * x + c];
  }
  const int bands = static_cast<int>(moments.size() / 2);
  for (int m = 0; m < bands; m += m % 2 == 1 || m == 0 ? 1 : 3) {
    std::array<double, 12> sums = {};
    const bool two = m > 0 && m + 2 < bands;
    const float* const weights[2] = {table.cosines(m), two ? table.cosines(m + 2) : nullptr};
    const auto add = m == 0 ? add_products_of_constant : two ? add_products_of_two : add_products_of_one;
    add(folded.channels(m), weights, folded.stride, sums.data());
    for (std::size_t i = 0; i < (two ? 4u : 2u); ++i)
      moments[static_cast<std::size_t>(2 * m) + i % 2 + 4 * (i / 2)] = {sums[3 * i], sums[3 * i + 1], sums[3 * i + 2]};
  }
}

// ∫ p_lm(cos θ) sin θ dθ over the rows of a lat-long map, times the azimuthal (2/m) sin(mπ/W).
class RowWeights {
 public:
  RowWeights(int width, int height, int bands)
      : height_(height), legendre_(bands), azimuthal_(static_cast<std::size_t>(bands)) {
    for (int m = 0; m < bands; ++m)
      azimuthal_[static_cast<std::size_t>(m)] = m == 0 ? 2 * pi / width : 2.0 / m * std::sin(m * pi / width);
    // The integrand is a trigonometric polynomial of degree `bands`; k Gauss nodes leave (bands · Δθ / 2)^2k / (2k)!.
    const double reach = 0.5 * bands * pi / height;
    int nodes = 1;
    for (double error = 0.5 * reach * reach; error > 1e-13 && nodes < 64; ++nodes)
      error *= reach * reach / ((2 * nodes + 1) * (2 * nodes + 2));
    rule_ = make_gauss_legendre(std::max(2, nodes));
  }

  // Writes the weights of row y in the sequence of NormalizedLegendre.
  void eval(int y, std::span<double> weights) const {
    std::fill(weights.begin(), weights.end(), 0.0);
    std::vector<double> p(weights.size());
    const double half = pi / (2.0 * height_);
    for (std::size_t k = 0; k < rule_.nodes.size(); ++k) {
      const double theta = (2 * y + 1 + rule_.nodes[k]) * half, s = std::sin(theta);
      legendre_.eval(std::cos(theta), s, p);
      for (std::size_t i = 0; i < p.size(); ++i) weights[i] += rule_.weights[k] * half * s * p[i];
    }
    for (int l = 0; l < legendre_.bands(); ++l)
      for (int m = 0; m <= l; ++m)
        weights[static_cast<std::size_t>(l * (l + 1) / 2 + m)] *= azimuthal_[static_cast<std::size_t>(m)];
  }

 private:
  int height_;
  NormalizedLegendre legendre_;
  std::vector<double> azimuthal_;
  GaussLegendre rule_;
};

// Rows y and H−1−y have the same weights up to the sign (−1)^(l+m): they go together.
RgbCoefficients project_lat_long(const Image& image, int bands, int threads) {
  const AzimuthTable table(image.width, bands);
  const RowWeights row_weights(image.width, image.height, bands);
  const int pairs = (image.height + 1) / 2;
  constexpr int kPairsABlock = 8;
  const int blocks = (pairs + kPairsABlock - 1) / kPairsABlock;
  std::vector<SeparableSum> sums(static_cast<std::size_t>(blocks), SeparableSum(bands));

  parallel_for(sums.size(), threads, [&](std::size_t block) {
    FoldedRow folded(table);
    std::vector<Rgb> moments(static_cast<std::size_t>(2 * bands));
    std::vector<double> weights(static_cast<std::size_t>(bands * (bands + 1) / 2));
    const int first = static_cast<int>(block) * kPairsABlock;
    for (int y = first; y < std::min(pairs, first + kPairsABlock); ++y) {
      row_weights.eval(y, weights);
      row_moments(image.row(y), table, folded, moments);
      sums[block].add_row(weights, moments);
      const int mirrored = image.height - 1 - y;
      if (mirrored == y) continue;
      for (int l = 0; l < bands; ++l)
        for (int m = 0; m <= l; ++m)
          if ((l + m) % 2 == 1) weights[static_cast<std::size_t>(l * (l + 1) / 2 + m)] *= -1;
      row_moments(image.row(mirrored), table, folded, moments);
      sums[block].add_row(weights, moments);
    }
  });
  SeparableSum total(bands);
  for (const SeparableSum& sum : sums) total.add(sum);
  return total.to_world();
}

// --- every other layout: the basis at the nodes of all pixels, many nodes at a time

// Adds Σ_j basis_i(j) · channel_c(j) to sums[3i + c] for whole blocks of nodes; channels lie kNodes apart.
constexpr std::size_t kNodes = 256;
SHLIGHT_CLONES void add_nodes(const float* basis, const float* channels, std::size_t coefficients, double* sums) {
  for (std::size_t i = 0; i < coefficients; ++i) {
    Lanes r{}, g{}, b{};
    for (std::size_t j = 0; j < kNodes; j += kLanes) {
      Lanes value, red, green, blue;
      load(basis + i * kNodes + j, value);
      load(channels + j, red), load(channels + kNodes + j, green), load(channels + 2 * kNodes + j, blue);
      r += value * red, g += value * green, b += value * blue;
    }
    sums[3 * i] += sum_of(r), sums[3 * i + 1] += sum_of(g), sums[3 * i + 2] += sum_of(b);
  }
}

// Collects weighted directions and projects them as soon as there is a block of them.
class NodeProjector {
 public:
  explicit NodeProjector(int bands)
      : bands_(bands),
        basis_(static_cast<std::size_t>(num_coefficients(bands)) * kNodes),
        sums_(3 * static_cast<std::size_t>(num_coefficients(bands))) {}

  void add(const WeightedDirection& node, Rgb radiance) {
    x_[count_] = static_cast<float>(node.direction.x);
    y_[count_] = static_cast<float>(node.direction.y);
    z_[count_] = static_cast<float>(node.direction.z);
    channels_[count_] = static_cast<float>(node.solid_angle * radiance.r);
    channels_[kNodes + count_] = static_cast<float>(node.solid_angle * radiance.g);
    channels_[2 * kNodes + count_] = static_cast<float>(node.solid_angle * radiance.b);
    if (++count_ == kNodes) flush();
  }

  RgbCoefficients take() {
    // What is left of an earlier block is still a direction; its radiance must not count again.
    for (std::size_t c = 0; c < 3; ++c)
      std::fill(channels_.begin() + static_cast<std::ptrdiff_t>(c * kNodes + count_),
                channels_.begin() + static_cast<std::ptrdiff_t>((c + 1) * kNodes), 0.0f);
    flush();
    RgbCoefficients result(bands_);
    for (std::size_t i = 0; i < result.size(); ++i) result[i] = {sums_[3 * i], sums_[3 * i + 1], sums_[3 * i + 2]};
    return result;
  }

 private:
  void flush() {
    eval_basis(bands_, x_, y_, z_, basis_);
    add_nodes(basis_.data(), channels_.data(), sums_.size() / 3, sums_.data());
    count_ = 0;
  }

  int bands_;
  std::size_t count_ = 0;
  std::array<float, kNodes> x_{}, y_{}, z_{};
  std::array<float, 3 * kNodes> channels_{};
  std::vector<float> basis_;
  std::vector<double> sums_;
};

RgbCoefficients project_nodes(const Environment& environment, int bands, int threads) {
  const Image& image = environment.image;
  const PixelQuadrature pixels(environment.layout, environment.size(),
                               nodes_a_side_for(environment.layout, environment.size(), bands));
  constexpr int kRowsABlock = 8;
  std::vector<RgbCoefficients> blocks(static_cast<std::size_t>((image.height + kRowsABlock - 1) / kRowsABlock));
  parallel_for(blocks.size(), threads, [&](std::size_t block) {
    NodeProjector projector(bands);
    std::vector<WeightedDirection> nodes;
    const int first = static_cast<int>(block) * kRowsABlock;
    for (int y = first; y < std::min(image.height, first + kRowsABlock); ++y)
      for (int x = 0; x < image.width; ++x) {
        pixels.nodes({x, y}, nodes);
        for (const WeightedDirection& node : nodes) projector.add(node, image.rgb(x, y));
      }
    blocks[block] = projector.take();
  });
  RgbCoefficients total(bands);
  for (const RgbCoefficients& block : blocks) total += block;
  return total;
}

}  // namespace

RgbCoefficients project_image(const Environment& environment, int bands, int threads) {
  SHLIGHT_ASSERT_GE(environment.image.width, 1);
  SHLIGHT_ASSERT_GE(bands, 1);
  if (environment.layout == Layout::kLatLong) return project_lat_long(environment.image, bands, threads);
  return project_nodes(environment, bands, threads);
}

RgbCoefficients project_image_by_pixels(const Environment& environment, int bands, int threads) {
  const Image& image = environment.image;
  const PixelQuadrature pixels(environment.layout, environment.size(),
                               nodes_a_side_for(environment.layout, environment.size(), bands));
  std::vector<RgbCoefficients> rows(static_cast<std::size_t>(image.height), RgbCoefficients(bands));
  parallel_for(rows.size(), threads, [&](std::size_t y) {
    std::vector<WeightedDirection> nodes;
    std::vector<double> basis(rows[y].size());
    for (int x = 0; x < image.width; ++x) {
      pixels.nodes({x, static_cast<int>(y)}, nodes);
      const Rgb radiance = image.rgb(x, static_cast<int>(y));
      for (const WeightedDirection& node : nodes) {
        eval_basis(bands, node.direction, std::span<double>(basis));
        for (std::size_t i = 0; i < basis.size(); ++i) rows[y][i] += node.solid_angle * basis[i] * radiance;
      }
    }
  });
  RgbCoefficients total(bands);
  for (const RgbCoefficients& row : rows) total += row;
  return total;
}

}  // namespace shlight
