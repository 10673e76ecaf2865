#include <cmath>
#include <functional>
#include <numbers>

#include "shlight/report/basis_figures.h"
#include "shlight/report/errata.h"
#include "shlight/sh/project.h"
#include "shlight/sh/zonal.h"

namespace shlight {
namespace {

constexpr double kPi = std::numbers::pi;

// ∫ f over [low, high] by Gauss's rule.
double integrate(double low, double high, const std::function<double(double)>& f) {
  static const GaussLegendre rule = make_gauss_legendre(64);
  double sum = 0;
  for (std::size_t i = 0; i < rule.nodes.size(); ++i)
    sum += rule.weights[i] * f((low + high) / 2 + (high - low) / 2 * rule.nodes[i]);
  return (high - low) / 2 * sum;
}

// ∫ over the hemisphere about +z of a function of z alone.
double integrate_hemisphere(const std::function<double(double z)>& f) {
  return 2 * kPi * integrate(0, 1, f);
}

double legendre(int n, double x) {
  return eval_associated_legendre(n, 0, x);
}

double zonal_norm(int n) {
  return std::sqrt((2 * n + 1) / (4 * kPi));
}

// A_n = 2π ∫ Y_n0 cos θ sin θ dθ over the upper hemisphere.
double cosine_lobe_by_quadrature(int n) {
  return integrate_hemisphere([n](double z) { return zonal_norm(n) * legendre(n, z) * z; });
}

// n! / (2^n ((n/2)!)²) for even n.
double central_factor(int n) {
  double factor = 1;
  for (int k = 1; k <= n / 2; ++k) factor *= (k + n / 2) / (4.0 * k);
  return factor;
}

std::vector<Erratum> radiometry_errata() {
  // A dome of radiance 1 around a point of the floor: all of it faces the point.
  const double dome = integrate_hemisphere([](double) { return 1.0; });
  const double weighted = integrate_hemisphere([](double z) { return z; });
  return {
      {"geometry-term", "3.1.2", "dω′<sub>i</sub> cosθ<sub>o</sub> dA = G dA",
       "dω′<sub>i</sub> cosθ′<sub>i</sub> = G dA", "irradiance under a dome of radiance 1", dome, weighted, kPi,
       "π, known in closed form"},
      {"reflecting-point", "3.2", "ρ(x″)/π, of the point that is looked from", "ρ(x′)/π, of the point that reflects",
       "radiance of a floor of ρ = ½ under that dome, seen from something black", 0.0, 0.5 / kPi * weighted, 0.5,
       "a Lambertian floor sends back ρ times the dome's radiance"},
  };
}

std::vector<Erratum> basis_errata() {
  // ∫ (√2 K sin(|m|φ) P)² for l = 2, |m| = 1: π from the azimuth. P_2^−1 is −P_2^1/6.
  const double k2 = 5 / (4 * kPi) / 6;
  const double norm =
      2 * k2 * kPi * integrate(-1, 1, [](double x) { return std::pow(eval_associated_legendre(2, 1, x), 2); });
  // L = 1 + x at the normal +x: L00 = √4π and L11 = √(4π/3), with the phase −√(4π/3).
  RgbCoefficients light(3), phased(3);
  light[0] = phased[0] = std::sqrt(4 * kPi) * Rgb{1, 1, 1};
  light.at(1, 1) = std::sqrt(4 * kPi / 3) * Rgb{1, 1, 1};
  phased.at(1, 1) = -1.0 * light.at(1, 1);
  const auto irradiance = [](const RgbCoefficients& c) { return eval_irradiance_polynomial(c, {1, 0, 0}).r; };
  const auto squared = [](int n) { return integrate(-1, 1, [n](double x) { return std::pow(legendre(n, x), 2); }); };
  double products = 0, wanted = 0;
  for (int l = 0; l <= 3; ++l) products += 2 * l + 1;
  for (int l = 0; l <= 2; ++l) wanted += 2 * l + 1;
  return {
      {"negative-m", "4.2", "P<sub>l</sub><sup>m</sup> for m &lt; 0", "P<sub>l</sub><sup>|m|</sup>",
       "∫ (y<sub>2</sub><sup>−1</sup>)²", norm / 36, norm, 1, "the basis is orthonormal"},
      {"phase", "4.2, 9.4", "a basis with the phase (−1)<sup>m</sup>, a shader without", "one of the two in both",
       "irradiance of L = 1 + x on a surface that faces +x", irradiance(phased), irradiance(light),
       integrate_hemisphere([](double z) { return (1 + z) * z; }), "quadrature of L max(0, cosθ)"},
      {"legendre-norm", "4.2", "∫ P<sub>n</sub>² = 1", "∫ P<sub>n</sub>² = 2/(2n+1)", "∫ P<sub>2</sub>²", 1.0, 2.0 / 5,
       squared(2), "quadrature"},
      {"double-factorial",
       "4.2",
       "even n!! for n &lt; 0",
       "for n &gt; 0",
       "6!!",
       {},
       6 * 4 * 2,
       8 * std::tgamma(4.0),
       "2³ · 3!"},
      {"sums", "4.2.1", "sums over l = 0 … n", "l = 0 … n−1", "functions of three bands", products, wanted, 9,
       "n², as the thesis says below the sum"},
  };
}

double project_mean(const SphereFunction& f) {
  return project_quadrature(f, 1).coefficients[0].r;
}

std::vector<Erratum> light_errata() {
  const auto light = [](double first) {
    return [first](Vec3d d) {
      const double phi = std::atan2(d.y, d.x), s = std::sqrt(std::max(0.0, 1 - d.z * d.z));
      const double value = std::max(0.0, first * d.z - 4) + std::max(0.0, 4 * s * std::cos(phi - 2.5) - 3);
      return Rgb{value, value, value};
    };
  };
  // Both lobes are zonal: 2π Y00 ∫ (a z − b) dz from b/a to 1 is 2π Y00 (a − b)²/2a.
  const double truth = 2 * kPi * zonal_norm(0) * (1.0 / 10 + 1.0 / 8);
  return {{"light", "6", "max(0.5·cosθ − 4), nowhere above 0", "max(0, 5 cosθ − 4)", "L<sub>00</sub> of the light",
           project_mean(light(0.5)), project_mean(light(5)), truth, "closed form of its two lobes", 1e-4}};
}

std::vector<Erratum> lobe_errata() {
  const double even4 = 2 * kPi * zonal_norm(4) * central_factor(4);
  const double around = integrate(0, 2 * kPi, [](double theta) {
    return 2 * kPi * zonal_norm(2) * legendre(2, std::cos(theta)) * std::cos(theta) * std::sin(theta);
  });
  const double with_pl = integrate_hemisphere([](double z) { return zonal_norm(2) * legendre(2, z) * legendre(2, z); });
  const double slope = std::log2(std::abs(cosine_lobe_by_quadrature(40) / cosine_lobe_by_quadrature(20)));
  return {
      {"limit", "7.3 (4)", "∫ from 0 to 2π", "from 0 to π/2", "A<sub>2</sub>", around, cosine_lobe(2),
       cosine_lobe_by_quadrature(2), "quadrature over the hemisphere"},
      {"formula-5", "7.3 (5)", "∫ P<sub>n</sub> P<sub>l</sub>", "∫ P<sub>n</sub> P<sub>1</sub>", "A<sub>2</sub>",
       with_pl, cosine_lobe(2), cosine_lobe_by_quadrature(2), "quadrature over the hemisphere"},
      {"odd", "7.3 (6)", "A<sub>n</sub> = 0 for odd n ≥ 1", "for odd n &gt; 1", "A<sub>1</sub>", 0.0, cosine_lobe(1),
       cosine_lobe_by_quadrature(1), "quadrature"},
      {"denominator", "7.3 (6)", "(n+2)(n+1)", "(n+2)(n−1)", "A<sub>4</sub>", -even4 / (6 * 5), -even4 / (6 * 3),
       cosine_lobe_by_quadrature(4), "quadrature"},
      {"sign",
       "7.3 (6)",
       "(−1)<sup>(n−1)/2</sup>, imaginary for even n",
       "(−1)<sup>n/2−1</sup>",
       "A<sub>4</sub>",
       {},
       cosine_lobe(4),
       cosine_lobe_by_quadrature(4),
       "quadrature"},
      {"decay", "7.3", "A<sub>n</sub> ~ n<sup>−1/2</sup>", "n<sup>−2</sup>", "exponent of A<sub>n</sub>", -0.5, -2,
       slope, "slope of quadrature from n = 20 to 40", 0.03},
  };
}

}  // namespace

bool Erratum::shown() const {
  const auto holds = [&](double value) {
    return at_most ? value <= true_value : std::abs(value - true_value) <= tolerance * std::abs(true_value);
  };
  return holds(corrected_value) && !(printed_value && holds(*printed_value));
}

std::vector<Erratum> harmonic_errata() {
  std::vector<Erratum> all;
  for (auto errata : {radiometry_errata, basis_errata, light_errata, lobe_errata})
    for (Erratum& erratum : errata()) all.push_back(std::move(erratum));
  return all;
}

}  // namespace shlight
