#pragma once

#include <vector>

#include "shlight/light/light.h"

namespace shlight {

// Directions in proportion to how bright a light is there: to the mean of its channels' absolute values, since lights
// that are coefficients may be negative, in each pixel of its lat-long picture. Pictures that are lat-long are sampled
// pixel by pixel, so that radiance over density is the same everywhere; other lights through a picture of 1024 x 512
// pixels, of which the brightest, as those of a sun, are parted into 32 x 32 again, so that hardly a sample of them
// misses a disc that fills them only in part. Uniform for a light that is black everywhere.
class LightSampler {
 public:
  // Takes 4 bytes a pixel. The light is not needed afterwards. `threads`: 0 for all there are.
  explicit LightSampler(const Light& light, int threads = 0);

  struct Sample {
    Vec3d direction;  // unit
    double pdf = 0;   // per steradian; above 0
  };
  // From two numbers in [0, 1); numbers near each other give directions near each other almost everywhere.
  Sample sample(double u, double v) const;

  // The density of `sample` in a unit direction.
  double pdf(Vec3d direction) const;

 private:
  double probability(int x, int y) const;  // of a pixel
  double solid_angle(int y) const;         // of each pixel of a row

  // A pixel that is parted: the probability of all its rows up to each, and within each row of all parts up to each.
  struct Parted {
    std::size_t pixel = 0;
    std::vector<float> rows, columns;
  };
  Parted part(const Light& light, std::size_t pixel, double mean) const;
  const Parted* find_parted(std::size_t pixel) const;
  Vec3d direction(double x, double y) const;  // of a point of the picture, in pixels; y evenly in solid angle

  int width_, height_;
  std::vector<float> rows_;     // the probability of all rows up to each: height + 1
  std::vector<float> columns_;  // within each row, of all pixels up to each: (width + 1) · height
  std::vector<Parted> parted_;  // by pixel
};

}  // namespace shlight
