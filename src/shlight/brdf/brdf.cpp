#include "shlight/brdf/brdf.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace shlight {

using std::numbers::pi;

Rgb Brdf::eval(Vec3d s, Vec3d v) const {
  Rgb sum;
  if (!(s.z > 0 && v.z > 0)) return sum;
  for (std::size_t lobe = 0; lobe < traits_.lobes.size(); ++lobe) sum += eval_lobe(lobe, s, v);
  return sum;
}

Vec3d Brdf::sample_lobe(std::size_t, Vec3d, double u1, double u2) const {
  const double radius = std::sqrt(u1), phi = 2 * pi * u2;
  return {radius * std::cos(phi), radius * std::sin(phi), std::sqrt(1 - u1)};
}

double Brdf::sample_lobe_pdf(std::size_t, Vec3d s, Vec3d) const {
  return std::max(0.0, s.z) / pi;
}

namespace {

double total_weight(const Brdf& brdf) {
  double sum = 0;
  for (const BrdfLobe& lobe : brdf.lobes()) sum += lobe.weight;
  return sum;
}

}  // namespace

Vec3d sample_brdf(const Brdf& brdf, Vec3d v, double u, double u1, double u2) {
  u *= total_weight(brdf);
  std::size_t lobe = 0;
  while (lobe + 1 < brdf.lobes().size() && u >= brdf.lobes()[lobe].weight) u -= brdf.lobes()[lobe++].weight;
  return brdf.sample_lobe(lobe, v, u1, u2);
}

double sample_brdf_pdf(const Brdf& brdf, Vec3d s, Vec3d v) {
  double sum = 0;
  for (std::size_t lobe = 0; lobe < brdf.lobes().size(); ++lobe)
    sum += brdf.lobes()[lobe].weight * brdf.sample_lobe_pdf(lobe, s, v);
  return sum / total_weight(brdf);
}

namespace {

class FunctionBrdf : public Brdf {
 public:
  FunctionBrdf(BrdfFunction f, BrdfTraits traits) : Brdf(std::move(traits)), f_(std::move(f)) {}
  Rgb eval_lobe(std::size_t, Vec3d s, Vec3d v) const override { return f_(s, v); }

 private:
  BrdfFunction f_;
};

}  // namespace

std::unique_ptr<Brdf> make_function_brdf(BrdfFunction f, BrdfSymmetry symmetry, bool grey, double width) {
  return std::make_unique<FunctionBrdf>(std::move(f),
                                        BrdfTraits{symmetry, grey, {{LobeShape::kHalfVector, width, width}}});
}

}  // namespace shlight
