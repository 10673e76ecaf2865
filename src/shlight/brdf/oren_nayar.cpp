#include "shlight/brdf/oren_nayar.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "shlight/brdf/slopes.h"

namespace shlight {
namespace {

using std::numbers::pi;

BrdfTraits rough_traits(Rgb rho) {
  return {BrdfSymmetry::kIsotropic, is_grey(rho), {{LobeShape::kHemisphere}}};
}

// sin θ_i sin θ_r cos Δφ is what the two directions' parts in the plane multiply to.
struct Angles {
  double sin_s, sin_v, cos_phi;
};
Angles angles_between(Vec3d s, Vec3d v) {
  const double sin_s = std::sqrt(s.x * s.x + s.y * s.y), sin_v = std::sqrt(v.x * v.x + v.y * v.y);
  const double product = sin_s * sin_v;
  return {sin_s, sin_v, product > 0 ? std::clamp((s.x * v.x + s.y * v.y) / product, -1.0, 1.0) : 0.0};
}

class OrenNayar : public Brdf {
 public:
  OrenNayar(Rgb rho, double sigma) : Brdf(rough_traits(rho)), scale_(1 / pi * rho) {
    const double variance = sigma * sigma;
    a_ = 1 - 0.5 * variance / (variance + 0.33);
    b_ = 0.45 * variance / (variance + 0.09);
  }

  // sin α tan β = sin θ_i sin θ_r / cos β, and cos β is the larger of the two cosines.
  Rgb eval_lobe(std::size_t, Vec3d s, Vec3d v) const override {
    const double in_plane = s.x * v.x + s.y * v.y;
    return (a_ + b_ * std::max(0.0, in_plane) / clamped(std::max(s.z, v.z))) * scale_;
  }

 private:
  Rgb scale_;
  double a_, b_;
};

class OrenNayarFull : public Brdf {
 public:
  OrenNayarFull(Rgb rho, double sigma) : Brdf(rough_traits(rho)), single_(1 / pi * rho), variance_(sigma * sigma) {
    double_ = 0.17 / pi * variance_ / (variance_ + 0.13) * times(rho, rho);
  }

  Rgb eval_lobe(std::size_t, Vec3d s, Vec3d v) const override {
    const Angles angles = angles_between(s, v);
    const double theta_s = std::atan2(angles.sin_s, s.z), theta_v = std::atan2(angles.sin_v, v.z);
    const double alpha = std::max(theta_s, theta_v), beta = std::min(theta_s, theta_v);
    const double slope = variance_ / (variance_ + 0.09), part = 2 * beta / pi;
    const double c1 = 1 - 0.5 * variance_ / (variance_ + 0.33);
    const double c2 = 0.45 * slope * (std::sin(alpha) - (angles.cos_phi < 0 ? part * part * part : 0));
    const double c3 = 0.125 * slope * std::pow(4 * alpha * beta / (pi * pi), 2);
    const double tan_beta = std::sin(beta) / clamped(std::cos(beta));
    const double half = 0.5 * (alpha + beta);
    const double tan_half = std::sin(half) / clamped(std::cos(half));
    const double first = c1 + c2 * angles.cos_phi * tan_beta + c3 * (1 - std::abs(angles.cos_phi)) * tan_half;
    return std::max(0.0, first) * single_ + (1 - angles.cos_phi * part * part) * double_;
  }

 private:
  Rgb single_, double_;
  double variance_;
};

}  // namespace

std::unique_ptr<Brdf> make_oren_nayar(Rgb rho, double sigma) {
  return std::make_unique<OrenNayar>(rho, sigma);
}

std::unique_ptr<Brdf> make_oren_nayar_full(Rgb rho, double sigma) {
  return std::make_unique<OrenNayarFull>(rho, sigma);
}

}  // namespace shlight
