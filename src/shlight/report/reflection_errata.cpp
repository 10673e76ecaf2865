#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "shlight/brdf/cook_torrance.h"
#include "shlight/brdf/oren_nayar.h"
#include "shlight/brdf/ward.h"
#include "shlight/report/errata.h"
#include "shlight/sh/project.h"

// The thesis's reflection models as they are printed, here and nowhere else, beside those of brdf/.

namespace shlight {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr Vec3d kNormal = {0, 0, 1};

using Model = std::function<double(Vec3d s, Vec3d v)>;

Model model_of(const Brdf& brdf) {
  return [&brdf](Vec3d s, Vec3d v) { return brdf.eval(s, v).r; };
}

Vec3d direction(double polar_degrees, double azimuth_degrees) {
  const double theta = polar_degrees * kPi / 180, phi = azimuth_degrees * kPi / 180;
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

Vec3d half_vector(Vec3d s, Vec3d v) {
  const Vec3d h = s + v;
  return (1 / std::sqrt(dot(h, h))) * h;
}

// ∫ f_r(s, v) cos θ_v dv: what share of the light from s is reflected.
double reflected_share(const Model& f, Vec3d s) {
  static const GaussLegendre rule = make_gauss_legendre(256);
  constexpr int kAzimuths = 256;
  double sum = 0;
  for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
    const double z = (rule.nodes[i] + 1) / 2, r = std::sqrt(1 - z * z);
    for (int k = 0; k < kAzimuths; ++k) {
      const double phi = 2 * kPi * (k + 0.5) / kAzimuths;
      sum += rule.weights[i] / 2 * 2 * kPi / kAzimuths * z * f(s, {r * std::cos(phi), r * std::sin(phi), z});
    }
  }
  return sum;
}

// f_r(s, v)/f_r(v, s), 1 for what is reciprocal.
double reciprocity(const Model& f) {
  const Vec3d s = direction(60, 20), v = direction(20, 80);
  return f(s, v) / f(v, s);
}

std::vector<Erratum> oren_nayar_errata() {
  const double square = 0.5 * 0.5;
  const double printed_a = 1 - 0.5 * square / (square - 0.33);
  const auto rough = make_oren_nayar({1, 1, 1}, 0.5), smooth = make_oren_nayar({1, 1, 1}, 0);
  const Vec3d low = direction(60, 0);
  return {
      {"oren-nayar-a", "8.1.1", "A with σ² − 0.33 below the line", "σ² + 0.33",
       "share that a white surface of σ = ½ reflects of light along its normal", printed_a,
       reflected_share(model_of(*rough), kNormal), 1, "no more than it gets", 1e-6, true},
      {"oren-nayar-b", "8.1.1", "B with σ² − 0.09 below the line", "σ² + 0.09", "B at σ = 0.3",
       std::numeric_limits<double>::infinity(), 0.45 * 0.09 / (0.09 + 0.09), 0.45, "what B tends to for large σ", 1e-6,
       true},
      {"oren-nayar-factor", "8.1.1", "a factor N·L, no 1/π: radiance, not f<sub>r</sub>", "ρ/π (A + B …)",
       "share that a smooth white surface (σ = 0) reflects of light from 60°",
       reflected_share([](Vec3d s, Vec3d) { return s.z; }, low), reflected_share(model_of(*smooth), low), 1,
       "Lambert's white surface reflects all"},
  };
}

std::vector<Erratum> ward_errata() {
  constexpr double kX = 0.05, kY = 0.1;
  const auto round = make_ward({{0, 0, 0}, {1, 1, 1}, kY, kY, WardForm::kWard});
  const auto slim = make_ward({{0, 0, 0}, {1, 1, 1}, kX, kY, WardForm::kWard});
  const auto white = make_ward({{1, 1, 1}, {0, 0, 0}, kY, kY, WardForm::kWard});
  const Model printed_exponent = [](Vec3d s, Vec3d v) {
    const Vec3d h = half_vector(s, v);
    const double tangent2 = (1 - h.z * h.z) / (h.z * h.z);
    return std::exp(-tangent2 / (kX * kX + kY * kY)) / (4 * kPi * kX * kY * std::sqrt(s.z * v.z));
  };
  // The azimuth is the view's.
  const Model printed_azimuth = [](Vec3d s, Vec3d v) {
    const Vec3d h = half_vector(s, v);
    const double tangent2 = (1 - h.z * h.z) / (h.z * h.z), r2 = v.x * v.x + v.y * v.y;
    const double slope = (v.x * v.x / (0.2 * 0.2) + v.y * v.y / (0.6 * 0.6)) / r2;
    return std::exp(-tangent2 * slope) / (4 * kPi * 0.2 * 0.6 * std::sqrt(s.z * v.z));
  };
  const auto wide = make_ward({{0, 0, 0}, {1, 1, 1}, 0.2, 0.6, WardForm::kWard});
  const double share = reflected_share(model_of(*round), kNormal);
  return {
      {"ward-factor", "8.1.2", "2πσ²", "4πσ²", "share that a highlight of σ = 0.1 reflects along the normal", 2 * share,
       share, 1, "ρ<sub>s</sub> = 1, for slim highlights", 0.03},
      {"ward-diffuse", "8.1.2", "the diffuse part D", "ρ<sub>d</sub>/π", "share that a white diffuse part reflects",
       reflected_share([](Vec3d, Vec3d) { return 1.0; }, kNormal), reflected_share(model_of(*white), kNormal), 1,
       "a white surface reflects all"},
      {"ward-exponent", "8.1.2", "tan²γ (cos²φ + sin²φ)/(σ<sub>x</sub>² + σ<sub>y</sub>²)",
       "tan²γ (cos²φ/σ<sub>x</sub>² + sin²φ/σ<sub>y</sub>²)",
       "share that a highlight of slopes 0.05 and 0.1 reflects along the normal",
       reflected_share(printed_exponent, kNormal), reflected_share(model_of(*slim), kNormal), 1,
       "ρ<sub>s</sub> = 1, for slim highlights", 0.03},
      {"ward-azimuth", "8.1.2", "φ between view and tangent plane", "φ of the half vector in the tangent frame",
       "f<sub>r</sub>(s, v)/f<sub>r</sub>(v, s)", reciprocity(printed_azimuth), reciprocity(model_of(*wide)), 1,
       "Helmholtz's reciprocity"},
  };
}

std::vector<Erratum> cook_torrance_errata() {
  const auto mirror = make_cook_torrance(0.1, {1, 1, 1}), glass = make_cook_torrance(0.5, {0.04, 0.04, 0.04});
  const double share = reflected_share(model_of(*mirror), kNormal);
  const Model printed_fresnel = [&](Vec3d s, Vec3d v) {
    const auto fresnel = [](double cosine) { return 0.04 + 0.96 * std::pow(1 - cosine, 5); };
    return glass->eval(s, v).r * fresnel(v.z) / fresnel(dot(v, half_vector(s, v)));
  };
  const Vec3d sum = kNormal + kNormal;
  return {
      {"cook-torrance-factor", "8.1.3", "neither π nor 4", "π m² cos⁴α in D, 4 N·L N·V below F D G",
       "share that a nearly smooth mirror (m = 0.1, F₀ = 1) reflects along the normal", 4 * kPi * share, share, 1,
       "a mirror reflects all", 0.03},
      {"cook-torrance-fresnel", "8.1.3", "F of N·V", "F of V·H", "f<sub>r</sub>(s, v)/f<sub>r</sub>(v, s)",
       reciprocity(printed_fresnel), reciprocity(model_of(*glass)), 1, "Helmholtz's reciprocity"},
      {"half-vector", "8.1.3", "H = L + V", "(L + V)/|L + V|", "N·H for L = V = N", dot(kNormal, sum),
       dot(kNormal, half_vector(kNormal, kNormal)), 1, "the cosine of an angle of 0°"},
  };
}

}  // namespace

std::vector<Erratum> reflection_errata() {
  std::vector<Erratum> all;
  for (auto errata : {oren_nayar_errata, ward_errata, cook_torrance_errata})
    for (Erratum& erratum : errata()) all.push_back(std::move(erratum));
  return all;
}

}  // namespace shlight
