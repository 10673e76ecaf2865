#include "shlight/render/reflectance_glsl.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "shlight/render/render_test_util.h"
#include "shlight/render/sh_glsl.h"
#include "shlight/render/sh_probe.h"
#include "shlight/sh/rotation.h"

namespace shlight {
namespace {

// Of the largest value: three turns and a sum of floats with 6e-8 each.
constexpr double kTolerance = 1e-5;

constexpr Vec3f kBaseColor = {0.8f, 0.5f, 0.2f};

struct Frames {
  std::vector<Vec3d> normals, tangents;
};

// Normals all over the sphere and at both poles, where azimuths are free, each with a tangent of its own.
Frames test_frames() {
  Frames frames;
  const auto add = [&](Vec3d n, double angle) {
    const Vec3d aside = std::abs(n.x) < 0.9 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
    const Vec3d across = cross(aside, n), t = (1 / std::sqrt(dot(across, across))) * across, b = cross(n, t);
    frames.normals.push_back(n);
    frames.tangents.push_back(std::cos(angle) * t + std::sin(angle) * b);
  };
  for (const Vec3d n : {Vec3d{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {-1, 0, 0}})
    for (int k = 0; k < 8; ++k) add(n, k);
  for (int i = 0; i < 500; ++i) add(spiral_direction(i, 500), i);
  return frames;
}

// Σ L_i F_i with the light turned into the local frame, in double: the other way around than the shader does it.
Rgb expected_reflectance(Vec3d n, Vec3d t, const ReflectanceGlslParams& params, const std::vector<float>& coefficients,
                         Vec3f base_color, const RgbCoefficients& light) {
  const Vec3d b = cross(n, t);
  const RgbCoefficients local = rotate(Rotation{{t, b, n}}, light);
  Rgb sum = {};
  for (int l = 0; l < params.bands; ++l)
    for (int m = params.isotropic ? 0 : -l; m <= l; ++m) {
      const int index = params.isotropic ? l * (l + 1) / 2 + m : coefficient_index(l, m);
      const float* const f = coefficients.data() + index * params.channels;
      Vec3f factor = {f[0], f[0], f[0]};
      if (params.channels == 2) factor = f[0] * base_color + Vec3f{f[1], f[1], f[1]};
      if (params.channels == 3) factor = {f[0], f[1], f[2]};
      const Rgb c = local.at(l, m);
      sum = sum + Rgb{factor.x * c.r, factor.y * c.g, factor.z * c.b};
    }
  return sum;
}

class ReflectanceGlsl : public GlTest {};

TEST_F(ReflectanceGlsl, IsTheLightTurnedIntoTheLocalFrame) {
  const Frames frames = test_frames();
  std::mt19937 random(20020601u);
  std::uniform_real_distribution<double> value(-1, 1);
  for (const int bands : {1, 2, 3, 5, 10})
    for (const int channels : {1, 2, 3})
      for (const bool isotropic : {true, false}) {
        // Drivers take seconds to compile ten bands: the shortest and the longest program of them will do.
        if (bands == 10 && (channels == 2 || isotropic != (channels == 1))) continue;
        const ReflectanceGlslParams params = {bands, channels, isotropic};
        RgbCoefficients light(bands);
        for (Rgb& c : light.values()) c = {value(random), value(random), value(random)};
        const int count = isotropic ? bands * (bands + 1) / 2 : num_coefficients(bands);
        std::vector<float> coefficients(static_cast<std::size_t>(count * channels));
        for (float& c : coefficients) c = static_cast<float>(value(random));

        const std::vector<Rgb> drawn =
            draw_reflectance_at(frames.normals, frames.tangents, params, coefficients, kBaseColor, light);
        double largest = 0, error = 0;
        for (std::size_t i = 0; i < drawn.size(); ++i) {
          const Rgb expected =
              expected_reflectance(frames.normals[i], frames.tangents[i], params, coefficients, kBaseColor, light);
          const Rgb difference = drawn[i] - expected;
          largest = std::max({largest, std::abs(expected.r), std::abs(expected.g), std::abs(expected.b)});
          error = std::max({error, std::abs(difference.r), std::abs(difference.g), std::abs(difference.b)});
        }
        EXPECT_LT(error, kTolerance * largest)
            << bands << " bands, " << channels << " channels, " << (isotropic ? "isotropic" : "anisotropic");
      }
}

}  // namespace
}  // namespace shlight
