// From a light to the coefficients of its irradiance: project_light LIGHT FILE.json

#include <cstdio>

#include "shlight/core/error.h"
#include "shlight/light/coefficient_file.h"
#include "shlight/light/light.h"
#include "shlight/sh/basis.h"
#include "shlight/sh/zonal.h"

int main(int argc, char** argv) try {
  if (argc != 3) return 2;
  const shlight::LoadedLight loaded = shlight::load_light(argv[1]);
  const shlight::RgbCoefficients radiance = loaded.light->project(3);
  shlight::save_coefficients(argv[2], radiance);

  // The light that a surface facing up receives.
  const shlight::RgbCoefficients irradiance = shlight::irradiance_from_radiance(radiance);
  const shlight::Rgb up = shlight::reconstruct(irradiance, {0, 1, 0});
  std::printf("%g %g %g\n", up.r, up.g, up.b);
  return 0;
} catch (const shlight::Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
