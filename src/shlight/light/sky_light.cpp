#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "shlight/light/builtin_light.h"

// [1] Preetham, Shirley & Smits 1999, A Practical Analytic Model for Daylight, SIGGRAPH; its appendix A has all
// numbers.

namespace shlight {
namespace {

using std::numbers::pi;

constexpr double kDegree = pi / 180;
constexpr double kUnitsPerKilocandela = 0.1;  // of radiance, a kcd/m²
constexpr double kSunLuminance = 1.6e6;       // kcd/m², outside of the atmosphere

// The distribution of Perez et al.: A … E of one quantity [1, eq. 3].
struct Perez {
  double a, b, c, d, e;
  double operator()(double cos_theta, double gamma) const {
    const double cos_gamma = std::cos(gamma);
    return (1 + a * std::exp(b / cos_theta)) * (1 + c * std::exp(d * gamma) + e * cos_gamma * cos_gamma);
  }
};

// Luminance Y (kcd/m²) and chromaticities x, y of the clear sky.
class PreethamSky {
 public:
  PreethamSky(double turbidity, Vec3d sun) : sun_(sun) {
    const double t = turbidity, theta = std::acos(std::clamp(sun.y, -1.0, 1.0));
    distribution_ = {Perez{0.1787 * t - 1.4630, -0.3554 * t + 0.4275, -0.0227 * t + 5.3251, 0.1206 * t - 2.5771,
                           -0.0670 * t + 0.3703},
                     Perez{-0.0193 * t - 0.2592, -0.0665 * t + 0.0008, -0.0004 * t + 0.2125, -0.0641 * t - 0.8989,
                           -0.0033 * t + 0.0452},
                     Perez{-0.0167 * t - 0.2608, -0.0950 * t + 0.0092, -0.0079 * t + 0.2102, -0.0441 * t - 1.6537,
                           -0.0109 * t + 0.0529}};
    const double chi = (4.0 / 9 - t / 120) * (pi - 2 * theta);
    const auto chromaticity = [&](const double(&m)[3][4]) {
      double value = 0;
      const double powers[3] = {t * t, t, 1};
      for (int i = 0; i < 3; ++i)
        value += powers[i] * (((m[i][0] * theta + m[i][1]) * theta + m[i][2]) * theta + m[i][3]);
      return value;
    };
    zenith_ = {std::max(0.0, (4.0453 * t - 4.9710) * std::tan(chi) - 0.2155 * t + 2.4192),
               chromaticity({{0.00166, -0.00375, 0.00209, 0},
                             {-0.02903, 0.06377, -0.03202, 0.00394},
                             {0.11693, -0.21196, 0.06052, 0.25886}}),
               chromaticity({{0.00275, -0.00610, 0.00317, 0},
                             {-0.04214, 0.08970, -0.04153, 0.00516},
                             {0.15346, -0.26756, 0.06670, 0.26688}})};
    for (std::size_t i = 0; i < 3; ++i) zenith_[i] /= distribution_[i](1, theta);
  }

  // Above the horizon.
  Rgb operator()(Vec3d d) const {
    const double cos_theta = std::max(d.y, 1e-3);
    const double gamma = std::acos(std::clamp(dot(d, sun_), -1.0, 1.0));
    std::array<double, 3> value = zenith_;
    for (std::size_t i = 0; i < 3; ++i) value[i] *= distribution_[i](cos_theta, gamma);
    const auto [luminance, x, y] = value;
    const double big_x = x / y * luminance, big_z = (1 - x - y) / y * luminance;
    // XYZ to linear Rec. 709 (ITU-R BT.709 primaries, D65). Colours outside of its gamut are cut off.
    const Rgb rgb = {3.2404542 * big_x - 1.5371385 * luminance - 0.4985314 * big_z,
                     -0.9692660 * big_x + 1.8760108 * luminance + 0.0415560 * big_z,
                     0.0556434 * big_x - 0.2040259 * luminance + 1.0572252 * big_z};
    return kUnitsPerKilocandela * Rgb{std::max(0.0, rgb.r), std::max(0.0, rgb.g), std::max(0.0, rgb.b)};
  }

 private:
  Vec3d sun_;
  std::array<Perez, 3> distribution_;
  std::array<double, 3> zenith_;
};

// What is left of the sun behind the air: Rayleigh scattering and aerosols at three wavelengths [1, A.1].
Rgb sun_radiance(double turbidity, double elevation_degrees) {
  const double zenith_degrees = 90 - elevation_degrees;
  const double mass = 1 / (std::cos(zenith_degrees * kDegree) + 0.15 * std::pow(93.885 - zenith_degrees, -1.253));
  const double beta = 0.04608365822050 * turbidity - 0.04586025928522;
  const auto transmitted = [&](double micrometres) {
    return std::exp(-mass * (0.008735 * std::pow(micrometres, -4.08) + beta * std::pow(micrometres, -1.3)));
  };
  return kUnitsPerKilocandela * kSunLuminance * Rgb{transmitted(0.610), transmitted(0.550), transmitted(0.465)};
}

}  // namespace

std::unique_ptr<Light> make_sky_light(const SkyParams& params) {
  const double e = params.elevation * kDegree, a = params.azimuth * kDegree;
  const Vec3d sun = {std::cos(e) * std::sin(a), std::sin(e), -std::cos(e) * std::cos(a)};
  const PreethamSky sky(params.turbidity, sun);
  const Rgb sun_disc = sun_radiance(params.turbidity, params.elevation);

  // The ground is lit by the sky above it, ∫ L cos θ dω, and by the sun.
  Rgb irradiance = 2 * pi * (1 - std::cos(kSunHalfAngle)) * std::max(0.0, sun.y) * sun_disc;
  const GaussLegendre rule = make_gauss_legendre(32);
  constexpr int kAzimuths = 128;
  for (std::size_t i = 0; i < rule.nodes.size(); ++i)
    for (int j = 0; j < kAzimuths; ++j) {
      const double up = 0.5 * (1 + rule.nodes[i]), s = std::sqrt(1 - up * up), phi = 2 * pi * j / kAzimuths;
      irradiance += 0.5 * rule.weights[i] * up * 2 * pi / kAzimuths * sky({s * std::sin(phi), up, -s * std::cos(phi)});
    }
  const Rgb ground = params.ground / pi * Rgb{irradiance.r, 0.96 * irradiance.g, 0.88 * irradiance.b};
  // Toward the horizon the ground fades into the haze that stands before it: without an edge there, coefficients ring
  // less.
  const auto below = [sky, ground](Vec3d d) {
    constexpr double kHazeHeight = 0.04;
    const double haze = std::exp(d.y / kHazeHeight), s = std::hypot(d.x, d.z);
    if (haze < 1e-4 || s == 0) return ground;
    return haze * sky({d.x / s, 0, d.z / s}) + (1 - haze) * ground;
  };
  // A sun on the horizon is half set; its closed form is a whole disc all the same.
  return std::make_unique<FunctionLight>([sky, below](Vec3d d) { return d.y >= 0 ? sky(d) : below(d); },
                                         std::vector<FunctionLight::Disc>{{sun, kSunHalfAngle, sun_disc}});
}

}  // namespace shlight
