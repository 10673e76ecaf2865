#include "shlight/brdf/cook_torrance.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "shlight/brdf/fresnel.h"
#include "shlight/brdf/slopes.h"

namespace shlight {
namespace {

class CookTorrance : public Brdf {
 public:
  CookTorrance(double m, Rgb f0)
      : Brdf({BrdfSymmetry::kIsotropic, is_grey(f0), {{LobeShape::kGrooves, m, m}}}), m_(m), f0_(f0) {}

  Rgb eval_lobe(std::size_t, Vec3d s, Vec3d v) const override {
    const Vec3d h = s + v;
    const double length = std::sqrt(dot(h, h)), nh = h.z / length, vh = 0.5 * length;
    const double cos2 = nh * nh, tan2 = (h.x * h.x + h.y * h.y) / (h.z * h.z);
    const double d = std::exp(-tan2 / (m_ * m_)) / (std::numbers::pi * m_ * m_ * cos2 * cos2);
    // G / (n·s n·v), which stays finite where G is small: 2 n·h / (v·h max(n·s, n·v)) and 1 / (n·s n·v).
    const double g = std::min(2 * nh / (vh * std::max(s.z, v.z)), 1 / (s.z * v.z));
    return d * g / 4 * eval_schlick_fresnel(f0_, vh);
  }

  Vec3d sample_lobe(std::size_t, Vec3d v, double u1, double u2) const override {
    return sample_gaussian_slopes(m_, m_, v, u1, u2);
  }
  double sample_lobe_pdf(std::size_t, Vec3d s, Vec3d v) const override { return gaussian_slopes_pdf(m_, m_, s, v); }

 private:
  double m_;
  Rgb f0_;
};

}  // namespace

std::unique_ptr<Brdf> make_cook_torrance(double m, Rgb f0) {
  return std::make_unique<CookTorrance>(m, f0);
}

}  // namespace shlight
