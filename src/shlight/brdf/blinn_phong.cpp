#include "shlight/brdf/blinn_phong.h"

#include <cmath>
#include <numbers>

#include "shlight/brdf/slopes.h"

namespace shlight {
namespace {

using std::numbers::pi;

// cos^n of an angle of the slope w is about e^{−n w²/2}.
double width_of(double n) {
  return std::min(1.0, std::sqrt(2 / n));
}

class BlinnPhong : public Brdf {
 public:
  BlinnPhong(Rgb rd, Rgb rs, double n)
      : Brdf({BrdfSymmetry::kIsotropic,
              is_grey(rd) && is_grey(rs),
              {{LobeShape::kLambert, 1, 1, luminance(rd) + 1e-3},
               {LobeShape::kHalfVector, width_of(n), width_of(n), luminance(rs) + 1e-3}}}),
        diffuse_(1 / pi * rd),
        highlight_((n + 2) * (n + 4) / (8 * pi * (std::exp2(-n / 2) + n)) * rs),
        n_(n) {}

  Rgb eval_lobe(std::size_t lobe, Vec3d s, Vec3d v) const override {
    if (lobe == 0) return diffuse_;
    const Vec3d h = s + v;
    return std::pow(h.z * h.z / dot(h, h), n_ / 2) * highlight_;
  }

  // Half vectors with the density (n+1)/2π cos^n.
  Vec3d sample_lobe(std::size_t lobe, Vec3d v, double u1, double u2) const override {
    if (lobe == 0) return Brdf::sample_lobe(lobe, v, u1, u2);
    const double cosine = std::pow(1 - u1, 1 / (n_ + 1)), sine = std::sqrt(1 - cosine * cosine), phi = 2 * pi * u2;
    return mirrored_at({sine * std::cos(phi), sine * std::sin(phi), cosine}, v);
  }
  double sample_lobe_pdf(std::size_t lobe, Vec3d s, Vec3d v) const override {
    if (lobe == 0) return Brdf::sample_lobe_pdf(lobe, s, v);
    const Vec3d h = s + v;
    const double length = std::sqrt(dot(h, h));
    return (n_ + 1) / (2 * pi) * std::pow(h.z / length, n_) / (2 * length);
  }

 private:
  Rgb diffuse_, highlight_;
  double n_;
};

}  // namespace

std::unique_ptr<Brdf> make_blinn_phong(Rgb rd, Rgb rs, double n) {
  return std::make_unique<BlinnPhong>(rd, rs, n);
}

}  // namespace shlight
