#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace shlight {

// Random numbers of paths, in pairs: one for the place in the pixel, three for each place where light is reflected.
// Every pair of every pixel has its own well-spread set of points in the unit square, one for each path: a scrambled
// Sobol set (sobol.h) in a random sequence, so that pairs have nothing to do with each other, moved around the square
// by a random step [1]. Each point by itself is uniform. Replicates have independent steps: the scatter of their means
// is the error of the mean over all.
//
// [1] Cranley & Patterson 1976, Randomization of Number Theoretic Methods for Multiple Integration, SIAM Journal on
//     Numerical Analysis 13(6).
class PathSamples {
 public:
  PathSamples(std::size_t size, std::uint64_t seed, int threads);

  std::size_t size() const { return size_; }

  struct Point {
    double x = 0, y = 0;  // in [0, 1)
  };
  Point at(std::uint64_t pixel, std::uint64_t replicate, std::uint64_t pair, std::size_t path) const;

 private:
  std::size_t size_;
  std::uint64_t seed_;
  std::vector<Point> points_;  // set by set
};

}  // namespace shlight
