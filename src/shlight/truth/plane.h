#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace shlight {

// One number a pixel, rows from the top.
struct Plane {
  int width = 0;
  int height = 0;
  std::vector<float> values;

  Plane() = default;
  Plane(int w, int h) : width(w), height(h), values(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
  float& at(int x, int y) { return values[index(x, y)]; }
  float at(int x, int y) const { return values[index(x, y)]; }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
};

// The mean of all values, summed in double; 0 of none.
double mean(const Plane& plane);

// Σ_ij along_x[i] along_y[j] plane(x + i − r, y + j − r), with kernels of an odd length 2r + 1 and, beyond the border,
// what the border has.
Plane filter_separably(const Plane& plane, std::span<const double> along_x, std::span<const double> along_y,
                       int threads);

// exp(−x²/2σ²) at −radius … radius, adding up to 1.
std::vector<double> make_gaussian(double sigma, int radius);

}  // namespace shlight
