#include "shlight/brdf/project_brdf.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "shlight/core/assert.h"
#include "shlight/sh/basis.h"
#include "shlight/sh/clones.h"
#include "shlight/sh/project.h"
#include "shlight/sh/rotation.h"
#include "shlight/sh/zonal.h"

// Coordinates of a lobe in the half vector. Let t = (t_x, t_y) = (h_x, h_y)/h_z be its slopes and v = (sin θ cos φ,
// sin θ sin φ, cos θ). Mirrored at h, the eye sees s = 2 (v·h) h − v, and
//
//     ds = 4 (v·h) dh,   dh = h_z³ dt,   h_z² = 1/(1 + |t|²),   v·h = h_z (cos θ + sin θ (t_x cos φ + t_y sin φ)).
//
// On a ray t = r (a, b) from the origin, s is above the horizon where 2 (v·h) h_z > cos θ, which is
//
//     (a² + b²) r² − 2 B r − 1 < 0,   B = tan θ (a cos φ + b sin φ),   so r < r_max = (B + √(B² + a² + b²))/(a² + b²).
//
// r = 0 is always inside: polar coordinates about the origin cover all of the upper hemisphere, with the horizon at
// r_max. Along the ray, a lobe of width 1 falls in r as 1/(1 + r²)^k or quicker, which r = y/(1 − y) makes smooth in y;
// y is stretched at its end by 1 − (1−x)², which turns the square root that Ward's model has at the horizon into a
// straight line.
//
// Cook and Torrance's G = min{1, 2 n·h n·v / v·h, 2 n·h n·s / v·h} has kinks where two of the three are the same. In
// the terms above, with q = 1 + r B = v·h / (h_z cos θ) and S = a² + b², these are
//
//     r = 1/B                                     where the second is 1,
//     3 q − 2 = (q + 2) S r²                      where the third is 1: one root in (0, r_max), as p(0) = 1 and
//     p(r_max) < 0 r = B/S                                     where the second is the third, both below 1 where r² S >
//     1,
//
// at which rays are cut.
//
// Around, with (a, b) = (w_x cos ψ, w_y sin ψ), B = C tan θ cos(ψ − ψ_0). The further the view grazes, the more
// suddenly r_max turns from large to small where B changes its sign: within about cot θ. The four quarters between
// there and the extremes are therefore stretched by a sinh of just that scale.

namespace shlight {
namespace {

using std::numbers::pi;

// Gauss's rule on [0, 1].
struct UnitRule {
  std::vector<double> nodes, weights;
};

UnitRule make_unit_rule(int count) {
  const GaussLegendre rule = make_gauss_legendre(count);
  UnitRule unit;
  for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
    unit.nodes.push_back(0.5 * (1 + rule.nodes[i]));
    unit.weights.push_back(0.5 * rule.weights[i]);
  }
  return unit;
}

// The numbers of nodes that are tried, and their rules, made once.
constexpr std::array<int, 14> kLevels = {6, 8, 12, 16, 20, 24, 28, 32, 40, 48, 64, 96, 128, 192};

const UnitRule& unit_rule(int count) {
  static const std::map<int, UnitRule> kRules = [] {
    std::map<int, UnitRule> rules;
    for (const int level : kLevels) rules.emplace(level, make_unit_rule(level));
    return rules;
  }();
  return kRules.at(count);
}

// What all nodes of one projection share.
struct View {
  Vec3d v;
  double sine, cosine;      // of the polar angle
  double cos_phi, sin_phi;  // of the azimuth; of +x at the pole
};

View make_view(Vec3d v) {
  const double sine = std::sqrt(v.x * v.x + v.y * v.y);
  if (sine <= 0) return {v, 0, 1, 1, 0};
  return {v, sine, v.z, v.x / sine, v.y / sine};
}

SHLIGHT_CLONES void add_scaled(double value, const double* basis, double* sum, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) sum[i] += value * basis[i];
}

// Adds up f_r s·n Y(s) over nodes.
class Sum {
 public:
  Sum(const Brdf& brdf, std::size_t lobe, Vec3d v, int bands)
      : brdf_(brdf), lobe_(lobe), v_(v), bands_(bands), grey_(brdf.traits().grey), basis_(num_coefficients(bands)) {
    for (auto& channel : sums_) channel.resize(basis_.size());
  }

  // One node with its weight in solid angle.
  void add(Vec3d s, double weight) {
    if (!(s.z > 0)) return;  // rounding at the horizon
    const Rgb f = brdf_.eval_lobe(lobe_, s, v_);
    eval_basis(bands_, s, std::span<double>(basis_));
    weight *= s.z;
    add_to(sums_[0], weight * f.r);
    if (grey_) return;
    add_to(sums_[1], weight * f.g);
    add_to(sums_[2], weight * f.b);
  }

  RgbCoefficients result() const {
    RgbCoefficients coefficients(bands_);
    for (std::size_t i = 0; i < coefficients.size(); ++i)
      coefficients[i] = {sums_[0][i], sums_[grey_ ? 0 : 1][i], sums_[grey_ ? 0 : 2][i]};
    return coefficients;
  }

 private:
  void add_to(std::vector<double>& sum, double value) { add_scaled(value, basis_.data(), sum.data(), basis_.size()); }

  const Brdf& brdf_;
  std::size_t lobe_;
  Vec3d v_;
  int bands_;
  bool grey_;
  std::vector<double> basis_;
  std::array<std::vector<double>, 3> sums_;
};

// Integrates over polar angle and azimuth, cut where the view stands and at right angles to it.
void add_hemisphere(const View& view, bool half, int nodes, Sum& sum) {
  const UnitRule& rule = unit_rule(nodes);
  const double theta_v = std::atan2(view.sine, view.cosine);
  const double cuts[] = {0, theta_v, pi / 2};
  for (int part = 0; part < 2; ++part) {
    const double low = cuts[part], span = cuts[part + 1] - low;
    if (span <= 0) continue;
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
      const double theta = low + span * rule.nodes[i], sine = std::sin(theta), cosine = std::cos(theta);
      const double row_weight = span * rule.weights[i] * sine;
      for (int quarter = 0; quarter < (half ? 2 : 4); ++quarter)
        for (std::size_t j = 0; j < rule.nodes.size(); ++j) {
          const double phi = pi / 2 * (quarter + rule.nodes[j]), c = std::cos(phi), s = std::sin(phi);
          const double weight = row_weight * pi / 2 * rule.weights[j] * (half ? 2 : 1);
          sum.add({sine * (c * view.cos_phi - s * view.sin_phi), sine * (s * view.cos_phi + c * view.sin_phi), cosine},
                  weight);
        }
    }
  }
}

// Where rays are cut into pieces: 0, kinks, r_max, ascending.
struct Cuts {
  std::array<double, 5> r{};
  std::size_t count = 0;
  void add(double value) {
    std::size_t at = count++;
    for (; at > 0 && r[at - 1] > value; --at) r[at] = r[at - 1];
    r[at] = value;
  }
};

// The root of p(r) = 3 q − 2 − (q + 2) S r² in (0, r_max), q = 1 + B r, by Newton's steps kept between two ends.
double find_shadowing_kink(double slope, double square, double r_max) {
  double low = 0, high = r_max, r = 0.5 * r_max;
  for (int step = 0; step < 60; ++step) {
    const double q = 1 + slope * r, p = 3 * q - 2 - (q + 2) * square * r * r;
    (p > 0 ? low : high) = r;
    const double derivative = 3 * slope - square * r * (3 * slope * r + 6);
    double next = r - p / derivative;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::abs(next - r) <= 1e-14 * r_max) break;
    r = next;
  }
  return r;
}

Cuts make_cuts(LobeShape shape, double slope, double square, double r_max) {
  Cuts cuts;
  cuts.add(0);
  if (shape == LobeShape::kGrooves) {
    if (slope * r_max > 1) cuts.add(1 / slope);
    cuts.add(find_shadowing_kink(slope, square, r_max));
    if (slope > 0 && slope * slope > square) cuts.add(slope / square);
  }
  cuts.add(r_max);
  return cuts;
}

// y of r.
double to_unit(double r) {
  return r / (1 + r);
}

// Integrates over slopes of the half vector, as derived above.
void add_half_vector(const View& view, const BrdfLobe& lobe, bool half, int nodes, Sum& sum) {
  const UnitRule& rule = unit_rule(nodes);
  const double tangent = view.sine / view.cosine;
  const double wx = lobe.width_x, wy = lobe.width_y;
  const double psi_0 = std::atan2(wy * view.sin_phi, wx * view.cos_phi);
  // No smaller a sine: at the pole the stretch would divide by zero, and is none.
  const double scale = view.cosine / std::max(view.sine, 1e-3), stretch = std::asinh(pi / 2 / scale);
  // Quarters on both sides of ψ_0 ± π/2, where B is zero.
  for (int quarter = 0; quarter < (half ? 2 : 4); ++quarter) {
    const double middle = psi_0 + (quarter < 2 ? pi / 2 : -pi / 2), side = quarter % 2 == 0 ? -1 : 1;
    for (std::size_t j = 0; j < rule.nodes.size(); ++j) {
      const double psi = middle + side * scale * std::sinh(stretch * rule.nodes[j]);
      const double psi_weight = rule.weights[j] * scale * stretch * std::cosh(stretch * rule.nodes[j]) * (half ? 2 : 1);
      const double a = wx * std::cos(psi), b = wy * std::sin(psi), square = a * a + b * b;
      const double slope = tangent * (a * view.cos_phi + b * view.sin_phi);
      const double root = std::sqrt(slope * slope + square);
      const double r_max = slope > 0 ? (slope + root) / square : 1 / (root - slope);
      const Cuts cuts = make_cuts(lobe.shape, slope, square, r_max);
      for (std::size_t piece = 0; piece + 1 < cuts.count; ++piece) {
        const double begin = to_unit(cuts.r[piece]), span = to_unit(cuts.r[piece + 1]) - begin;
        for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
          // 1 − (1−x)² and its derivative.
          const double rest = 1 - rule.nodes[i], y = begin + span * (1 - rest * rest), r = y / (1 - y);
          const double tx = r * a, ty = r * b, hz = 1 / std::sqrt(1 + r * r * square);
          const double vh = hz * view.cosine * (1 + r * slope);
          // The slopes' area is w_x w_y r dr dψ, and dr = (1 + r)² dy.
          const double dr = (1 + r) * (1 + r) * span * 2 * rest * rule.weights[i];
          const double weight = 4 * vh * hz * hz * hz * wx * wy * r * dr * psi_weight;
          const double f = 2 * vh * hz;
          sum.add({f * tx - view.v.x, f * ty - view.v.y, f - view.v.z}, weight);
        }
      }
    }
  }
}

// The coefficients of one lobe; `nodes` along the side of a piece.
RgbCoefficients project_lobe(const Brdf& brdf, std::size_t index, Vec3d v, int bands, int nodes) {
  const BrdfLobe& lobe = brdf.lobes()[index];
  if (lobe.shape == LobeShape::kLambert) {
    RgbCoefficients coefficients(bands);
    const Rgb value = brdf.eval_lobe(index, {0, 0, 1}, v);
    for (int l = 0; l < bands; ++l) coefficients.at(l, 0) = cosine_lobe(l) * value;
    return coefficients;
  }
  // An isotropic model is the same on both sides of the plane of normal and view, so that half of it is enough, with
  // the view turned into φ = 0, and its coefficients back.
  const View given = make_view(v);
  const bool half = brdf.traits().symmetry == BrdfSymmetry::kIsotropic;
  const View view = half ? make_view({given.sine, 0, given.cosine}) : given;
  Sum sum(brdf, index, view.v, bands);
  if (lobe.shape == LobeShape::kHemisphere)
    add_hemisphere(view, half, nodes, sum);
  else
    add_half_vector(view, lobe, half, nodes, sum);
  RgbCoefficients coefficients = sum.result();
  if (!half) return coefficients;
  // The other half takes these back.
  for (int l = 0; l < bands; ++l)
    for (int m = -l; m < 0; ++m) coefficients.at(l, m) = {};
  return rotate_about_z(std::atan2(given.sin_phi, given.cos_phi), coefficients);
}

double largest(const RgbCoefficients& coefficients) {
  double result = 0;
  for (const Rgb c : coefficients.values()) result = std::max({result, std::abs(c.r), std::abs(c.g), std::abs(c.b)});
  return result;
}

double largest_difference(const RgbCoefficients& a, const RgbCoefficients& b) {
  RgbCoefficients difference(a.bands());
  for (std::size_t i = 0; i < a.size(); ++i) difference[i] = a[i] - b[i];
  return largest(difference);
}

}  // namespace

BrdfProjection project_brdf(const Brdf& brdf, Vec3d v, int bands, const ProjectBrdfParams& params) {
  SHLIGHT_ASSERT_GE(bands, 1);
  SHLIGHT_ASSERT_LT(0.0, v.z);
  BrdfProjection result{RgbCoefficients(bands)};
  for (std::size_t lobe = 0; lobe < brdf.lobes().size(); ++lobe) {
    RgbCoefficients before = project_lobe(brdf, lobe, v, bands, kLevels[0]);
    double change = 0;
    for (std::size_t level = 1; level < kLevels.size() && kLevels[level] <= params.max_nodes; ++level) {
      RgbCoefficients now = project_lobe(brdf, lobe, v, bands, kLevels[level]);
      change = largest_difference(now, before);
      before = std::move(now);
      if (change <= params.tolerance * largest(before)) break;
    }
    result.coefficients += before;
    result.change += change;
  }
  return result;
}

RgbCoefficients project_brdf_fixed(const Brdf& brdf, Vec3d v, int bands, std::span<const int> nodes) {
  SHLIGHT_ASSERT_EQ(nodes.size(), brdf.lobes().size());
  RgbCoefficients result(bands);
  for (std::size_t lobe = 0; lobe < nodes.size(); ++lobe)
    if (nodes[lobe] > 0) result += project_lobe(brdf, lobe, v, bands, nodes[lobe]);
  return result;
}

std::vector<int> choose_nodes(const Brdf& brdf, int bands, double tolerance) {
  // Polar angles in degrees, denser where views graze; off the axes, where an anisotropic model has no symmetry.
  constexpr double kAngles[] = {5, 30, 50, 65, 75, 82, 87, 89.5}, kAzimuth = 0.6;
  constexpr int kMost = 96;
  std::vector<int> nodes;
  for (std::size_t lobe = 0; lobe < brdf.lobes().size(); ++lobe) {
    std::size_t level = 0;
    for (const double degrees : kAngles) {
      const double theta = degrees * pi / 180;
      const Vec3d v = {std::sin(theta) * std::cos(kAzimuth), std::sin(theta) * std::sin(kAzimuth), std::cos(theta)};
      RgbCoefficients before = project_lobe(brdf, lobe, v, bands, kLevels[level]);
      while (kLevels[level + 1] <= kMost) {
        RgbCoefficients now = project_lobe(brdf, lobe, v, bands, kLevels[level + 1]);
        if (largest_difference(now, before) <= tolerance * largest(now)) break;
        before = std::move(now);
        ++level;
      }
    }
    nodes.push_back(kLevels[level]);
  }
  return nodes;
}

RgbCoefficients project_brdf_monte_carlo(const Brdf& brdf, Vec3d normal, Vec3d tangent, Vec3d view,
                                         const SphereSamples& samples) {
  const Vec3d bitangent = cross(normal, tangent);
  const auto to_local = [&](Vec3d d) { return Vec3d{dot(d, tangent), dot(d, bitangent), dot(d, normal)}; };
  const Vec3d v = to_local(view);
  const double weight = 4 * pi / static_cast<double>(samples.directions.size());
  RgbCoefficients coefficients(samples.bands);
  for (std::size_t j = 0; j < samples.directions.size(); ++j) {
    const Vec3d s = to_local(samples.directions[j]);
    if (s.z <= 0) continue;
    const Rgb value = weight * s.z * brdf.eval(s, v);
    const auto basis = samples.basis_of(j);
    for (std::size_t i = 0; i < basis.size(); ++i) coefficients[i] += basis[i] * value;
  }
  return coefficients;
}

}  // namespace shlight
