#include "shlight/render/sh_glsl.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "shlight/core/assert.h"
#include "shlight/sh/zonal.h"

// [1] Ramamoorthi, Hanrahan: An Efficient Representation for Irradiance Environment Maps. SIGGRAPH 2001.
// [2] Sloan: Efficient Spherical Harmonic Evaluation. Journal of Computer Graphics Techniques 2(2), 2013.

namespace shlight {
namespace {

using std::numbers::pi;
using std::numbers::sqrt2;

// Nine digits hold any float; '#' keeps the point that makes it a float in GLSL.
std::string number(double value) {
  return fmt::format("{:#.9g}", value);
}

// Which degrees a sum has: the cosine lobe has Â_l = 0 for odd l > 1.
enum class Degrees { kAll, kCosineLobe };
bool has_degree(Degrees degrees, int l) {
  return degrees == Degrees::kAll || l == 1 || l % 2 == 0;
}

// The first of the polynomials q_l of z, l = m, m+1 …, that belong to one m >= 0:
//
//   Y_lm = q_l(z) Re (x + iy)^m,   Y_l,-m = q_l(z) Im (x + iy)^m,   q_l(z) = √2 K_lm P_l^m(z) / sin^m θ
//
// (without √2 for m = 0), of which the first is constant: q_m = √2 √(1/4π) Π_{k=1..m} √((2k+1)/2k). No Condon-Shortley
// phase.
double first_q(int m) {
  double q = std::sqrt(1 / (4 * pi));
  for (int k = 1; k <= m; ++k) q *= std::sqrt((2 * k + 1.0) / (2 * k));
  return m == 0 ? q : sqrt2 * q;
}

// The definitions of q_m … q_{bands-1} for one m, by the three-term recurrence of normalised functions
//   q_l = a_l (z q_{l-1} - q_{l-2} / a_{l-1}),   a_l = √((4l² - 1) / (l² - m²)).
std::string q_definitions(int bands, int m) {
  const auto a = [m](int l) { return std::sqrt((4.0 * l * l - 1) / (l * l - m * m)); };
  std::string code = fmt::format("    float q{} = {};\n", m, number(first_q(m)));
  for (int l = m + 1; l < bands; ++l) {
    code += fmt::format("    float q{} = {} * z * q{}", l, number(a(l)), l - 1);
    if (l >= m + 2) code += fmt::format(" - {} * q{}", number(a(l) / a(l - 1)), l - 2);
    code += ";\n";
  }
  return code;
}

// "(q1 * u_sh[3] + q2 * u_sh[7])": the sum over l for one m of either sign. Empty where no degree is left.
std::string sum_over_degrees(int bands, int m, Degrees degrees) {
  std::string sum;
  for (int l = std::abs(m); l < bands; ++l)
    if (has_degree(degrees, l))
      sum += fmt::format("{}q{} * u_sh[{}]", sum.empty() ? "(" : " + ", l, coefficient_index(l, m));
  return sum.empty() ? sum : sum + ")";
}

// Σ u_sh[i] Y_i(n) with a block of straight-line code for each |m| [2].
std::string make_sum_glsl(int bands, Degrees degrees) {
  SHLIGHT_ASSERT_LE(1, bands);
  SHLIGHT_ASSERT_LE(bands, kMaxGlslBands);
  std::string code = fmt::format("uniform vec3 u_sh[{}];\nuniform int u_once;\n\n", num_coefficients(bands));
  code += "vec3 eval_sh(vec3 n) {\n  float x = n.x, y = n.y, z = n.z;\n  vec3 sum;\n";
  code += fmt::format("  {{\n{}    sum = {};\n  }}\n", q_definitions(bands, 0), sum_over_degrees(bands, 0, degrees));
  for (int m = 1; m < bands; ++m) {
    // c_m and s_m are the real and imaginary part of (x + iy)^m: sin^m θ cos mφ and sin^m θ sin mφ.
    if (m == 1)
      code += "  float c1 = x, s1 = y;\n";
    else
      code += fmt::format("  float c{0} = x * c{1} - y * s{1}, s{0} = x * s{1} + y * c{1};\n", m, m - 1);
    const std::string plus = sum_over_degrees(bands, m, degrees), minus = sum_over_degrees(bands, -m, degrees);
    if (plus.empty()) continue;
    code += open_block(bands) + q_definitions(bands, m);
    code += fmt::format("    sum += c{0} * {1} + s{0} * {2};\n  }}\n", m, plus, minus);
  }
  return code + "  return sum;\n}\n";
}

// The polynomial [1, eq. 13], with each c a product of Â_l and the constant of Y_lm, see sh/zonal.h:
//
//   E = c1 L22 (x² - y²) + c3 L20 z² + c4 L00 - c5 L20 + 2 c1 (L2-2 xy + L21 xz + L2-1 yz) + 2 c2 (L11 x + L1-1 y + L10
//   z)
std::string make_nine_coefficient_glsl() {
  const auto [c1, c2, c3, c4, c5] = irradiance_polynomial_constants();
  return fmt::format(R"(uniform vec3 u_sh[9];

vec3 eval_sh(vec3 n) {{
  const float c1 = {}, c2 = {}, c3 = {}, c4 = {}, c5 = {};
  float x = n.x, y = n.y, z = n.z;
  return c1 * (x * x - y * y) * u_sh[8] + (c3 * z * z - c5) * u_sh[6] + c4 * u_sh[0] +
         2.0 * c1 * (x * y * u_sh[4] + x * z * u_sh[7] + y * z * u_sh[5]) +
         2.0 * c2 * (x * u_sh[3] + y * u_sh[1] + z * u_sh[2]);
}}
)",
                     number(c1), number(c2), number(c3), number(c4), number(c5));
}

}  // namespace

std::string open_block(int bands) {
  constexpr int kMaxStraightBands = 5;
  return bands <= kMaxStraightBands ? "  {\n" : "  for (int k = 0; k < u_once; ++k) {\n";
}

std::string make_sh_glsl(int bands) {
  return make_sum_glsl(bands, Degrees::kAll);
}

std::string make_irradiance_glsl(int bands) {
  return bands == 3 ? make_nine_coefficient_glsl() : make_sum_glsl(bands, Degrees::kCosineLobe);
}

void set_irradiance_uniforms(const gl::Program& program, const RgbCoefficients& radiance) {
  // The polynomial of three bands has Â_l in its constants.
  set_radiance_uniforms(program, radiance.bands() == 3 ? radiance : irradiance_from_radiance(radiance));
}

void set_radiance_uniforms(const gl::Program& program, const RgbCoefficients& radiance) {
  std::vector<Vec3f> values;
  for (const Rgb& c : radiance.values())
    values.push_back({static_cast<float>(c.r), static_cast<float>(c.g), static_cast<float>(c.b)});
  program.set("u_sh", values);
  program.set("u_once", 1);
}

}  // namespace shlight
