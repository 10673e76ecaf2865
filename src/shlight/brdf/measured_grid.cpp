#include "shlight/brdf/measured_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "shlight/brdf/slopes.h"

namespace shlight {

using std::numbers::pi;

HalfDifference half_difference(Vec3d s, Vec3d v) {
  const Vec3d sum = s + v;
  const double length = std::sqrt(dot(sum, sum));
  const Vec3d h = 1 / length * sum;
  const double sine = std::sqrt(h.x * h.x + h.y * h.y);
  const double cos_phi = sine > 0 ? h.x / sine : 1, sin_phi = sine > 0 ? h.y / sine : 0;
  // s, turned back by the azimuth of h about z and then by its polar angle about y.
  const double x = s.x * cos_phi + s.y * sin_phi, y = s.y * cos_phi - s.x * sin_phi;
  double phi = std::atan2(y, x * h.z - s.z * sine);
  if (phi < 0) phi += pi;
  if (phi >= pi) phi -= pi;
  return {std::atan2(sine, h.z), std::acos(std::min(1.0, 0.5 * length)), phi};
}

DirectionPair directions_of(const HalfDifference& angles) {
  const double c = std::cos(angles.theta_h), s = std::sin(angles.theta_h);
  const Vec3d d = {std::sin(angles.theta_d) * std::cos(angles.phi_d), std::sin(angles.theta_d) * std::sin(angles.phi_d),
                   std::cos(angles.theta_d)};
  const auto turned = [&](Vec3d a) { return Vec3d{a.x * c + a.z * s, a.y, a.z * c - a.x * s}; };
  return {turned(d), turned({-d.x, -d.y, d.z})};
}

HalfDifference MeasuredGrid::centre(std::size_t h, std::size_t d, std::size_t phi) const {
  const double k = (static_cast<double>(h) + 0.5) / static_cast<double>(theta_h);
  return {pi / 2 * k * k, pi / 2 * (static_cast<double>(d) + 0.5) / static_cast<double>(theta_d),
          pi * (static_cast<double>(phi) + 0.5) / static_cast<double>(phi_d)};
}

namespace {

bool is_missing(Rgb value) {
  return value.r < 0 || value.g < 0 || value.b < 0;
}

void mirror(MeasuredGrid& grid) {
  for (std::size_t row = 0; row < grid.size(); row += grid.phi_d)
    for (std::size_t j = 0; j < grid.phi_d / 2; ++j) {
      Rgb &a = grid.values[row + j], &b = grid.values[row + grid.phi_d - 1 - j];
      if (is_missing(a)) {
        a = b;
      } else if (is_missing(b)) {
        b = a;
      } else {
        a = b = 0.5 * (a + b);
      }
    }
}

// The slope of the half vector at which the highlight, with the light near the eye, has half of its height.
double highlight_width(const MeasuredGrid& grid) {
  const auto value = [&](std::size_t h) { return luminance(grid.values[grid.index(h, 0, 0)]); };
  std::size_t h = 0;
  while (h + 1 < grid.theta_h && value(h) > 0.5 * value(0)) ++h;
  return std::clamp(std::tan(grid.centre(h, 0, 0).theta_h), 0.01, 1.0);
}

// The two cells about a place, and the share of the second. `at` counts cells from the border of the first.
struct Between {
  std::array<std::size_t, 2> cells;
  double share;
};
Between between(double at, std::size_t count) {
  const double from_centre = std::clamp(at - 0.5, 0.0, static_cast<double>(count - 1));
  const auto low = std::min(static_cast<std::size_t>(from_centre), count - 1);
  return {{low, std::min(low + 1, count - 1)}, from_centre - static_cast<double>(low)};
}
Between between_around(double at, std::size_t count) {
  const double from_centre = at < 0.5 ? at - 0.5 + static_cast<double>(count) : at - 0.5;
  const auto low = std::min(static_cast<std::size_t>(from_centre), count - 1);
  return {{low, (low + 1) % count}, from_centre - static_cast<double>(low)};
}

class MeasuredBrdf : public Brdf {
 public:
  MeasuredBrdf(MeasuredGrid grid, double width)
      : Brdf({BrdfSymmetry::kIsotropic, false, {{LobeShape::kHalfVector, width, width}}}),
        grid_(std::move(grid)),
        width_(width) {}

  Rgb eval_lobe(std::size_t, Vec3d s, Vec3d v) const override {
    const HalfDifference angles = half_difference(s, v);
    const auto scaled = [](double part, std::size_t count) { return part * static_cast<double>(count); };
    const Between h = between(scaled(std::sqrt(angles.theta_h * 2 / pi), grid_.theta_h), grid_.theta_h);
    const Between d = between(scaled(angles.theta_d * 2 / pi, grid_.theta_d), grid_.theta_d);
    const Between phi = between_around(scaled(angles.phi_d / pi, grid_.phi_d), grid_.phi_d);
    Rgb sum;
    double shares = 0;
    for (std::size_t corner = 0; corner < 8; ++corner) {
      const std::size_t i = corner & 1, j = corner >> 1 & 1, k = corner >> 2;
      const Rgb value = grid_.values[grid_.index(h.cells[i], d.cells[j], phi.cells[k])];
      if (is_missing(value)) continue;
      const double share = (i ? h.share : 1 - h.share) * (j ? d.share : 1 - d.share) * (k ? phi.share : 1 - phi.share);
      sum += share * value;
      shares += share;
    }
    return shares > 0 ? 1 / shares * sum : Rgb{};
  }

  Vec3d sample_lobe(std::size_t lobe, Vec3d v, double u1, double u2) const override {
    return u1 < 0.5 ? Brdf::sample_lobe(lobe, v, 2 * u1, u2)
                    : sample_gaussian_slopes(width_, width_, v, 2 * u1 - 1, u2);
  }
  double sample_lobe_pdf(std::size_t lobe, Vec3d s, Vec3d v) const override {
    return 0.5 * (Brdf::sample_lobe_pdf(lobe, s, v) + gaussian_slopes_pdf(width_, width_, s, v));
  }

 private:
  MeasuredGrid grid_;
  double width_;
};

}  // namespace

std::unique_ptr<Brdf> make_measured_brdf(MeasuredGrid grid) {
  mirror(grid);
  const double width = highlight_width(grid);
  return std::make_unique<MeasuredBrdf>(std::move(grid), width);
}

}  // namespace shlight
