#include "shlight/brdf/cornell.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstring>
#include <numbers>
#include <string_view>
#include <utility>
#include <vector>

#include "shlight/brdf/measured_grid.h"
#include "shlight/core/error.h"
#include "shlight/core/file.h"
#include "shlight/core/parallel.h"

namespace shlight {
namespace {

using std::numbers::pi;

constexpr std::size_t kNumbers = 4 + kCornellWavelengths;
constexpr std::size_t kFewestSamples = 16, kNearest = 6;
constexpr std::uint64_t kMostBytes = 256u << 20;

// A lobe of [2] with another width on each side.
double lobe(double wavelength, double middle, double left, double right) {
  const double t = (wavelength - middle) / (wavelength < middle ? left : right);
  return std::exp(-0.5 * t * t);
}

// The three observers' responses, to Rec. 709.
Rgb response(double w) {
  const double x =
      1.056 * lobe(w, 599.8, 37.9, 31.0) + 0.362 * lobe(w, 442.0, 16.0, 26.7) - 0.065 * lobe(w, 501.1, 20.4, 26.2);
  const double y = 0.821 * lobe(w, 568.8, 46.9, 40.5) + 0.286 * lobe(w, 530.9, 16.3, 31.1);
  const double z = 1.217 * lobe(w, 437.0, 11.8, 36.0) + 0.681 * lobe(w, 459.0, 26.0, 13.8);
  return {3.2404542 * x - 1.5371385 * y - 0.4985314 * z, -0.9692660 * x + 1.8760108 * y + 0.0415560 * z,
          0.0556434 * x - 0.2040259 * y + 1.0572252 * z};
}

// A sample where distances are taken.
struct Sample {
  Vec3d place;
  Rgb value;
};

Vec3d place_of(const HalfDifference& a) {
  return {2 * std::sqrt(a.theta_h * 2 / pi), a.theta_d * 2 / pi,
          std::sin(a.theta_h) * std::sin(a.theta_d) * std::cos(2 * a.phi_d)};
}

Rgb interpolate(const std::vector<Sample>& samples, Vec3d place) {
  // The nearest few, nearest first.
  std::array<std::pair<double, std::size_t>, kNearest> nearest;
  nearest.fill({1e30, 0});
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Vec3d step = samples[i].place - place;
    const double distance2 = dot(step, step);
    if (distance2 >= nearest.back().first) continue;
    nearest.back() = {distance2, i};
    for (std::size_t k = kNearest - 1; k > 0 && nearest[k] < nearest[k - 1]; --k) std::swap(nearest[k], nearest[k - 1]);
  }
  Rgb sum;
  double weights = 0;
  for (const auto& [distance2, i] : nearest) {
    const double weight = 1 / (distance2 * distance2 + 1e-12);
    sum += weight * samples[i].value;
    weights += weight;
  }
  return 1 / weights * sum;
}

MeasuredGrid make_grid(const std::vector<Sample>& samples) {
  MeasuredGrid grid{45, 30, 36, {}};
  grid.values.resize(grid.size());
  parallel_for(grid.theta_h, 0, [&](std::size_t h) {
    for (std::size_t d = 0; d < grid.theta_d; ++d)
      for (std::size_t phi = 0; phi < grid.phi_d; ++phi) {
        const HalfDifference angles = grid.centre(h, d, phi);
        const DirectionPair pair = directions_of(angles);
        const bool seen = pair.s.z > 0 && pair.v.z > 0;
        grid.values[grid.index(h, d, phi)] = seen ? interpolate(samples, place_of(angles)) : Rgb{-1, -1, -1};
      }
  });
  return grid;
}

// The numbers of a line; false where it has another number of them, or something that is none.
bool parse_numbers(std::string_view line, std::array<double, kNumbers>& numbers) {
  std::size_t count = 0;
  const char *at = line.data(), *const end = at + line.size();
  while (true) {
    while (at != end && (std::isspace(static_cast<unsigned char>(*at)) || *at == ',')) ++at;
    if (at == end) return count == kNumbers;
    if (count == kNumbers) return false;
    const auto [next, error] = std::from_chars(at, end, numbers[count++]);
    if (error != std::errc()) return false;
    at = next;
  }
}

Vec3d direction_of(double theta, double phi) {
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

}  // namespace

Rgb rgb_of_spectrum(std::span<const double, kCornellWavelengths> reflectance) {
  Rgb sum, white;
  for (std::size_t i = 0; i < reflectance.size(); ++i) {
    const Rgb r = response(400 + 10 * static_cast<double>(i));
    sum += reflectance[i] * r;
    white += r;
  }
  return {sum.r / white.r, sum.g / white.g, sum.b / white.b};
}

CornellBrdf load_cornell(const std::filesystem::path& file) {
  const std::vector<std::byte> bytes = read_file(file, kMostBytes);
  std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  CornellBrdf result;
  std::vector<Sample> samples;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    while (!line.empty() && std::isspace(static_cast<unsigned char>(line.front()))) line.remove_prefix(1);
    if (line.empty() || line[0] == '#') continue;
    std::array<double, kNumbers> numbers{};
    const bool parsed = parse_numbers(line, numbers);
    // "nan" begins with a letter, too.
    if (!parsed && std::isalpha(static_cast<unsigned char>(line[0]))) continue;

    const auto fail = [&](const std::string& wrong) {
      throw Error(file.string(), fmt::format("line {} {}", number, wrong),
                  "theta_i phi_i theta_r phi_r in radians, below the horizon none, and 31 finite numbers");
    };
    if (!parsed) fail("has not 35 numbers");
    for (const double value : numbers)
      if (!std::isfinite(value)) fail("has a number that is not finite");
    // Radians of measurements are rounded; degrees are far beyond.
    constexpr double kHorizon = pi / 2 + 1e-3;
    if (std::abs(numbers[0]) > kHorizon || std::abs(numbers[2]) > kHorizon)
      fail(fmt::format("has polar angles of {} and {}", numbers[0], numbers[2]));

    for (std::size_t i = 4; i < kNumbers; ++i) {
      result.negative += numbers[i] < 0;
      numbers[i] = std::max(0.0, numbers[i]);
    }
    const Vec3d s = direction_of(numbers[0], numbers[1]), v = direction_of(numbers[2], numbers[3]);
    if (s.z <= 1e-6 || v.z <= 1e-6) continue;  // nothing is seen from the horizon
    const Rgb rgb = rgb_of_spectrum(std::span<const double, kCornellWavelengths>(numbers.data() + 4, 31));
    samples.push_back(
        {place_of(half_difference(s, v)), {std::max(0.0, rgb.r), std::max(0.0, rgb.g), std::max(0.0, rgb.b)}});
  }
  if (samples.size() < kFewestSamples)
    throw Error(file.string(), fmt::format("holds {} samples above the horizon", samples.size()),
                fmt::format("at least {} lines of theta_i phi_i theta_r phi_r and 31 numbers", kFewestSamples));
  result.samples = samples.size();
  result.brdf = make_measured_brdf(make_grid(samples));
  return result;
}

}  // namespace shlight
