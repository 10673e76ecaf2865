#include "shlight/transfer/ray_stream.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "shlight/sh/clones.h"

namespace shlight {
namespace {

// The sphere as an octahedron, unfolded to a square [1], cut into kBins x kBins bins, which a Morton curve passes.
//
// [1] Meyer et al. 2010, On Floating-Point Normal Vectors, EGSR.
constexpr int kBinBits = 6;
constexpr std::size_t kBins = std::size_t{1} << kBinBits;

SHLIGHT_ALWAYS_INLINE inline std::uint32_t spread_bits(std::uint32_t v) {
  v = (v | v << 4) & 0x0f0fu;
  v = (v | v << 2) & 0x3333u;
  return (v | v << 1) & 0x5555u;
}

// Directions from a frame with these axes to the world, and their bins.
SHLIGHT_CLONES void turn_to_world(const float* lx, const float* ly, const float* lz, const std::uint32_t* samples,
                                  std::size_t count, const float* axes, float* x, float* y, float* z,
                                  std::uint16_t* bins) {
  for (std::size_t j = 0; j < count; ++j) {
    const std::uint32_t k = samples[j];
    x[j] = lx[k] * axes[0] + ly[k] * axes[3] + lz[k] * axes[6];
    y[j] = lx[k] * axes[1] + ly[k] * axes[4] + lz[k] * axes[7];
    z[j] = lx[k] * axes[2] + ly[k] * axes[5] + lz[k] * axes[8];
  }
  for (std::size_t j = 0; j < count; ++j) {
    const float ax = x[j] < 0 ? -x[j] : x[j], ay = y[j] < 0 ? -y[j] : y[j], az = z[j] < 0 ? -z[j] : z[j];
    const float scale = 1 / (ax + ay + az);
    const float sx = x[j] < 0 ? -1.0f : 1.0f, sy = y[j] < 0 ? -1.0f : 1.0f;
    // The lower half folds over the upper half's corners.
    const float u = z[j] < 0 ? sx * (1 - ay * scale) : x[j] * scale;
    const float v = z[j] < 0 ? sy * (1 - ax * scale) : y[j] * scale;
    constexpr float kHalf = 0.4999f * kBins;
    const std::uint32_t column = static_cast<std::uint32_t>(static_cast<int>(kHalf * (u + 1)));
    const std::uint32_t row = static_cast<std::uint32_t>(static_cast<int>(kHalf * (v + 1)));
    bins[j] = static_cast<std::uint16_t>(spread_bits(column) | spread_bits(row) << 1);
  }
}

}  // namespace

void RayStream::fill(const HemisphereSamples& samples, std::span<const RaySegment> segments) {
  std::size_t total = 0;
  for (const RaySegment& s : segments) total += s.samples.size();
  x_.resize(total), y_.resize(total), z_.resize(total), bins_.resize(total), rays_.resize(total);

  std::size_t begin = 0;
  for (const RaySegment& s : segments) {
    const std::size_t set = s.set * samples.set_size;
    const Vec3f a = vec_cast<float>(s.frame.x), b = vec_cast<float>(s.frame.y), c = vec_cast<float>(s.frame.z);
    const float axes[9] = {a.x, a.y, a.z, b.x, b.y, b.z, c.x, c.y, c.z};
    turn_to_world(samples.x.data() + set, samples.y.data() + set, samples.z.data() + set, s.samples.data(),
                  s.samples.size(), axes, x_.data() + begin, y_.data() + begin, z_.data() + begin,
                  bins_.data() + begin);
    begin += s.samples.size();
  }

  // A counting sort.
  next_.assign(kBins * kBins + 1, 0);
  for (const std::uint16_t bin : bins_) ++next_[bin + 1u];
  for (std::size_t bin = 1; bin < next_.size(); ++bin) next_[bin] += next_[bin - 1];
  std::size_t j = 0;
  for (const RaySegment& s : segments)
    for (const std::size_t end = j + s.samples.size(); j < end; ++j) {
      Ray& ray = rays_[next_[bins_[j]]++];
      ray.origin = s.origin;
      ray.near = 0;
      ray.direction = {x_[j], y_[j], z_[j]};
      ray.time = 0;
      ray.far = std::numeric_limits<float>::infinity();
      ray.mask = ~0u;
      ray.id = static_cast<std::uint32_t>(j);
      ray.flags = 0;
    }
}

}  // namespace shlight
