#include "shlight/truth/flip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>

#include "shlight/core/assert.h"
#include "shlight/core/parallel.h"
#include "shlight/core/quantile.h"

namespace shlight {
namespace {

// --- colour spaces

// A colour in a space of three numbers: CIE XYZ over the white's, or an opponent space.
using Color = std::array<double, 3>;

// Linear Rec. 709 to CIE XYZ, from the chromaticities of its primaries and of the white D65 (ITU-R BT.709), with each
// row divided by the white's X, Y or Z, so that white is (1, 1, 1); and its inverse.
struct Rec709 {
  std::array<Color, 3> to_xyz, from_xyz;
};

Rec709 make_rec709() {
  const auto xyz = [](double x, double y) { return Vec3d{x / y, 1, (1 - x - y) / y}; };
  const Vec3d red = xyz(0.64, 0.33), green = xyz(0.30, 0.60), blue = xyz(0.15, 0.06), white = xyz(0.3127, 0.3290);
  // How much of each primary makes white, by Cramer's rule.
  const double all = dot(red, cross(green, blue));
  const Vec3d share = {dot(white, cross(green, blue)) / all, dot(red, cross(white, blue)) / all,
                       dot(red, cross(green, white)) / all};
  const std::array<Vec3d, 3> rows = {Vec3d{share.x * red.x, share.y * green.x, share.z * blue.x},
                                     Vec3d{share.x, share.y, share.z},
                                     Vec3d{share.x * red.z, share.y * green.z, share.z * blue.z}};
  const std::array<Vec3d, 3> m = {1 / white.x * rows[0], rows[1], 1 / white.z * rows[2]};
  const double determinant = dot(m[0], cross(m[1], m[2]));
  const std::array<Vec3d, 3> columns = {1 / determinant * cross(m[1], m[2]), 1 / determinant * cross(m[2], m[0]),
                                        1 / determinant * cross(m[0], m[1])};
  return {{Color{m[0].x, m[0].y, m[0].z}, Color{m[1].x, m[1].y, m[1].z}, Color{m[2].x, m[2].y, m[2].z}},
          {Color{columns[0].x, columns[1].x, columns[2].x}, Color{columns[0].y, columns[1].y, columns[2].y},
           Color{columns[0].z, columns[1].z, columns[2].z}}};
}

Color multiply(const std::array<Color, 3>& m, const Color& c) {
  Color result;
  for (std::size_t i = 0; i < 3; ++i) result[i] = m[i][0] * c[0] + m[i][1] * c[1] + m[i][2] * c[2];
  return result;
}

// CIE L*a*b* without its cube root: linear, so that filtering in it is filtering light [1, section 4.1.1].
Color ycxcz_from_xyz(const Color& xyz) {
  return {116 * xyz[1] - 16, 500 * (xyz[0] - xyz[1]), 200 * (xyz[1] - xyz[2])};
}
Color xyz_from_ycxcz(const Color& c) {
  const double y = (c[0] + 16) / 116;
  return {y + c[1] / 500, y, y - c[2] / 200};
}

// CIE L*a*b*, its a and b after Hunt: what is darker looks less colourful [1, eq. 5].
Color hunt_lab_from_xyz(const Color& xyz) {
  const auto f = [](double t) {
    constexpr double kDelta = 6.0 / 29;
    return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3 * kDelta * kDelta) + 4.0 / 29;
  };
  const double fx = f(xyz[0]), fy = f(xyz[1]), fz = f(xyz[2]);
  const double lightness = 116 * fy - 16;
  return {lightness, 0.01 * lightness * 500 * (fx - fy), 0.01 * lightness * 200 * (fy - fz)};
}

// Euclidean in colour, city block between that and lightness [1, eq. 6].
double hyab(const Color& a, const Color& b) {
  return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]);
}

// --- filters

// The contrast sensitivity of one channel as a filter of the picture: a1 √(π/b1) exp(−π²d²/b1) + a2 √(π/b2)
// exp(−π²d²/b2) of the distance d in degrees, made to add up to 1 [1, table 1 and eq. 4]. Each term is separable.
struct ContrastSensitivity {
  double a1, b1, a2, b2;
};
constexpr ContrastSensitivity kAchromatic = {1, 0.0047, 0, 1e-5}, kRedGreen = {1, 0.0053, 0, 1e-5},
                              kBlueYellow = {34.1, 0.04, 13.5, 0.025};

// Three standard deviations of the widest term [1, section 4.1.1].
int sensitivity_radius(double pixels_per_degree) {
  return static_cast<int>(
      std::ceil(3 * std::sqrt(kBlueYellow.b1 / (2 * std::numbers::pi * std::numbers::pi)) * pixels_per_degree));
}

Plane filter_by_sensitivity(const Plane& plane, const ContrastSensitivity& s, const FlipParams& params) {
  const int radius = sensitivity_radius(params.pixels_per_degree);
  std::array<std::vector<double>, 2> kernels;
  std::array<double, 2> weights = {};
  const auto make = [&](std::size_t k, double a, double b) {
    kernels[k] = make_gaussian(std::sqrt(b / 2) / std::numbers::pi * params.pixels_per_degree, radius);
    // The sum of the term over the square, relative to its middle, is one over the normed kernel's middle, squared.
    const double middle = kernels[k][static_cast<std::size_t>(radius)];
    weights[k] = a * std::sqrt(std::numbers::pi / b) / (middle * middle);
  };
  make(0, s.a1, s.b1);
  Plane result = filter_separably(plane, kernels[0], kernels[0], params.threads);
  if (s.a2 == 0) return result;
  make(1, s.a2, s.b2);
  const Plane second = filter_separably(plane, kernels[1], kernels[1], params.threads);
  const double first_share = weights[0] / (weights[0] + weights[1]);
  for (std::size_t i = 0; i < result.values.size(); ++i)
    result.values[i] =
        static_cast<float>(first_share * double{result.values[i]} + (1 - first_share) * double{second.values[i]});
  return result;
}

// The kernels that find edges and points: derivatives of a Gaussian as wide as what an observer sees best [1, section
// 4.2]. Positive and negative values add up to 1 and −1.
struct FeatureKernels {
  std::vector<double> across, edge, point;
};

FeatureKernels make_feature_kernels(double pixels_per_degree) {
  constexpr double kFeatureWidth = 0.082;  // degrees
  const double sigma = 0.5 * kFeatureWidth * pixels_per_degree;
  const int radius = static_cast<int>(std::ceil(3 * sigma));
  FeatureKernels kernels{make_gaussian(sigma, radius), {}, {}};
  for (int x = -radius; x <= radius; ++x) {
    const double g = kernels.across[static_cast<std::size_t>(x + radius)], t = x / sigma;
    kernels.edge.push_back(-t * g);
    kernels.point.push_back((t * t - 1) * g);
  }
  for (std::vector<double>* kernel : {&kernels.edge, &kernels.point}) {
    double positive = 0, negative = 0;
    for (const double k : *kernel) (k > 0 ? positive : negative) += std::abs(k);
    for (double& k : *kernel) k /= k > 0 ? positive : negative;
  }
  return kernels;
}

// The length of the two-dimensional gradient, or of the second derivatives.
Plane feature_strength(const Plane& plane, const std::vector<double>& along, const std::vector<double>& across,
                       int threads) {
  Plane result = filter_separably(plane, along, across, threads);
  const Plane other = filter_separably(plane, across, along, threads);
  for (std::size_t i = 0; i < result.values.size(); ++i)
    result.values[i] = std::hypot(result.values[i], other.values[i]);
  return result;
}

// --- one picture of the two, as far as it is looked at alone

struct Seen {
  std::array<Plane, 3> filtered;  // YCxCz
  Plane edges, points;
};

Seen see(const Image& image, const Rec709& rec709, const FlipParams& params) {
  std::array<Plane, 3> channels;
  channels.fill(Plane(image.width, image.height));
  parallel_for(static_cast<std::size_t>(image.height), params.threads, [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < image.width; ++x) {
      const auto p = image.pixel(x, y);
      const auto shown = [&](std::size_t c) { return std::clamp(double{p[c]}, 0.0, 1.0); };
      const Color c = ycxcz_from_xyz(multiply(rec709.to_xyz, {shown(0), shown(1), shown(2)}));
      for (std::size_t k = 0; k < 3; ++k) channels[k].at(x, y) = static_cast<float>(c[k]);
    }
  });

  Seen seen;
  seen.filtered = {filter_by_sensitivity(channels[0], kAchromatic, params),
                   filter_by_sensitivity(channels[1], kRedGreen, params),
                   filter_by_sensitivity(channels[2], kBlueYellow, params)};
  Plane brightness = channels[0];
  for (float& v : brightness.values) v = (v + 16) / 116;
  const FeatureKernels kernels = make_feature_kernels(params.pixels_per_degree);
  seen.edges = feature_strength(brightness, kernels.edge, kernels.across, params.threads);
  seen.points = feature_strength(brightness, kernels.point, kernels.across, params.threads);
  return seen;
}

// What the filters made of a pixel, back in the cube of colours that can be shown.
Color hunt_lab_of(const Seen& seen, std::size_t pixel, const Rec709& rec709) {
  Color rgb = multiply(rec709.from_xyz, xyz_from_ycxcz({seen.filtered[0].values[pixel], seen.filtered[1].values[pixel],
                                                        seen.filtered[2].values[pixel]}));
  for (double& v : rgb) v = std::clamp(v, 0.0, 1.0);
  return hunt_lab_from_xyz(multiply(rec709.to_xyz, rgb));
}

constexpr double kColorExponent = 0.7;    // q_c
constexpr double kFeatureExponent = 0.5;  // q_f
constexpr double kSmallShare = 0.4;       // p_c: differences below this share of the largest …
constexpr double kSmallTarget = 0.95;     // p_t: … take up this much of [0, 1]

// [1, eq. 8]
double redistribute(double difference, double largest) {
  const double knee = kSmallShare * largest;
  if (difference < knee) return kSmallTarget / knee * difference;
  return kSmallTarget + (difference - knee) / (largest - knee) * (1 - kSmallTarget);
}

// Narkowicz's approximation of the ACES curve, (k0 x² + k1 x) / (k3 x² + k4 x + k5), as [2] has it.
constexpr double kAces0 = 0.6 * 0.6 * 2.51, kAces1 = 0.6 * 0.03, kAces3 = 0.6 * 0.6 * 2.43, kAces4 = 0.6 * 0.59,
                 kAces5 = 0.14;

double eval_aces(double x) {
  // Rational in x: infinity over infinity far in the white.
  const double bounded = std::clamp(x, 0.0, 1e6);
  return std::min(1.0, bounded * (kAces0 * bounded + kAces1) / (bounded * (kAces3 * bounded + kAces4) + kAces5));
}

// The positive x at which the curve is t.
double invert_aces(double t) {
  const double a = kAces0 - t * kAces3, b = kAces1 - t * kAces4, c = -t * kAces5;
  return (-b + std::sqrt(b * b - 4 * a * c)) / (2 * a);
}

Image expose(const Image& radiance, double stops) {
  Image result = radiance;
  for (float& v : result.values) v = static_cast<float>(eval_aces(std::exp2(stops) * double{v}));
  return result;
}

}  // namespace

Plane flip_map(const Image& a, const Image& b, const FlipParams& params) {
  SHLIGHT_ASSERT_EQ(a.width, b.width);
  SHLIGHT_ASSERT_EQ(a.height, b.height);
  const Rec709 rec709 = make_rec709();
  const Seen seen_a = see(a, rec709, params), seen_b = see(b, rec709, params);
  // The largest difference that colours can have is that of green and blue.
  const auto lab = [&](Color rgb) { return hunt_lab_from_xyz(multiply(rec709.to_xyz, rgb)); };
  const double largest = std::pow(hyab(lab({0, 1, 0}), lab({0, 0, 1})), kColorExponent);

  Plane map(a.width, a.height);
  parallel_for(static_cast<std::size_t>(a.height), params.threads, [&](std::size_t y) {
    const std::size_t width = static_cast<std::size_t>(a.width);
    for (std::size_t i = y * width; i < (y + 1) * width; ++i) {
      const double difference = hyab(hunt_lab_of(seen_a, i, rec709), hunt_lab_of(seen_b, i, rec709));
      const double of_color = redistribute(std::pow(difference, kColorExponent), largest);
      const double feature = std::max(std::abs(seen_a.edges.values[i] - seen_b.edges.values[i]),
                                      std::abs(seen_a.points.values[i] - seen_b.points.values[i]));
      const double of_features = std::pow(feature / std::numbers::sqrt2, kFeatureExponent);
      map.values[i] = static_cast<float>(std::pow(of_color, 1 - of_features));
    }
  });
  return map;
}

FlipExposures flip_exposures(const Image& reference) {
  std::vector<double> bright;
  for (int y = 0; y < reference.height; ++y)
    for (int x = 0; x < reference.width; ++x)
      if (const double v = luminance(reference.rgb(x, y)); v > 0) bright.push_back(v);
  if (bright.empty()) return {};
  const double largest = *std::ranges::max_element(bright);
  FlipExposures exposures;
  const double shown = invert_aces(0.85);
  exposures.start = std::log2(shown / largest);
  exposures.stop = std::log2(shown / median(std::move(bright)));
  exposures.count = std::max(2, static_cast<int>(std::ceil(exposures.stop - exposures.start)));
  return exposures;
}

Plane hdr_flip_map(const Image& test, const Image& reference, const FlipParams& params) {
  const FlipExposures exposures = flip_exposures(reference);
  Plane map(reference.width, reference.height);
  for (int i = 0; i < exposures.count; ++i) {
    const double stops = exposures.at(i);
    const Plane at_exposure = flip_map(expose(test, stops), expose(reference, stops), params);
    std::ranges::transform(map.values, at_exposure.values, map.values.begin(),
                           [](float a, float b) { return std::max(a, b); });
  }
  return map;
}

}  // namespace shlight
