#include "shlight/brdf/lambert.h"

#include <numbers>

#include "shlight/brdf/slopes.h"

namespace shlight {
namespace {

class Lambert : public Brdf {
 public:
  explicit Lambert(Rgb rho)
      : Brdf({BrdfSymmetry::kIsotropic, is_grey(rho), {{LobeShape::kLambert}}}), value_(1 / std::numbers::pi * rho) {}
  Rgb eval_lobe(std::size_t, Vec3d, Vec3d) const override { return value_; }

 private:
  Rgb value_;
};

}  // namespace

std::unique_ptr<Brdf> make_lambert(Rgb rho) {
  return std::make_unique<Lambert>(rho);
}

}  // namespace shlight
