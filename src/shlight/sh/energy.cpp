#include "shlight/sh/energy.h"

#include <numbers>

namespace shlight {

std::vector<double> energy_per_band(const RgbCoefficients& coefficients) {
  std::vector<double> energy;
  for (int l = 0; l < coefficients.bands(); ++l) {
    double sum = 0;
    for (int m = -l; m <= l; ++m) {
      const Rgb c = coefficients.at(l, m);
      sum += c.r * c.r + c.g * c.g + c.b * c.b;
    }
    energy.push_back(sum);
  }
  return energy;
}

std::vector<double> energy_per_band(std::span<const double> kernel) {
  std::vector<double> energy;
  for (std::size_t l = 0; l < kernel.size(); ++l)
    energy.push_back((2 * static_cast<double>(l) + 1) / (4 * std::numbers::pi) * kernel[l] * kernel[l]);
  return energy;
}

std::optional<int> bands_for_energy(std::span<const double> energy, double share, double total) {
  double sum = 0;
  for (std::size_t l = 0; l < energy.size(); ++l)
    if ((sum += energy[l]) >= share * total) return static_cast<int>(l) + 1;
  return {};
}

}  // namespace shlight
