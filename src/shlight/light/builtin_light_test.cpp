#include "shlight/light/builtin_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "shlight/core/error.h"
#include "shlight/light/project_image.h"
#include "shlight/sh/basis.h"
#include "shlight/sh/zonal.h"

namespace shlight {
namespace {

using std::numbers::pi;

TEST(BuiltinLight, ThesisLightHasThePublishedCoefficients) {
  // By quadrature, with the Condon-Shortley phase (−1)^m, which our convention does not have.
  const double published[16] = {0.39881, -0.21052, 0.28655, 0.28182, -0.31499, 0,        0.13140, 0,
                                0.09318, -0.24961, 0,       0.12336, 0.30389,  -0.16513, 0,       -0.09224};
  const RgbCoefficients c = make_thesis_light()->project(4);
  for (int l = 0; l < 4; ++l)
    for (int m = -l; m <= l; ++m) {
      const double phase = m % 2 ? -1 : 1;
      // Their quadrature was off by up to 2.2e-5, as the closed form below shows.
      EXPECT_NEAR(phase * c.at(l, m).r, published[coefficient_index(l, m)], 2.5e-5) << "l " << l << " m " << m;
    }
}

// Both lobes are max(0, a (d·axis) − b): zonal, 2π ∫ (a z − b) P_l(z) dz from b/a to 1, turned to their axis.
TEST(BuiltinLight, ThesisLightIsItsClosedForm) {
  constexpr int kBands = 6;
  RgbCoefficients exact(kBands);
  struct Lobe {
    double a, b;
    Vec3d axis;
  };
  const GaussLegendre rule = make_gauss_legendre(12);
  for (const auto& [a, b, axis] : {Lobe{5, 4, {0, 0, 1}}, Lobe{4, 3, {std::cos(2.5), std::sin(2.5), 0}}}) {
    RgbCoefficients delta(kBands);
    add_delta(axis, {1, 1, 1}, delta);
    for (int l = 0; l < kBands; ++l) {
      double integral = 0;
      for (std::size_t k = 0; k < rule.nodes.size(); ++k) {
        const double low = b / a, z = low + (1 - low) * 0.5 * (1 + rule.nodes[k]);
        integral += 0.5 * (1 - low) * rule.weights[k] * (a * z - b) * std::legendre(static_cast<unsigned>(l), z);
      }
      for (int m = -l; m <= l; ++m) exact.at(l, m) += 2 * pi * integral * delta.at(l, m);
    }
  }
  const RgbCoefficients c = make_thesis_light()->project(kBands);
  for (std::size_t i = 0; i < c.size(); ++i) EXPECT_NEAR(c[i].r, exact[i].r, 2e-6) << "coefficient " << i;
}

// The coefficients of a light and those of a picture of it: projection and radiance() tell of the same light.
TEST(BuiltinLight, CoefficientsAreThoseOfThePicture) {
  for (const char* name : {"sky:elevation=12", "sky:elevation=80,turbidity=6,ground=0.5", "studio",
                           "panel:elevation=60,azimuth=100", "axes", "thesis"}) {
    const auto light = make_builtin_light(name);
    const RgbCoefficients exact = light->project(5);
    const RgbCoefficients picture = project_image({light->lat_long(1024), Layout::kLatLong}, 5);
    const double tolerance = 3e-3 * std::abs(exact[0].g);
    for (std::size_t i = 0; i < exact.size(); ++i) {
      EXPECT_NEAR(picture[i].r, exact[i].r, tolerance) << name << ", coefficient " << i;
      EXPECT_NEAR(picture[i].g, exact[i].g, tolerance) << name << ", coefficient " << i;
      EXPECT_NEAR(picture[i].b, exact[i].b, tolerance) << name << ", coefficient " << i;
    }
  }
}

// A panel that subtends the solid angle 4 asin(sin(a/2) sin(b/2)), as rectangles seen from their axis do.
TEST(BuiltinLight, PanelHasItsSize) {
  PanelParams params;
  params.width = 60, params.height = 20, params.radiance = 3, params.background = 0.5;
  const auto panel = make_panel_light(params);
  const double solid_angle = 4 * std::asin(std::sin(30 * pi / 180) * std::sin(10 * pi / 180));
  EXPECT_NEAR(panel->project(3)[0].g * std::sqrt(4 * pi), 3 * solid_angle + 0.5 * 4 * pi, 1e-12);
  // Its edges are where they should be, and it faces the origin.
  const auto at = [&](double azimuth, double elevation) {
    const double a = azimuth * pi / 180, e = elevation * pi / 180;
    return panel->radiance({std::cos(e) * std::sin(a), std::sin(e), -std::cos(e) * std::cos(a)}).g;
  };
  EXPECT_EQ(at(params.azimuth, params.elevation + 9.9), 3.5);
  EXPECT_EQ(at(params.azimuth, params.elevation + 10.1), 0.5);
  EXPECT_EQ(at(params.azimuth, params.elevation - 9.9), 3.5);
  EXPECT_EQ(at(params.azimuth + 180, -params.elevation), 0.5);
}

TEST(BuiltinLight, AxesLightTheSideThatFacesThem) {
  const RgbCoefficients irradiance = irradiance_from_radiance(make_axes_light()->project(3));
  const auto at = [&](Vec3d n) { return reconstruct(irradiance, n); };
  EXPECT_GT(at({1, 0, 0}).r, 2 * at({-1, 0, 0}).r);
  EXPECT_GT(at({-1, 0, 0}).g, 2 * at({1, 0, 0}).g);
  EXPECT_GT(at({0, 1, 0}).g, 2 * at({0, -1, 0}).g);
  EXPECT_GT(at({0, -1, 0}).r, 2 * at({0, 1, 0}).r);
  EXPECT_GT(at({0, 0, 1}).b, 2 * at({0, 0, -1}).b);
  EXPECT_GT(at({0, 0, -1}).r, 2 * at({0, 0, 1}).r);
}

TEST(BuiltinLight, SkyIsBlueAboveAndItsSunWhereItWasPut) {
  SkyParams params;
  params.elevation = 30, params.azimuth = 90;
  const auto sky = make_sky_light(params);
  const Vec3d sun = {std::cos(pi / 6), 0.5, 0};
  EXPECT_GT(luminance(sky->radiance(sun)), 1e3 * luminance(sky->radiance({0, 1, 0})));
  EXPECT_GT(sky->radiance({-0.6, 0.8, 0}).b, 1.5 * sky->radiance({-0.6, 0.8, 0}).r);
  for (const Vec3d d : make_sphere_samples(0, 40, 2).directions) {
    const Rgb value = sky->radiance(d);
    EXPECT_TRUE(value.r >= 0 && value.g >= 0 && value.b >= 0 && std::isfinite(luminance(value)));
  }
  // A clear noon: the sun gives several times as much as the sky (about 100 and 15 klx).
  params.elevation = 70;
  const auto noon = make_sky_light(params);
  RgbCoefficients disc(1);
  add_disc({0, 1, 0}, 0.2665 * pi / 180, noon->radiance({std::cos(70 * pi / 180), std::sin(70 * pi / 180), 0}), disc);
  const double sun_power = luminance(disc[0]), all_power = luminance(noon->project(1)[0]);
  EXPECT_GT(sun_power / all_power, 0.4);  // the ground that it lights counts with the rest
  EXPECT_LT(sun_power / all_power, 0.95);
}

TEST(BuiltinLight, RefusesWhatItDoesNotKnow) {
  for (const char* name :
       {"", "moon", "sky:elevation", "sky:elevation=", "sky:elevation=x", "sky:elevation=95", "sky:elevation=nan",
        "sky:height=3", "sky:,", "studio:key=2", "panel:width=0", "panel:width=180"})
    EXPECT_THROW(make_builtin_light(name), Error) << name;
}

}  // namespace
}  // namespace shlight
