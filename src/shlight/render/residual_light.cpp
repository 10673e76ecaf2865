#include "shlight/render/residual_light.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
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

ResidualLight::ResidualLight(const Image& picture, const RgbCoefficients& coefficients) {
  MakePictureParams params;
  params.layout = Layout::kVerticalStrip;
  params.size = kFinestSize;
  Environment finest = {resample({picture, Layout::kLatLong}, params), params.layout};
  Image& image = finest.image;
  parallel_for(static_cast<std::size_t>(image.height), 0, [&](std::size_t row) {
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

double ResidualLight::pixel_solid_angle() const {
  const Image& finest = levels_.front().image;
  return 4 * std::numbers::pi / (static_cast<double>(finest.width) * finest.height);
}

CubeFaces prefilter_cube(const ResidualLight& light, std::span<const LobeSample> lobe, int size) {
  // What a sample stands for is taken from the level whose pixels are four times as large, so that what small lamps
  // give to neighbouring samples overlaps; nothing is blurred where samples are closer than pixels.
  std::vector<double> levels;
  for (const LobeSample& sample : lobe)
    levels.push_back(0.5 * std::log2(std::max(4 * sample.solid_angle / light.pixel_solid_angle(), 1.0)));

  CubeFaces faces;
  for (Image& face : faces) face = Image(size, size);
  parallel_for(static_cast<std::size_t>(6 * size), 0, [&](std::size_t task) {
    const int face = static_cast<int>(task) / size, y = static_cast<int>(task) % size;
    for (int x = 0; x < size; ++x) {
      const Vec3d d = cube_direction(face, (2 * x + 1.0) / size - 1, (2 * y + 1.0) / size - 1);
      const Vec3d n = (1 / std::sqrt(dot(d, d))) * d;
      const Vec3d aside = std::abs(n.y) < 0.9 ? Vec3d{n.z, 0, -n.x} : Vec3d{0, -n.z, n.y};
      const Vec3d t = (1 / std::sqrt(dot(aside, aside))) * aside, b = cross(n, t);
      Rgb sum;
      for (std::size_t i = 0; i < lobe.size(); ++i) {
        const Vec3d s = lobe[i].direction;
        sum += lobe[i].weight * light.eval(s.x * t + s.y * b + s.z * n, levels[i]);
      }
      faces[static_cast<std::size_t>(face)].set_rgb(x, y, sum);
    }
  });
  return faces;
}

int prefiltered_size(double width) {
  int size = 8;
  // A lobe of half vectors is twice as wide in mirrored directions; a pixel is (π/2)/size.
  while (size < kFinestSize && std::numbers::pi / 2 / size > 0.5 * width) size *= 2;
  return size;
}

int num_prefilter_samples(double width) {
  constexpr int kLookups = 6'000'000;  // about half a second on two cores, but of near mirrors four times that
  const int size = prefiltered_size(width);
  return std::clamp(kLookups / (6 * size * size), 64, 2048);
}

}  // namespace shlight
