#include "shlight/truth/model_band_error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "shlight/brdf/make_brdf.h"
#include "shlight/light/builtin_light.h"
#include "shlight/scene/builtin_scene.h"
#include "shlight/truth/truth_test_util.h"

namespace shlight {
namespace {

CoefficientLight make_directional_light() {
  return CoefficientLight(RgbCoefficients(1), Sun{{0.36, 0.48, 0.8}, {1, 2, 3}});
}

// Nothing stands in a sphere's own light, and its normals are all there are.
TEST(ModelBandError, OfASphereIsThatOfAllNormals) {
  const Scene sphere = make_sphere_scene(16);
  const auto light = make_builtin_light("studio");
  const BandErrors expected = *measure_band_errors(*light, *make_brdf("lambert"));
  for (const bool shadowed : {false, true}) {
    const BandErrors errors = *measure_model_band_errors(*light, sphere, {{.max_bands = 6}, shadowed, 1024});
    for (std::size_t i = 0; i < 6; ++i) {
      // Vertices of a sphere are no even set of normals, and transfer from 1024 rays is noisy in its higher bands.
      const double slack = 0.05 * expected.bands[i].rms + 2e-4;
      EXPECT_NEAR(errors.bands[i].rms, expected.bands[i].rms, slack) << i + 1 << " bands, shadowed " << shadowed;
    }
  }
}

// Transfer's noise is in the truth and in the approximations alike.
TEST(ModelBandError, VanishesWithAllOfALightsBands) {
  RgbCoefficients radiance(3);
  for (std::size_t i = 0; i < radiance.size(); ++i) radiance[i] = {noise(1, i), noise(2, i), noise(3, i)};
  radiance[0] = {5, 5, 5};
  const BandErrors errors =
      *measure_model_band_errors(CoefficientLight(radiance), make_knot_scene(), {{.max_bands = 4}, true, 16});
  EXPECT_LT(errors.bands[2].max, 1e-12);
  EXPECT_GT(errors.bands[1].max, 1e-2);
}

// The series of max(0, z) by two bands is off by a quarter on either side and at the terminator; where the model's own
// shadow falls, what two bands still show of the light is an error that open surfaces do not have.
TEST(ModelBandError, ShadowsOfADirectionalLightAreSharp) {
  const Scene knot = make_knot_scene();
  const auto light = make_directional_light();
  const BandErrors open = *measure_model_band_errors(light, knot, {{.max_bands = 3}, false, 64});
  const BandErrors shadowed = *measure_model_band_errors(light, knot, {{.max_bands = 3}, true, 64});
  EXPECT_NEAR(open.bands[1].max, 0.25, 2e-3);
  EXPECT_NEAR(open.largest.g, shadowed.largest.g, 1e-2 * open.largest.g) << "some of it is in the light";
  EXPECT_GT(shadowed.bands[2].max, 2 * open.bands[2].max);
}

TEST(ModelBandError, OfABlackLightIsNothing) {
  const ImageLight black({Image(8, 4), Layout::kLatLong});
  EXPECT_FALSE(measure_model_band_errors(black, make_sphere_scene(16), {{}, true, 16}));
  EXPECT_FALSE(measure_model_band_errors(black, make_sphere_scene(16), {{}, false, 16}));
}

}  // namespace
}  // namespace shlight
