#include "shlight/render/reflectance_glsl.h"

#include <fmt/format.h>

#include <cmath>

#include "shlight/core/assert.h"
#include "shlight/render/sh_glsl.h"
#include "shlight/sh/rotation.h"

// [1] Kautz, Sloan, Snyder 2002: Fast, Arbitrary BRDF Shading for Low-Frequency Lighting Using Spherical Harmonics.
//     Eurographics Workshop on Rendering.
//
// The frame is R = R_z(α) R_y(β) R_z(γ): α and β are the azimuth and the polar angle of n, γ turns t into place. About
// z a pair (m, −m) turns by m times the angle. About y it is a turn about z between two quarter turns Q that carry y to
// z and back, R_y(β) = Qᵀ R_z(β) Q, whose matrices are constants, three quarters of them zero: 5 bands take about 265
// multiplications where full matrices take 165 and their making several times as many.

namespace shlight {
namespace {

constexpr Rotation kFromYToZ = {{Vec3d{1, 0, 0}, Vec3d{0, 0, -1}, Vec3d{0, 1, 0}}};

// The names of f_m in a stage: "a0" … for m = -l … l, as GLSL has no negative names.
std::string name(char stage, int l, int m) {
  return fmt::format("{}{}", stage, m + l);
}

std::string number(double value) {
  return fmt::format("{:#.9g}", value);
}

// c{m} and s{m} of an angle: cos and sin of m times it, from those of the angle itself, "{angle}c1" and "{angle}s1".
std::string multiples(char angle, int bands) {
  std::string code;
  for (int m = 2; m < bands; ++m)
    code += fmt::format(
        "  float {0}c{1} = {0}c1 * {0}c{2} - {0}s1 * {0}s{2}, {0}s{1} = {0}s1 * {0}c{2} + {0}c1 * {0}s{2};\n", angle, m,
        m - 1);
  return code;
}

// Stage `to` = stage `from` turned about z by the angle.
std::string turn_about_z(const std::string& type, int l, char from, char to, char angle) {
  std::string code = fmt::format("    {} {} = {};\n", type, name(to, l, 0), name(from, l, 0));
  for (int m = 1; m <= l; ++m) {
    const std::string cosine = name(from, l, m), sine = name(from, l, -m);
    code += fmt::format("    {0} {1} = {3}c{4} * {5} - {3}s{4} * {6}, {2} = {3}s{4} * {5} + {3}c{4} * {6};\n", type,
                        name(to, l, m), name(to, l, -m), angle, m, cosine, sine);
  }
  return code;
}

// Stage `to` = Q or Qᵀ times stage `from`.
std::string turn_quarter(const RotationMatrix& q, bool transposed, const std::string& type, int l, char from, char to) {
  std::string code;
  for (int m = -l; m <= l; ++m) {
    std::string sum;
    for (int k = -l; k <= l; ++k) {
      const double element = transposed ? q.at(l, k, m) : q.at(l, m, k);
      if (std::abs(element) > 1e-12)
        sum += fmt::format("{}{} * {}", sum.empty() ? "" : " + ", number(element), name(from, l, k));
    }
    code += fmt::format("    {} {} = {};\n", type, name(to, l, m), sum);
  }
  return code;
}

// Σ_m L_lm times stage `from`, added to the result.
std::string add_light(int channels, int l, char from) {
  const auto sum = [&](const char* member) {
    std::string terms;
    for (int m = -l; m <= l; ++m)
      terms +=
          fmt::format("{}{}{} * u_sh[{}]", m == -l ? "" : " + ", name(from, l, m), member, coefficient_index(l, m));
    return terms;
  };
  if (channels == 2) return fmt::format("    tinted += {};\n    plain += {};\n", sum(".x"), sum(".y"));
  return fmt::format("    plain += {};\n", sum(""));
}

}  // namespace

std::string make_reflectance_glsl(const ReflectanceGlslParams& params) {
  const int bands = params.bands;
  SHLIGHT_ASSERT_LE(1, bands);
  SHLIGHT_ASSERT_LE(bands, kMaxGlslBands);
  SHLIGHT_ASSERT_LE(1, params.channels);
  SHLIGHT_ASSERT_LE(params.channels, 3);
  const RotationMatrix q(bands, kFromYToZ);
  const char* const kTypes[] = {"float", "vec2", "vec3"};
  const std::string type = kTypes[params.channels - 1];
  // Four numbers a texel, but of three channels three.
  const int per_texel = params.channels == 3 ? 3 : 4;

  std::string code = fmt::format("uniform vec3 u_sh[{}];\nuniform int u_once;\n\n", num_coefficients(bands));
  code +=
      "vec4 reflectance_texel(int k);\n\nvoid eval_reflectance(vec3 n, vec3 t, out vec3 plain, out vec3 tinted) {\n";
  if (bands > 1) {
    // Over the poles every azimuth is right.
    code +=
        "  float bs1 = sqrt(n.x * n.x + n.y * n.y), bc1 = n.z;\n"
        "  float ac1 = bs1 > 1e-7 ? n.x / bs1 : 1.0, as1 = bs1 > 1e-7 ? n.y / bs1 : 0.0;\n"
        "  float gc1 = bc1 * (ac1 * t.x + as1 * t.y) - bs1 * t.z, gs1 = ac1 * t.y - as1 * t.x;\n";
    for (const char angle : {'a', 'b', 'g'}) code += multiples(angle, bands);
  }
  code += "  plain = tinted = vec3(0.0);\n  vec4 texel;\n";

  int loaded = -1;
  for (int l = 0; l < bands; ++l) {
    code += open_block(bands);
    // Stage f: the table's coefficients; those of negative m are zero where reflectance is isotropic.
    for (int m = params.isotropic ? 0 : -l; m <= l; ++m) {
      const int index = params.isotropic ? l * (l + 1) / 2 + m : coefficient_index(l, m);
      const int first = index * params.channels, texel = first / per_texel;
      if (texel != loaded) code += fmt::format("    texel = reflectance_texel({});\n", texel);
      loaded = texel;
      code += fmt::format("    {} {} = texel.{};\n", type, name('f', l, m),
                          std::string("xyzw").substr(first % per_texel, params.channels));
    }
    if (l == 0) {
      code += add_light(params.channels, l, 'f') + "  }\n";
      continue;
    }
    if (params.isotropic) {
      code += fmt::format("    {} {} = {};\n", type, name('g', l, 0), name('f', l, 0));
      for (int m = 1; m <= l; ++m)
        code += fmt::format("    {0} {1} = gc{3} * {4}, {2} = gs{3} * {4};\n", type, name('g', l, m), name('g', l, -m),
                            m, name('f', l, m));
    } else {
      code += turn_about_z(type, l, 'f', 'g', 'g');
    }
    code += turn_quarter(q, false, type, l, 'g', 'h');
    code += turn_about_z(type, l, 'h', 'i', 'b');
    code += turn_quarter(q, true, type, l, 'i', 'j');
    code += turn_about_z(type, l, 'j', 'w', 'a');
    code += add_light(params.channels, l, 'w') + "  }\n";
  }
  return code + "}\n";
}

}  // namespace shlight
