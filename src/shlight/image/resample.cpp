#include "shlight/image/resample.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "shlight/core/parallel.h"

namespace shlight {
namespace {

double solid_angle_of(std::span<const WeightedDirection> nodes) {
  double sum = 0;
  for (const WeightedDirection& node : nodes) sum += node.solid_angle;
  return sum;
}

}  // namespace

Image make_picture(const std::function<Rgb(Vec3d)>& radiance, const SamplesASide& samples,
                   const MakePictureParams& params, const Progress& progress) {
  const PictureSize size = picture_size(params.layout, params.size);
  // For 2, 4, 8, … samples a side.
  std::vector<PixelQuadrature> quadratures;
  for (int side = 2; side <= kMostSamplesASide; side *= 2)
    quadratures.emplace_back(params.layout, size, side, PixelQuadrature::Nodes::kEvenly);

  Image image(size.width, size.height);
  const auto draw_row = [&](int y) {
    std::vector<WeightedDirection> nodes;
    for (int x = 0; x < size.width; ++x) {
      quadratures.front().nodes({x, y}, nodes);
      if (nodes.empty()) continue;
      const int wanted = samples(nodes);
      std::size_t level = 0;
      while (level + 1 < quadratures.size() && (2 << level) < wanted) ++level;
      if (level > 0) quadratures[level].nodes({x, y}, nodes);
      Rgb sum;
      for (const WeightedDirection& node : nodes) sum += node.solid_angle * radiance(node.direction);
      image.set_rgb(x, y, 1 / solid_angle_of(nodes) * sum);
    }
  };
  constexpr int kRowsAReport = 16;
  for (int begin = 0; begin < size.height; begin += kRowsAReport) {
    report_progress(progress, static_cast<double>(begin) / size.height);
    const int rows = std::min(kRowsAReport, size.height - begin);
    parallel_for(static_cast<std::size_t>(rows), params.threads,
                 [&](std::size_t row) { draw_row(begin + static_cast<int>(row)); });
  }
  report_progress(progress, 1);
  return image;
}

Image resample(const Environment& environment, const MakePictureParams& params, const Progress& progress) {
  const PictureSize size = environment.size();
  const PixelQuadrature pixels(environment.layout, size, 2);
  // Two samples a side for each pixel's width of the source: fewer would see some of its pixels more often than others.
  const auto samples = [&](std::span<const WeightedDirection> nodes) {
    const Pixel seen = pixel_at(environment.layout, size, point_of(environment.layout, nodes[0].direction));
    const double covered = pixels.solid_angle(seen);
    if (covered <= 0) return kMostSamplesASide;
    const double ratio = 2 * std::sqrt(solid_angle_of(nodes) / covered);
    return static_cast<int>(std::ceil(std::min<double>(kMostSamplesASide, ratio)));
  };
  return make_picture([&](Vec3d d) { return eval_bilinear(environment, d); }, samples, params, progress);
}

}  // namespace shlight
