#include "shlight/sh/kernel.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace shlight {
namespace {

using std::numbers::pi;

std::vector<double> zeros(int bands) {
  assert(bands >= 0);
  return std::vector<double>(static_cast<std::size_t>(bands));
}

// (−1)^l k̂_l: the function mirrored, k(−z).
std::vector<double> mirrored(std::vector<double> kernel) {
  for (std::size_t l = 1; l < kernel.size(); l += 2) kernel[l] = -kernel[l];
  return kernel;
}

}  // namespace

// From ∫_0^1 z^s P_l(z) dz = √π 2^{−s−1} Γ(1+s) / (Γ(1 + (s−l)/2) Γ((s+l+3)/2)) two degrees apart.
std::vector<double> make_cosine_power_kernel(int bands, double exponent) {
  assert(exponent >= 0);
  std::vector<double> kernel = zeros(bands);
  for (std::size_t i = 0; i < kernel.size(); ++i) {
    const double l = static_cast<double>(i);
    kernel[i] = i < 2 ? 2 * pi / (exponent + 1 + l) : kernel[i - 2] * (exponent - l + 2) / (exponent + l + 1);
  }
  return kernel;
}

// Legendre's equation, ((1 − z²) P_l')' = −l(l+1) P_l, integrated from cos α to 1: sin²α P_l'(cos α) / (l(l+1)). The
// difference (P_{l−1} − P_{l+1})/(2l+1), which is the same, loses the digits of small discs.
std::vector<double> make_cap_kernel(int bands, double half_angle) {
  assert(half_angle >= 0 && half_angle <= pi);
  std::vector<double> kernel = zeros(bands);
  const double c = std::cos(half_angle), s = std::sin(half_angle);
  double before = 1, here = c;         // P_{l−1} and P_l
  double slope_before = 0, slope = 1;  // and their derivatives
  for (std::size_t i = 0; i < kernel.size(); ++i) {
    const double l = static_cast<double>(i);
    if (i == 0) {
      kernel[0] = 4 * pi * std::pow(std::sin(0.5 * half_angle), 2);
      continue;
    }
    kernel[i] = 2 * pi * s * s * slope / (l * (l + 1));
    const double slope_after = slope_before + (2 * l + 1) * here;
    const double after = ((2 * l + 1) * c * here - l * before) / (l + 1);
    before = here, here = after;
    slope_before = slope, slope = slope_after;
  }
  return kernel;
}

std::vector<double> make_henyey_greenstein_kernel(int bands, double g) {
  assert(std::abs(g) <= 1);
  std::vector<double> kernel = zeros(bands);
  double power = 1;
  for (double& factor : kernel) {
    factor = power;
    power *= g;
  }
  return kernel;
}

std::vector<double> make_rayleigh_kernel(int bands) {
  std::vector<double> kernel = zeros(bands);
  if (bands > 0) kernel[0] = 1;
  if (bands > 2) kernel[2] = 0.1;
  return kernel;
}

// With x = 1/k, ∫ P_l(z)/(x − z)² dz = −2 Q_l'(x), Q_l the Legendre function of the second kind, and (x² − 1) Q_l' =
// l (x Q_l − Q_{l−1}): the kernel is l (Q_{l−1} − x Q_l). For x > 1 Q_l is the smallest solution of its recursion, so
// that ratios r_l = Q_l/Q_{l−1} are found downwards (Miller's algorithm), best from what they tend to.
std::vector<double> make_schlick_kernel(int bands, double k) {
  assert(std::abs(k) < 1);
  if (k < 0) return mirrored(make_schlick_kernel(bands, -k));
  std::vector<double> kernel = zeros(bands);
  if (bands > 0) kernel[0] = 1;
  if (k < 1e-150) return kernel;
  const double x = 1 / k, limit = k / (1 + std::sqrt((1 - k) * (1 + k)));  // x − √(x² − 1)
  // What is wrong at the start fades like limit^2l.
  constexpr double kDigits = 20, kMaxSteps = 1e6;
  const int start = bands + 2 + static_cast<int>(std::min(kMaxSteps, -kDigits / std::log(limit)));
  std::vector<double> ratios = zeros(bands);
  double ratio = limit;
  for (int l = start; l > 0; --l) {
    ratio = l / ((2 * l + 1) * x - (l + 1) * ratio);
    if (l < bands) ratios[static_cast<std::size_t>(l)] = ratio;
  }
  double q = std::atanh(k);  // Q_0
  for (std::size_t i = 1; i < kernel.size(); ++i) {
    kernel[i] = static_cast<double>(i) * q * (1 - x * ratios[i]);
    q *= ratios[i];
  }
  return kernel;
}

// I_{l+1/2}(κ) / I_{1/2}(κ), modified Bessel functions. Their ratios r_l = I_{l+1/2}/I_{l−1/2} obey r_l = 1 / ((2l+1)/κ
// + r_{l+1}), downwards, for I is the smallest solution.
std::vector<double> make_von_mises_fisher_kernel(int bands, double kappa) {
  assert(kappa >= 0);
  std::vector<double> kernel = zeros(bands);
  if (bands > 0) kernel[0] = 1;
  if (kappa == 0) return kernel;
  // What is wrong at the start fades like the product of r², about e^{−l²/κ}; κ / (l + √(l² + κ²)) is not far wrong.
  constexpr double kMaxSteps = 1e7;
  const int start = bands + 30 + static_cast<int>(std::min(kMaxSteps, 10 * std::sqrt(kappa)));
  std::vector<double> ratios = zeros(bands);
  double ratio = kappa / (start + std::hypot(start, kappa));
  for (int l = start; l > 0; --l) {
    ratio = 1 / ((2 * l + 1) / kappa + ratio);
    if (l < bands) ratios[static_cast<std::size_t>(l)] = ratio;
  }
  for (std::size_t i = 1; i < kernel.size(); ++i) kernel[i] = kernel[i - 1] * ratios[i];
  return kernel;
}

}  // namespace shlight
