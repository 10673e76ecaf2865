#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "shlight/sh/coefficients.h"
#include "shlight/transfer/transfer.h"

// Clustered principal components [1]: transfer vectors x, all coefficients of all channels of a vertex, lie near a few
// low-dimensional flats. Vertices are put into clusters k of a mean m_k and a few components b_kj, and each keeps its
// cluster's number and a weight for each component:
//
//     x ≈ m_k + Σ_j w_j b_kj          so that          L·x ≈ L·m_k + Σ_j w_j (L·b_kj)
//
// What light costs at a vertex no longer depends on the number of bands: L·m_k and L·b_kj are the same for all vertices
// of a cluster [1, section 4].
//
// [1] Sloan, Hall, Hart, Snyder 2003, Clustered Principal Components for Precomputed Radiance Transfer, SIGGRAPH.

namespace shlight {

inline constexpr int kMaxPcaClusters = 2048;  // rows of a texture that every OpenGL ES 3.0 has
inline constexpr int kMaxPcaComponents = 31;

struct PcaParams {
  int clusters = 0;  // 1 … kMaxPcaClusters, fewer where there are fewer vertices; 0: one for 256 vertices, at most 256
  int components = 11;  // 1 … kMaxPcaComponents. 4n + 3 of them leave no gap in files and textures
  std::uint64_t seed = 1;
  int threads = 0;  // at most; 0: all there are. The result has the same bits with any number
};

struct ClusteredPca {
  int bands = 0;
  int channels = 1;
  int clusters = 0;
  int components = 0;
  // Rows of as many values as a vertex has coefficients, in their sequence: row k (components + 1) is the mean of
  // cluster k, and the rows after it are its components, each in the unit of one step of its weight.
  std::vector<float> table;
  // Of each vertex components + 1 numbers: its cluster, and the weights in steps, -32767 … 32767.
  std::vector<std::int16_t> codes;

  std::size_t row_size() const { return static_cast<std::size_t>(channels * num_coefficients(bands)); }
  std::size_t rows_per_cluster() const { return static_cast<std::size_t>(components) + 1; }
  std::size_t num_vertices() const { return codes.size() / rows_per_cluster(); }
};

// How many clusters that is for so many vertices.
int num_pca_clusters(const PcaParams& params, std::size_t vertices);

// Finds clusters and components with little error, root mean square over all coefficients: k-means, and then vertices
// and principal components in turn [1, section 5, "iterative PCA"], on 16384 of the vertices where there are more.
// The minimum that it finds is a local one. Time: vertices × clusters × coefficients × components, twice.
ClusteredPca compress_pca(const Transfer& transfer, const PcaParams& params = {});

// The coefficients that it stands for, as Transfer::coefficients has them.
std::vector<float> pca_coefficients(const ClusteredPca& pca);

// L·m_k and L·b_kj for each row of the table: the radiance of a vertex is that of its cluster's mean plus, for each
// component, its weight in steps times that of the component. The light may have fewer or more bands.
std::vector<Rgb> light_pca(const ClusteredPca& pca, const RgbCoefficients& light);

}  // namespace shlight
