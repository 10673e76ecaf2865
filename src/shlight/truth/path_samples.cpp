#include "shlight/truth/path_samples.h"

#include <utility>

#include "shlight/core/parallel.h"
#include "shlight/transfer/sobol.h"

namespace shlight {
namespace {

// More than the pairs of a path of 64 bounces, of which therefore none has another's set.
constexpr std::size_t kSets = 256;

double wrapped(double v) {
  return v < 1 ? v : v - 1;
}

}  // namespace

PathSamples::PathSamples(std::size_t size, std::uint64_t seed, int threads)
    : size_(size), seed_(mix_bits(seed)), points_(kSets * size) {
  parallel_for(kSets, threads, [&](std::size_t set) {
    std::vector<double> x(size), y(size);
    make_scrambled_sobol(seed_ + set, x, y);
    Point* points = points_.data() + set * size;
    for (std::size_t i = 0; i < size; ++i) points[i] = {x[i], y[i]};
    // Fisher and Yates: every sequence is as likely as any other.
    for (std::size_t i = size; i > 1; --i) std::swap(points[i - 1], points[mix_bits(mix_bits(seed_ ^ set) + i) % i]);
  });
}

PathSamples::Point PathSamples::at(std::uint64_t pixel, std::uint64_t replicate, std::uint64_t pair,
                                   std::size_t path) const {
  const std::uint64_t of_pixel = mix_bits(mix_bits(seed_ ^ pixel) + replicate);
  const Point p = points_[(of_pixel + pair) % kSets * size_ + path];
  const std::uint64_t step = mix_bits(of_pixel ^ mix_bits(pair));
  return {wrapped(p.x + static_cast<double>(step >> 32) * 0x1p-32),
          wrapped(p.y + static_cast<double>(step & 0xffffffffu) * 0x1p-32)};
}

}  // namespace shlight
