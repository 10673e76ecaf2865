#include "shlight/brdf/metallic_roughness.h"

#include <algorithm>

#include "shlight/brdf/ggx.h"

namespace shlight {

std::unique_ptr<Brdf> make_metallic_roughness(Rgb base, double metallic, double roughness) {
  const double alpha = std::max(0.01, roughness * roughness), dielectric = 0.04 * (1 - metallic);
  GgxParams params;
  params.ax = params.ay = alpha;
  params.f0 = Rgb{dielectric, dielectric, dielectric} + metallic * base;
  params.diffuse = (1 - metallic) * base;
  params.diffuse_f0 = {0.04, 0.04, 0.04};
  return make_ggx(params);
}

}  // namespace shlight
