#include "shlight/render/slim_lobe.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace shlight {
namespace {

constexpr double kSlim = 1;

bool is_slim(const BrdfLobe& lobe) {
  return lobe.shape == LobeShape::kHalfVector && std::min(lobe.width_x, lobe.width_y) < kSlim;
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

}  // namespace

std::unique_ptr<Brdf> make_slim_lobes(const Brdf& brdf) {
  BrdfTraits traits = {brdf.traits().symmetry, brdf.traits().grey, {}};
  std::vector<std::size_t> lobes;
  for (std::size_t i = 0; i < brdf.lobes().size(); ++i)
    if (is_slim(brdf.lobes()[i])) lobes.push_back(i), traits.lobes.push_back(brdf.lobes()[i]);
  if (lobes.empty()) return nullptr;
  return std::make_unique<SlimLobes>(brdf, std::move(traits), std::move(lobes));
}

double slimmest_width(const Brdf& brdf) {
  double width = kSlim;
  for (const BrdfLobe& lobe : brdf.lobes()) width = std::min({width, lobe.width_x, lobe.width_y});
  return width;
}

std::vector<LobeSample> sample_lobe_from_above(const Brdf& brdf, int count) {
  const Vec3d v = {0, 0, 1};
  std::vector<LobeSample> samples;
  double sum = 0;
  for (int i = 0; i < count; ++i) {
    // Strata of the choice between lobes, in the sequence of the samples.
    const Vec3d s = sample_brdf(brdf, v, (i + 0.5) / count, spread(i, 0), spread(i, 1));
    if (!(s.z > 0)) continue;
    const double pdf = sample_brdf_pdf(brdf, s, v), weight = luminance(brdf.eval(s, v)) * s.z / pdf;
    if (!(weight > 0)) continue;
    const double turn = 2 * std::numbers::pi * spread(i, 2), c = std::cos(turn), sine = std::sin(turn);
    // Seen from above, the mirrored direction is the normal.
    samples.push_back({{c * s.x - sine * s.y, sine * s.x + c * s.y, s.z}, weight, 1 / (count * pdf)});
    sum += weight;
  }
  for (LobeSample& sample : samples) sample.weight /= sum;
  return samples;
}

}  // namespace shlight
