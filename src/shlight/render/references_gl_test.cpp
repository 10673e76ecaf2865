#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "shlight/light/light.h"
#include "shlight/render/render_test_util.h"
#include "shlight/render/sh_probe.h"
#include "shlight/sh/zonal.h"

namespace shlight {
namespace {

class ReferencesGl : public GlTest {};

// The nine-coefficient irradiance, drawn, of real lights at the directions for which brute-force irradiance is known.
TEST_F(ReferencesGl, DrawnIrradianceOfRealLights) {
  const char* data = std::getenv("SHLIGHT_TEST_DATA");
  if (!data) GTEST_SKIP() << "SHLIGHT_TEST_DATA names no folder";
  for (const char* name : {"blender_city.exr", "blender_night.exr", "blender_studio.exr", "polyhaven_1k_city.hdr",
                           "polyhaven_1k_studio.hdr", "polyhaven_1k_sunset.hdr", "polyhaven_1k_venice.hdr"}) {
    const std::filesystem::path folder = data;
    std::ifstream file(folder / "references" / std::filesystem::path(name).replace_extension(".json"));
    const nlohmann::json reference = nlohmann::json::parse(file);
    std::vector<Vec3d> normals;
    for (const auto& n : reference["irradiance_at"]) normals.push_back({n[0], n[1], n[2]});
    ASSERT_EQ(normals.size(), 200u);

    const RgbCoefficients radiance = load_light((folder / "lights" / name).string()).light->project(3);
    const RgbCoefficients irradiance = irradiance_from_radiance(radiance);
    const std::vector<Rgb> drawn = draw_irradiance_at(normals, radiance);
    double largest = 0, error = 0, brute_force_error = 0;
    for (std::size_t i = 0; i < normals.size(); ++i) {
      const Rgb expected = reconstruct(irradiance, normals[i]);
      largest = std::max({largest, expected.r, expected.g, expected.b});
      error = std::max({error, std::abs(drawn[i].r - expected.r), std::abs(drawn[i].g - expected.g),
                        std::abs(drawn[i].b - expected.b)});
      const auto& exact = reference["irradiance"][i];
      brute_force_error = std::max(brute_force_error, std::abs(drawn[i].g - exact[1].get<double>()));
    }
    EXPECT_LT(error, 1e-5 * largest) << name;
    // Three bands are an approximation, but of this very light: its published errors are below 15 % of the maximum.
    EXPECT_LT(brute_force_error, 0.15 * largest) << name;
  }
}

}  // namespace
}  // namespace shlight
