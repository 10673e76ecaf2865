#include "shlight/brdf/ggx.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "shlight/brdf/fresnel.h"
#include "shlight/brdf/slopes.h"

namespace shlight {
namespace {

using std::numbers::pi;

constexpr std::size_t kDiffuse = 1;

BrdfTraits ggx_traits(const GgxParams& p) {
  BrdfTraits traits{p.ax == p.ay ? BrdfSymmetry::kIsotropic : BrdfSymmetry::kMirrored,
                    is_grey(p.f0) && is_grey(p.diffuse),
                    {{LobeShape::kHalfVector, p.ax, p.ay, luminance(p.f0) + 0.05}}};
  // Schlick's factor of the diffuse part is smooth in the half vector, at the width of the hemisphere itself.
  if (p.diffuse != Rgb{}) traits.lobes.push_back({LobeShape::kHalfVector, 1, 1, luminance(p.diffuse)});
  return traits;
}

class Ggx : public Brdf {
 public:
  explicit Ggx(const GgxParams& params) : Brdf(ggx_traits(params)), p_(params) {}

  Rgb eval_lobe(std::size_t lobe, Vec3d s, Vec3d v) const override {
    const Vec3d h = s + v;
    const double length2 = dot(h, h);
    const double cosine = 0.5 * std::sqrt(length2);
    if (lobe == kDiffuse) return 1 / pi * times(Rgb{1, 1, 1} - eval_schlick_fresnel(p_.diffuse_f0, cosine), p_.diffuse);
    const Rgb fresnel = eval_schlick_fresnel(p_.f0, cosine);
    // G₂ / (4 n·s n·v) = 1 / (2 (n·s √… of v + n·v √… of s)), with the roots as lengths of stretched vectors.
    return distribution(h, length2) / (2 * (s.z * stretched_length(v) + v.z * stretched_length(s))) * fresnel;
  }

  Vec3d sample_lobe(std::size_t lobe, Vec3d v, double u1, double u2) const override {
    return lobe == kDiffuse ? Brdf::sample_lobe(lobe, v, u1, u2) : mirrored_at(sample_visible_normal(v, u1, u2), v);
  }

  // Visible normals have the density G₁(v) D (v·h)/(n·v), mirrored directions 1/(4 v·h) of it.
  double sample_lobe_pdf(std::size_t lobe, Vec3d s, Vec3d v) const override {
    if (lobe == kDiffuse) return Brdf::sample_lobe_pdf(lobe, s, v);
    const Vec3d h = s + v;
    return distribution(h, dot(h, h)) / (2 * (v.z + stretched_length(v)));
  }

 private:
  // D of a half vector of any length.
  double distribution(Vec3d h, double length2) const {
    const double x = h.x / p_.ax, y = h.y / p_.ay, sum = x * x + y * y + h.z * h.z;
    return length2 * length2 / (pi * p_.ax * p_.ay * sum * sum);
  }

  // d_z √(1 + (α_x² d_x² + α_y² d_y²)/d_z²)
  double stretched_length(Vec3d d) const {
    const double x = p_.ax * d.x, y = p_.ay * d.y;
    return std::sqrt(x * x + y * y + d.z * d.z);
  }

  // [3, listing 1]: stretched so that facets lie on a hemisphere, the visible ones project to half a disc and half an
  // ellipse.
  Vec3d sample_visible_normal(Vec3d v, double u1, double u2) const {
    const double length = stretched_length(v);
    const Vec3d w = {p_.ax * v.x / length, p_.ay * v.y / length, v.z / length};
    const double across = std::sqrt(w.x * w.x + w.y * w.y);
    const Vec3d t = across > 0 ? Vec3d{-w.y / across, w.x / across, 0} : Vec3d{1, 0, 0};
    const Vec3d b = cross(w, t);
    const double radius = std::sqrt(u1), phi = 2 * pi * u2, share = 0.5 * (1 + w.z);
    const double x = radius * std::cos(phi);
    const double y = (1 - share) * std::sqrt(1 - x * x) + share * radius * std::sin(phi);
    const Vec3d n = x * t + y * b + std::sqrt(std::max(0.0, 1 - x * x - y * y)) * w;
    const Vec3d h = {p_.ax * n.x, p_.ay * n.y, std::max(1e-12, n.z)};
    return 1 / std::sqrt(dot(h, h)) * h;
  }

  GgxParams p_;
};

}  // namespace

std::unique_ptr<Brdf> make_ggx(const GgxParams& params) {
  return std::make_unique<Ggx>(params);
}

}  // namespace shlight
