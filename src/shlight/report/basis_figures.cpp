#include "shlight/report/basis_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "shlight/scene/shapes.h"
#include "shlight/scene/transform.h"
#include "shlight/sh/basis.h"
#include "shlight/truth/svg.h"

namespace shlight {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr Vec3f kPositive = {0.85f, 0.42f, 0.10f}, kNegative = {0.08f, 0.28f, 0.60f};

Vec3d normalize(Vec3d v) {
  return (1 / std::sqrt(dot(v, v))) * v;
}

// One value of the basis.
double eval_one(int l, int m, Vec3d direction) {
  std::vector<double> values(static_cast<std::size_t>(num_coefficients(l + 1)));
  eval_basis<double>(l + 1, direction, values);
  return values[coefficient_index(l, m)];
}

}  // namespace

double eval_associated_legendre(int l, int m, double x) {
  const NormalizedLegendre legendre(l + 1);
  std::vector<double> p(legendre.size());
  legendre.eval(x, std::sqrt(std::max(0.0, 1 - x * x)), p);
  // Without K_l^m and, for m > 0, √2; with the phase.
  double factorials = 1;
  for (int k = l - m + 1; k <= l + m; ++k) factorials *= k;
  const double norm = std::sqrt((2 * l + 1) / (4 * kPi) / factorials) * (m > 0 ? std::numbers::sqrt2 : 1);
  return (m % 2 == 0 ? 1 : -1) * p[static_cast<std::size_t>(l * (l + 1) / 2 + m)] / norm;
}

Mesh make_balloon(int l, int m, float radius) {
  Mesh mesh = make_sphere(1, 64);
  mesh.name = fmt::format("Y_{}^{}", l, m);
  double largest = 0;
  for (const Vec3f& p : mesh.positions) largest = std::max(largest, std::abs(eval_one(l, m, vec_cast<double>(p))));
  const double scale = double{radius} / largest;
  const auto surface = [&](Vec3d d) { return scale * std::abs(eval_one(l, m, d)) * d; };
  mesh.colors.clear();
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const Vec3d d = normalize(vec_cast<double>(mesh.positions[i]));
    // Two directions along the sphere, a step each way: the surface's tangents there.
    constexpr double kStep = 1e-4;
    const Vec3d a = normalize(cross(d, std::abs(d.x) < 0.7 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0})), b = cross(d, a);
    const auto tangent = [&](Vec3d t) { return surface(normalize(d + kStep * t)) - surface(normalize(d - kStep * t)); };
    const Vec3d normal = cross(tangent(a), tangent(b));
    mesh.positions[i] = vec_cast<float>(surface(d));
    // On a nodal line the surface is a point of the origin, which has no normal.
    mesh.normals[i] = vec_cast<float>(dot(normal, normal) > 0 ? normalize(normal) : d);
    mesh.colors.push_back(eval_one(l, m, d) >= 0 ? kPositive : kNegative);
  }
  return mesh;
}

Scene make_balloon_scene(int bands) {
  Scene scene;
  scene.materials.push_back({"balloon", {1, 1, 1}, {}, {}});
  // From the basis's polar axis z to the world's up.
  const Mat4f upright = make_rotation({1, 0, 0}, -90);
  for (int l = 0; l < bands; ++l)
    for (int m = -l; m <= l; ++m) {
      const auto x = static_cast<float>(m), y = 1.1f * static_cast<float>(bands - 1 - l);
      scene.instances.push_back(
          {static_cast<std::uint32_t>(scene.meshes.size()), multiply(make_translation({x, y, 0}), upright)});
      scene.meshes.push_back(make_balloon(l, m, 0.48f));
    }
  return scene;
}

double orthonormality_error(const SphereSamples& samples) {
  const auto n = static_cast<std::size_t>(num_coefficients(samples.bands));
  std::vector<double> products(n * n);
  for (std::size_t s = 0; s < samples.directions.size(); ++s) {
    const std::span<const double> y = samples.basis_of(s);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j <= i; ++j) products[i * n + j] += y[i] * y[j];
  }
  double largest = 0;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      const double mean = 4 * kPi / static_cast<double>(samples.directions.size()) * products[i * n + j];
      largest = std::max(largest, std::abs(mean - (i == j ? 1 : 0)));
    }
  return largest;
}

SphereSamples make_independent_samples(int bands, int count) {
  SphereSamples all;
  all.bands = bands;
  for (int i = 0; i < count; ++i) {
    const SphereSamples one = make_sphere_samples(bands, 1, static_cast<std::uint64_t>(i) + 1);
    all.directions.push_back(one.directions[0]);
    all.basis.insert(all.basis.end(), one.basis.begin(), one.basis.end());
  }
  return all;
}

std::string make_sample_plot(const SphereSamples& samples) {
  constexpr double kTop = 14, kChartLeft = 34, kChartWidth = 230, kHeight = 190, kBallX = 378, kBallY = 109,
                   kRadius = 94;
  std::string svg = svg_begin(486, 244, ".dot{fill:#2a7fc9}.ball{fill:none;stroke:#999999}", ".dot{fill:#5aa9ee}");
  const auto add_dot = [&](double x, double y) {
    svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"1.2\" class=\"dot\"/>\n", x, y);
  };
  for (const Vec3d& d : samples.directions) {
    const double theta = std::acos(std::clamp(d.z, -1.0, 1.0)), phi = std::atan2(d.y, d.x);
    add_dot(kChartLeft + kChartWidth * (phi < 0 ? phi + 2 * kPi : phi) / (2 * kPi), kTop + kHeight * theta / kPi);
    // Seen along −y, z up.
    if (d.y < 0) add_dot(kBallX + kRadius * d.x, kBallY - kRadius * d.z);
  }
  svg += fmt::format("<path d=\"M{0} {1}V{2}H{3}\" class=\"axis\"/>\n", kChartLeft, kTop, kTop + kHeight,
                     kChartLeft + kChartWidth);
  svg += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\" class=\"ball\"/>\n", kBallX, kBallY, kRadius);
  svg += svg_text(kChartLeft - 8, kTop + 8, "ink", "end", "0") +
         svg_text(kChartLeft - 8, kTop + kHeight, "ink", "end", "π") +
         svg_text(kChartLeft - 8, kTop + kHeight / 2 + 4, "ink", "end", "θ") +
         svg_text(kChartLeft, kTop + kHeight + 18, "ink", "middle", "0") +
         svg_text(kChartLeft + kChartWidth / 2, kTop + kHeight + 18, "ink", "middle", "φ") +
         svg_text(kChartLeft + kChartWidth, kTop + kHeight + 18, "ink", "middle", "2π") +
         svg_text(kBallX, kTop + kHeight + 30, "faint", "middle", "the half that faces you");
  return svg + "</svg>\n";
}

}  // namespace shlight
