#include "shlight/transfer/shadow_ratio.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "shlight/transfer/transfer_test_util.h"

namespace shlight {
namespace {

Transfer bake(const Scene& scene, TransferKind kind, int bands = 4) {
  BakeParams params;
  params.kind = kind;
  params.bands = bands;
  params.samples = 1024;
  params.bounces = 3;
  return bake_transfer(scene, params);
}

RgbCoefficients uniform_light(Rgb radiance, int bands) {
  RgbCoefficients light(bands);
  light[0] = std::sqrt(4 * std::numbers::pi) * radiance;
  return light;
}

// A floor, the half of it at x < 0 deep in a box that is open to one side.
Scene make_niche() {
  return make_test_scene(
      {make_sheet({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}, 8), make_sheet({-2, 0.5f, -2}, {2, 0, 0}, {0, 0, 4}, 8)},
      {0.9f, 0.3f, 0.1f});
}

TEST(ShadowRatio, IsOneWhereNothingStandsInTheWay) {
  const Scene floor = make_test_scene({make_sheet({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}, 2)});
  RgbCoefficients light = uniform_light({2, 1, 0.5}, 5);
  light[3] = {1, 0.3, 0.2};
  for (const TransferKind kind : {TransferKind::kCosine, TransferKind::kShadowed})
    for (const Vec3f ratio : ShadowRatio(floor, bake(floor, kind)).under(light)) {
      EXPECT_NEAR(ratio.x, 1, 1e-5);
      EXPECT_NEAR(ratio.y, 1, 1e-5);
      EXPECT_NEAR(ratio.z, 1, 1e-5);
    }
}

TEST(ShadowRatio, TimesTheOpenLightIsTheShadowedOne) {
  const Scene niche = make_niche();
  const Transfer shadowed = bake(niche, TransferKind::kShadowed);
  const std::vector<Vec3f> ratios = ShadowRatio(niche, shadowed).under(uniform_light({3, 2, 1}, 4));
  double least = 1;
  for (std::size_t v = 0; v < ratios.size(); ++v) {
    // Of uniform light an open vertex takes all, this one its ambient occlusion; 1 % blurs it.
    EXPECT_NEAR(ratios[v].x, shadowed.ambient_occlusion[v], 0.012);
    EXPECT_FLOAT_EQ(ratios[v].x, ratios[v].z);
    least = std::min(least, double{ratios[v].x});
  }
  EXPECT_LT(least, 0.5) << "a niche without shadows";
}

TEST(ShadowRatio, HasTheColourOfWhatSurfacesSendOn) {
  const Scene niche = make_niche();
  const auto shadowed = ShadowRatio(niche, bake(niche, TransferKind::kShadowed)).under(uniform_light({1, 1, 1}, 4));
  const auto bounced =
      ShadowRatio(niche, bake(niche, TransferKind::kInterreflected)).under(uniform_light({1, 1, 1}, 4));
  for (std::size_t v = 0; v < bounced.size(); ++v) {
    if (shadowed[v].x > 0.8f) continue;
    EXPECT_GT(bounced[v].x, shadowed[v].x + 0.02f);
    EXPECT_GT(bounced[v].x, bounced[v].z);
  }
}

TEST(ShadowRatio, StaysInBoundsUnderAnyLight) {
  const Scene niche = make_niche();
  const ShadowRatio ratio(niche, bake(niche, TransferKind::kInterreflected));
  RgbCoefficients lamp(4);
  lamp[1] = {-5, 0, 1e-30};  // from below, where the mean is black
  for (const RgbCoefficients& light : {lamp, RgbCoefficients(4), uniform_light({-1, 0, 1}, 2)})
    for (const Vec3f r : ratio.under(light))
      for (const float channel : {r.x, r.y, r.z}) {
        EXPECT_GE(channel, 0);
        EXPECT_LE(channel, 4);
      }
}

}  // namespace
}  // namespace shlight
