#include "shlight/report/thesis_materials.h"

namespace shlight {

std::span<const ThesisMaterial> thesis_materials() {
  static constexpr ThesisMaterial kMaterials[] = {
      {"cook-torrance", "Cook-Torrance", "cook-torrance:m=0.5,f0=0.9", 17.83},
      {"oren-nayar", "Oren-Nayar", "oren-nayar:rho=0.8,sigma=0.8", 11.84},
      {"ward-aniso", "Ward, anisotropic", "ward-aniso:rd=0.1,rs=0.6,sx=0.15,sy=0.6", 41.39},
      {"ward", "Ward, isotropic", "ward:rd=0.1,rs=0.6,sigma=0.3", 37.26},
  };
  return kMaterials;
}

}  // namespace shlight
