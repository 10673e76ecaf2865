#include "shlight/sh/window.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "shlight/sh/minimum.h"
#include "shlight/sh/zonal.h"

namespace shlight {
namespace {

using std::numbers::pi;

double channel_of(Rgb c, int channel) {
  return channel == 0 ? c.r : channel == 1 ? c.g : c.b;
}

// The channel of least certified minimum, among those with a positive mean.
template <class Find>
CertifiedMinimum find_darkest(const RgbCoefficients& coefficients, Find&& find) {
  CertifiedMinimum darkest{std::numeric_limits<double>::infinity(), 0, {0, 1, 0}};
  for (int channel = 0; channel < 3; ++channel) {
    std::vector<double> values;
    for (const Rgb c : coefficients.values()) values.push_back(channel_of(c, channel));
    if (!(values[0] > 0)) continue;
    const CertifiedMinimum minimum = find(values);
    if (minimum.lower_bound < darkest.lower_bound) darkest = minimum;
    if (darkest.lower_bound < 0 && darkest.value < 0) break;
  }
  return darkest;
}

double contrast(const RgbCoefficients& coefficients) {
  double power = 0;
  for (std::size_t i = 1; i < coefficients.size(); ++i) power += std::pow(luminance(coefficients[i]), 2);
  return std::sqrt(power);
}

}  // namespace

double window_factor(Window window, double strength, int l) {
  assert(strength >= 0 && l >= 0);
  const double t = l * strength, laplacian = l * (l + 1.0);
  switch (window) {
    case Window::kHann:
      return t < 1 ? 0.5 * (1 + std::cos(pi * t)) : 0;
    case Window::kLanczos:
      return t == 0 ? 1 : t < 1 ? std::sin(pi * t) / (pi * t) : 0;
    case Window::kLaplacian:
      return 1 / (1 + strength * laplacian * laplacian);
  }
  return 1;
}

RgbCoefficients apply_window(Window window, double strength, const RgbCoefficients& coefficients) {
  RgbCoefficients result = coefficients;
  for (int l = 0; l < coefficients.bands(); ++l)
    for (int m = -l; m <= l; ++m) result.at(l, m) = window_factor(window, strength, l) * coefficients.at(l, m);
  return result;
}

AutoWindow make_auto_window(Window window, Positive positive, const RgbCoefficients& coefficients) {
  assert(coefficients.bands() >= 1);
  const auto shown_at = [&](double strength) {
    const RgbCoefficients windowed = apply_window(window, strength, coefficients);
    return positive == Positive::kIrradiance ? irradiance_from_radiance(windowed) : windowed;
  };
  const auto is_enough = [&](double strength) {
    const auto sign = [&](const std::vector<double>& values) {
      return find_sign_of_minimum(values, coefficients.bands());
    };
    return find_darkest(shown_at(strength), sign).lower_bound >= 0;
  };

  double high = 0;
  if (!is_enough(0)) {
    // Doubling from a strength that does nothing finds one that is enough: in the end only the mean is left, which is
    // positive. Bisection then keeps `high` certified.
    double low = 0;
    high = 1e-6;
    while (!is_enough(high)) {
      low = high;
      high *= 2;
    }
    while (high - low > 1e-3 * high) {
      const double middle = 0.5 * (low + high);
      (is_enough(middle) ? high : low) = middle;
    }
  }
  AutoWindow result;
  const CertifiedMinimum darkest = find_darkest(shown_at(high), [&](const std::vector<double>& values) {
    return find_minimum(values, coefficients.bands(), 1e-4);
  });
  result.strength = high;
  result.coefficients = apply_window(window, high, coefficients);
  // Both searches prove their bound; the one that only looked for the sign has proved zero. A light without a channel
  // to look at is zero as well.
  result.lower_bound = std::isfinite(darkest.lower_bound) ? std::max(darkest.lower_bound, 0.0) : 0;
  result.darkest = darkest.direction;
  const double before = contrast(coefficients);
  result.contrast_kept = before > 0 ? contrast(result.coefficients) / before : 1;
  return result;
}

}  // namespace shlight
