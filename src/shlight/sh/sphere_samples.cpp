#include "shlight/sh/sphere_samples.h"

#include <cassert>
#include <cmath>
#include <numbers>

#include "shlight/sh/basis.h"

namespace shlight {
namespace {

// SplitMix64 (Steele, Lea & Flood 2014): the same numbers from every compiler and library, which <random>'s
// distributions do not promise.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  // Uniform in [0, 1), 53 bits.
  double operator()() {
    std::uint64_t v = state_ += 0x9e3779b97f4a7c15u;
    v = (v ^ (v >> 30)) * 0xbf58476d1ce4e5b9u;
    v = (v ^ (v >> 27)) * 0x94d049bb133111ebu;
    return static_cast<double>((v ^ (v >> 31)) >> 11) * 0x1p-53;
  }

 private:
  std::uint64_t state_;
};

}  // namespace

SphereSamples make_sphere_samples(int bands, int strata, std::uint64_t seed) {
  assert(bands >= 0 && strata >= 0);
  SphereSamples samples;
  samples.bands = bands;
  samples.strata = strata;
  const std::size_t count = static_cast<std::size_t>(strata) * static_cast<std::size_t>(strata);
  const std::size_t coefficients = static_cast<std::size_t>(num_coefficients(bands));
  samples.directions.reserve(count);
  samples.basis.resize(count * coefficients);

  Random random(seed);
  for (int i = 0; i < strata; ++i)
    for (int j = 0; j < strata; ++j) {
      const double z = 1 - 2 * (i + random()) / strata;
      const double phi = 2 * std::numbers::pi * (j + random()) / strata;
      const double s = std::sqrt(std::max(0.0, 1 - z * z));
      const Vec3d direction = {s * std::cos(phi), s * std::sin(phi), z};
      eval_basis(bands, direction,
                 std::span<double>(samples.basis).subspan(samples.directions.size() * coefficients, coefficients));
      samples.directions.push_back(direction);
    }
  return samples;
}

int strata_for(std::int64_t samples) {
  return static_cast<int>(std::ceil(std::sqrt(static_cast<double>(samples))));
}

}  // namespace shlight
