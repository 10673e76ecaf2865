#include "shlight/render/slim_lobe.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace shlight {
namespace {

constexpr double kSlim = 1;

bool is_slim(const BrdfLobe& lobe) {
  return (lobe.shape == LobeShape::kHalfVector || lobe.shape == LobeShape::kGrooves) &&
         std::min(lobe.width_x, lobe.width_y) < kSlim;
}

class SlimLobes : public Brdf {
 public:
  SlimLobes(const Brdf& brdf, BrdfTraits traits, std::vector<std::size_t> lobes)
      : Brdf(std::move(traits)), brdf_(brdf), lobes_(std::move(lobes)) {}
  Rgb eval_lobe(std::size_t lobe, Vec3d s, Vec3d v) const override { return brdf_.eval_lobe(lobes_[lobe], s, v); }
  Vec3d sample_lobe(std::size_t lobe, Vec3d v, double u1, double u2) const override {
    return brdf_.sample_lobe(lobes_[lobe], v, u1, u2);
  }
  double sample_lobe_pdf(std::size_t lobe, Vec3d s, Vec3d v) const override {
    return brdf_.sample_lobe_pdf(lobes_[lobe], s, v);
  }

 private:
  const Brdf& brdf_;
  std::vector<std::size_t> lobes_;
};

// Roberts's additive sequence in three dimensions, from powers of the root of g⁴ = g + 1: evenly spread whatever the
// count.
double spread(int i, int dimension) {
  constexpr double kRoot = 1.2207440846057596;
  const double x = 0.5 + (i + 1) * std::pow(kRoot, -(dimension + 1));
  return x - std::floor(x);
}

struct ReflectedSample {
  Vec3d s;
  double weight, pdf;  // f_r cos θ / pdf
};

// Where light comes from that is seen from above.
std::vector<ReflectedSample> reflect_from_above(const Brdf& brdf, int count) {
  const Vec3d v = {0, 0, 1};
  std::vector<ReflectedSample> samples;
  for (int i = 0; i < count; ++i) {
    // Strata of the choice between lobes, in the sequence of the samples.
    const Vec3d s = sample_brdf(brdf, v, (i + 0.5) / count, spread(i, 0), spread(i, 1));
    if (!(s.z > 0)) continue;
    const double pdf = sample_brdf_pdf(brdf, s, v), weight = luminance(brdf.eval(s, v)) * s.z / pdf;
    if (weight > 0) samples.push_back({s, weight, pdf});
  }
  return samples;
}

// LobeFromAbove::slope_density. Seen from above, a direction at θ has its half vector at θ/2, and the density of half
// vectors' directions times their cosine is that of slopes times the cosine's fourth power.
std::vector<float> density_of_slopes(const Brdf& brdf, const LobeFromAbove& lobe) {
  constexpr double kSteepest = 0.999;  // known are slopes of light from above the horizon: below 1
  const auto density_at = [&](double slope) {
    const double known = std::min(slope, kSteepest), cosine2 = 1 / (1 + known * known);
    const double theta = 2 * std::atan(known);
    const Vec3d s =
        lobe.wide_along_x ? Vec3d{0, std::sin(theta), std::cos(theta)} : Vec3d{std::sin(theta), 0, std::cos(theta)};
    // Beyond, as of GGX's facets, which of all models has most of them there.
    const double beyond = slope > kSteepest ? std::pow(kSteepest / slope, 4) : 1;
    return beyond * luminance(brdf.eval(s, {0, 0, 1})) * s.z * cosine2 * cosine2;
  };
  std::vector<double> densities;
  double sum = 0;
  for (int i = 0; i <= kDensitySteps; ++i) {
    const double x = static_cast<double>(i) / kDensitySteps, slope = lobe.width * x / std::max(1 - x, 1e-9);
    densities.push_back(i < kDensitySteps ? density_at(slope) : 0);
    // dr = width/(1 − x)² dx
    if (i < kDensitySteps)
      sum += 2 * std::numbers::pi * slope * densities.back() * lobe.width / ((1 - x) * (1 - x)) / kDensitySteps;
  }
  std::vector<float> result;
  for (const double density : densities) result.push_back(static_cast<float>(density * lobe.slim_over_wide / sum));
  return result;
}

// The middle of each of kLobeTaps equal parts of the lobe, from one end of its wide side to the other.
std::vector<float> spread_wide_slopes(const Brdf& brdf, bool along_x) {
  constexpr int kCount = 8192;                    // where the outer taps lie shows in the streaks' ends
  std::vector<std::pair<double, double>> slopes;  // and their weights
  double sum = 0;
  for (const ReflectedSample& sample : reflect_from_above(brdf, kCount)) {
    slopes.push_back({(along_x ? sample.s.x : sample.s.y) / (1 + sample.s.z), sample.weight});
    sum += sample.weight;
  }
  std::ranges::sort(slopes);
  std::vector<float> taps;
  double below = 0;
  for (const auto& [slope, weight] : slopes) {
    below += weight / sum;
    while (static_cast<int>(taps.size()) < kLobeTaps && below > (static_cast<double>(taps.size()) + 0.5) / kLobeTaps)
      taps.push_back(static_cast<float>(slope));
  }
  return taps;
}

}  // namespace

std::unique_ptr<Brdf> make_slim_lobes(const Brdf& brdf) {
  BrdfTraits traits = {brdf.traits().symmetry, brdf.traits().grey, {}};
  std::vector<std::size_t> lobes;
  for (std::size_t i = 0; i < brdf.lobes().size(); ++i)
    if (is_slim(brdf.lobes()[i])) lobes.push_back(i), traits.lobes.push_back(brdf.lobes()[i]);
  if (lobes.empty()) return nullptr;
  return std::make_unique<SlimLobes>(brdf, std::move(traits), std::move(lobes));
}

LobeFromAbove sample_lobe_from_above(const Brdf& brdf, int count) {
  LobeFromAbove lobe;
  double along = kSlim, across = kSlim;
  for (const BrdfLobe& part : brdf.lobes())
    along = std::min(along, part.width_x), across = std::min(across, part.width_y);
  lobe.width = std::min(along, across);
  lobe.wide_along_x = along > across;

  const Vec3d v = {0, 0, 1};
  constexpr int kProfile = 2048;
  for (int i = 0; i <= kProfile; ++i) {
    const double half = std::numbers::sqrt2 / 2 * i / kProfile, theta = 2 * std::asin(half);
    const double sine = std::sin(theta), cosine = std::max(std::cos(theta), 0.0);
    const Vec3d s = lobe.wide_along_x ? Vec3d{0, sine, cosine} : Vec3d{sine, 0, cosine};
    lobe.profile.push_back(static_cast<float>(luminance(brdf.eval(s, v)) * cosine));
  }

  // The slim lobe: half vectors whose wide slope is shrunk to the slim one's width, and their direction to the light.
  const double shrink = lobe.slim_over_wide = lobe.width / std::max(along, across);
  lobe.slope_density = density_of_slopes(brdf, lobe);
  double sum = 0;
  for (const ReflectedSample& sample : reflect_from_above(brdf, count)) {
    double x = sample.s.x / (1 + sample.s.z), y = sample.s.y / (1 + sample.s.z);
    (lobe.wide_along_x ? x : y) *= shrink;
    const double scale = 2 / (1 + x * x + y * y);
    // Seen from above, the mirrored direction is the normal.
    lobe.samples.push_back({{scale * x, scale * y, scale - 1}, sample.weight, shrink / (count * sample.pdf)});
    sum += sample.weight;
  }
  for (LobeSample& sample : lobe.samples) sample.weight /= sum;
  if (along != across) lobe.slopes = spread_wide_slopes(brdf, lobe.wide_along_x);
  return lobe;
}

}  // namespace shlight
