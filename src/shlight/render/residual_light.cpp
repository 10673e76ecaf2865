#include "shlight/render/residual_light.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>

#include "shlight/core/parallel.h"
#include "shlight/image/pixels.h"
#include "shlight/image/resample.h"
#include "shlight/sh/basis.h"

namespace shlight {
namespace {

constexpr int kFinestSize = 256;  // pixels of 0.35°
constexpr int kCoarsestSize = 4;

// Faces of a strip of faces below each other, each halved: 2 x 2 pixels of a face become one.
Environment halved(const Environment& fine) {
  Environment coarse = {Image(fine.image.width / 2, fine.image.height / 2), fine.layout};
  for (int y = 0; y < coarse.image.height; ++y)
    for (int x = 0; x < coarse.image.width; ++x) {
      Rgb sum;
      for (const int dy : {0, 1})
        for (const int dx : {0, 1}) sum += fine.image.rgb(2 * x + dx, 2 * y + dy);
      coarse.image.set_rgb(x, y, 0.25 * sum);
    }
  return coarse;
}

// The direction of a point of a face, a and b in [-1, 1] along its rows and columns (OpenGL ES 3.0, table 3.21).
Vec3d cube_direction(int face, double a, double b) {
  switch (face) {
    case 0:
      return {1, -b, -a};
    case 1:
      return {-1, -b, a};
    case 2:
      return {a, 1, b};
    case 3:
      return {a, -1, -b};
    case 4:
      return {a, -b, 1};
    default:
      return {-a, -b, -1};
  }
}

}  // namespace

ResidualLight::ResidualLight(const Image& picture, const RgbCoefficients& coefficients, int threads) {
  MakePictureParams params;
  params.layout = Layout::kVerticalStrip;
  params.size = kFinestSize;
  params.threads = threads;
  Environment finest = {resample({picture, Layout::kLatLong}, params), params.layout};
  Image& image = finest.image;
  parallel_for(static_cast<std::size_t>(image.height), threads, [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < image.width; ++x) {
      const Vec3d d = *direction_at(finest.layout, pixel_centre(finest.layout, finest.size(), {x, y}));
      image.set_rgb(x, y, image.rgb(x, y) - reconstruct(coefficients, d));
    }
  });
  levels_.push_back(std::move(finest));
  while (levels_.back().image.width > kCoarsestSize) levels_.push_back(halved(levels_.back()));
}

Rgb ResidualLight::eval(Vec3d direction, double level) const {
  level = std::clamp(level, 0.0, static_cast<double>(levels_.size() - 1));
  const auto low = static_cast<std::size_t>(level);
  const double share = level - static_cast<double>(low);
  const Rgb fine = eval_bilinear(levels_[low], direction);
  return share > 0 ? (1 - share) * fine + share * eval_bilinear(levels_[low + 1], direction) : fine;
}

const Environment& ResidualLight::level_of_size(int size) const {
  std::size_t level = 0;
  while (level + 1 < levels_.size() && levels_[level].image.width > size) ++level;
  return levels_[level];
}

double ResidualLight::pixel_solid_angle() const {
  const Image& finest = levels_.front().image;
  return 4 * std::numbers::pi / (static_cast<double>(finest.width) * finest.height);
}

namespace {

using PixelOf = std::function<Rgb(Vec3d direction)>;

CubeFaces make_cube(int size, int threads, const PixelOf& pixel_of) {
  CubeFaces faces;
  for (Image& face : faces) face = Image(size, size);
  parallel_for(static_cast<std::size_t>(6 * size), threads, [&](std::size_t task) {
    const int face = static_cast<int>(task) / size, y = static_cast<int>(task) % size;
    for (int x = 0; x < size; ++x) {
      const Vec3d d = cube_direction(face, (2 * x + 1.0) / size - 1, (2 * y + 1.0) / size - 1);
      faces[static_cast<std::size_t>(face)].set_rgb(x, y, pixel_of((1 / std::sqrt(dot(d, d))) * d));
    }
  });
  return faces;
}

// Pixels of a cube map, each with its solid angle multiplied in.
struct Pixels {
  std::vector<float> x, y, z, r, g, b, solid_angle;
};

Pixels pixels_of(const Environment& map) {
  Pixels pixels;
  const PixelQuadrature quadrature(map.layout, map.size(), 1);
  for (int y = 0; y < map.image.height; ++y)
    for (int x = 0; x < map.image.width; ++x) {
      const Vec3d d = *direction_at(map.layout, pixel_centre(map.layout, map.size(), {x, y}));
      const double solid_angle = quadrature.solid_angle({x, y});
      const Rgb c = solid_angle * map.image.rgb(x, y);
      const double values[] = {d.x, d.y, d.z, c.r, c.g, c.b, solid_angle};
      std::vector<float>* const lists[] = {&pixels.x, &pixels.y, &pixels.z,          &pixels.r,
                                           &pixels.g, &pixels.b, &pixels.solid_angle};
      for (std::size_t i = 0; i < std::size(values); ++i) lists[i]->push_back(static_cast<float>(values[i]));
    }
  return pixels;
}

// The mean over the lobe's profile around n.
Rgb mean_over_profile(const Pixels& pixels, std::span<const float> profile, Vec3d n) {
  const Vec3f axis = vec_cast<float>(n);
  const auto last = static_cast<float>(profile.size() - 1);
  double r = 0, g = 0, b = 0, sum = 0;
  for (std::size_t i = 0; i < pixels.x.size(); ++i) {
    const float cosine = axis.x * pixels.x[i] + axis.y * pixels.y[i] + axis.z * pixels.z[i];
    if (cosine <= 0) continue;
    // sin(θ/2) is √((1 − cos θ)/2), and 90° its √½.
    const float place = last * std::sqrt(std::max(1 - cosine, 0.0f));
    const auto low = std::min(static_cast<std::size_t>(place), profile.size() - 2);
    const float share = place - static_cast<float>(low);
    const float weight = profile[low] + share * (profile[low + 1] - profile[low]);
    r += weight * pixels.r[i], g += weight * pixels.g[i], b += weight * pixels.b[i];
    sum += weight * pixels.solid_angle[i];
  }
  return sum > 0 ? 1 / sum * Rgb{r, g, b} : Rgb{};
}

constexpr int kLargestSummedSize = 64;

}  // namespace

CubeFaces prefilter_cube(const ResidualLight& light, const LobeFromAbove& lobe, int size, int threads) {
  if (size <= kLargestSummedSize) {
    const Pixels pixels = pixels_of(light.level_of_size(std::min(2 * size, kLargestSummedSize)));
    return make_cube(size, threads, [&](Vec3d n) { return mean_over_profile(pixels, lobe.profile, n); });
  }

  // What a sample stands for is taken from the level whose pixels are four times as large, so that what small lamps
  // give to neighbouring samples overlaps; nothing is blurred where samples are closer than pixels.
  std::vector<double> levels;
  for (const LobeSample& sample : lobe.samples)
    levels.push_back(0.5 * std::log2(std::max(4 * sample.solid_angle / light.pixel_solid_angle(), 1.0)));

  return make_cube(size, threads, [&](Vec3d n) {
    const Vec3d aside = std::abs(n.y) < 0.9 ? Vec3d{n.z, 0, -n.x} : Vec3d{0, -n.z, n.y};
    const Vec3d t = (1 / std::sqrt(dot(aside, aside))) * aside, b = cross(n, t);
    Rgb sum;
    for (std::size_t i = 0; i < lobe.samples.size(); ++i) {
      const Vec3d s = lobe.samples[i].direction;
      sum += lobe.samples[i].weight * light.eval(s.x * t + s.y * b + s.z * n, levels[i]);
    }
    return sum;
  });
}

int prefiltered_size(double width) {
  int size = 8;
  // A lobe of half vectors is twice as wide in mirrored directions; a pixel is (π/2)/size.
  while (size < kFinestSize && std::numbers::pi / 2 / size > 0.5 * width) size *= 2;
  return size;
}

}  // namespace shlight
