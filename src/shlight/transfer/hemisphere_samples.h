#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shlight/sh/vec.h"

namespace shlight {

// A piece of a row of basis values: as wide as the widest registers.
struct alignas(64) Lanes {
  float values[16] = {};
};

// The hemisphere is cut into kCells cells of equal weight, kCellSide x kCellSide of the square that is lifted to it.
inline constexpr std::size_t kCellSide = 16, kCells = kCellSide * kCellSide;

// Directions over the hemisphere around +Z, their density the cosine to it over π, with their basis values beside them.
// There are several independent sets, of which each site takes one and turns it into its own frame: neighbours' errors
// differ, and yet no basis value is computed for a ray.
struct HemisphereSamples {
  int bands = 0;
  std::size_t num_sets = 0;
  std::size_t set_size = 0;    // samples of one set
  std::size_t row_size = 0;    // Lanes of one sample
  std::vector<float> x, y, z;  // set by set
  std::vector<Lanes> rows;     // Y_0 … of each direction, zero from coefficient bands² on

  const Lanes* row(std::size_t set, std::size_t sample) const {
    return rows.data() + (set * set_size + sample) * row_size;
  }
};

// Every beginning of a set of a length of a power of two is spread as evenly as can be (sobol.h). Where `by_cell`,
// set_size is a multiple of kCells, and sample kCells · k + c is the k-th of those in cell c; each cell's first samples
// are spread as evenly within it. Takes 4 bands² bytes a sample.
HemisphereSamples make_hemisphere_samples(int bands, std::size_t set_size, bool by_cell, std::size_t num_sets,
                                          std::uint64_t seed, int threads);

// Where the square that is cut into cells goes: a direction with the density cos θ/π.
Vec3d lift_to_hemisphere(double u, double v);

// Lanes of a row with so many bands.
std::size_t row_size_of(int bands);

// sums[i] += Σ_j weights[j] · value i of the row picks[j].
void add_rows(const Lanes* rows, std::size_t row_size, std::span<const std::uint32_t> picks,
              std::span<const float> weights, std::span<double> sums);

}  // namespace shlight
