#include "shlight/truth/brute_force.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "shlight/core/parallel.h"
#include "shlight/image/pixels.h"

namespace shlight {
namespace {

constexpr int kGridWidth = 1024;
constexpr std::array<int, 7> kNodesASide = {1, 2, 4, 8, 16, 32, 64};

double largest(Rgb c) {
  return std::max({std::abs(c.r), std::abs(c.g), std::abs(c.b)});
}

// The light and the cells in which it is integrated.
class Cells {
 public:
  Cells(const Light& light, const std::function<Rgb(Vec3d)>& weight)
      : light_(light), image_(dynamic_cast<const ImageLight*>(&light)), weight_(weight) {
    layout_ = image_ ? image_->environment().layout : Layout::kLatLong;
    size_ = image_ ? image_->environment().size() : picture_size(layout_, kGridWidth);
    for (const int nodes : kNodesASide) rules_.emplace_back(layout_, size_, nodes);
  }
  PictureSize size() const { return size_; }
  bool covers(Pixel cell) const { return rules_[0].covers(cell); }
  double solid_angle(Pixel cell) const { return rules_[0].solid_angle(cell); }

  // The integral over a cell by one of the rules, `nodes` being memory to use again.
  Rgb integrate(Pixel cell, std::size_t rule, std::vector<WeightedDirection>& nodes) const {
    const Rgb constant = image_ ? image_->environment().image.rgb(cell.x, cell.y) : Rgb{};
    Rgb sum;
    if (image_ && constant == Rgb{}) return sum;
    rules_[rule].nodes(cell, nodes);
    for (const WeightedDirection& node : nodes) {
      const Rgb radiance = image_ ? constant : light_.radiance(node.direction);
      const Rgb w = weight_(node.direction);
      sum += node.solid_angle * Rgb{radiance.r * w.r, radiance.g * w.g, radiance.b * w.b};
    }
    return sum;
  }

 private:
  const Light& light_;
  const ImageLight* image_;
  const std::function<Rgb(Vec3d)>& weight_;
  Layout layout_;
  PictureSize size_;
  std::vector<PixelQuadrature> rules_;
};

// A cell's integral by the finest rule so far, and how far it is from the rule before.
struct Estimate {
  Rgb value;
  double change = 0;
};

}  // namespace

BruteForceResult integrate_light(const Light& light, const std::function<Rgb(Vec3d)>& weight,
                                 const BruteForceParams& params) {
  const Cells cells(light, weight);
  const int width = cells.size().width, height = cells.size().height;
  const auto index = [width](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  };
  // Calls f(cell, nodes) for each cell that covers anything, rows in parallel.
  const auto for_cells = [&](const auto& f) {
    parallel_for(static_cast<std::size_t>(height), params.threads, [&](std::size_t row) {
      std::vector<WeightedDirection> nodes;
      for (int x = 0; x < width; ++x)
        if (const Pixel cell = {x, static_cast<int>(row)}; cells.covers(cell)) f(cell, nodes);
    });
  };

  std::vector<Estimate> estimates(index(0, height));
  std::vector<double> magnitudes(static_cast<std::size_t>(height));
  for_cells([&](Pixel cell, std::vector<WeightedDirection>& nodes) {
    const Rgb coarse = cells.integrate(cell, 0, nodes), fine = cells.integrate(cell, 1, nodes);
    estimates[index(cell.x, cell.y)] = {fine, largest(fine - coarse)};
    magnitudes[static_cast<std::size_t>(cell.y)] += largest(fine);
  });
  double magnitude = 0;
  for (const double of_row : magnitudes) magnitude += of_row;

  // Each cell may be wrong in proportion to its solid angle. An edge that cuts off less of a cell than there is between
  // its nodes shows in the cell beside: the neighbours of those that are wrong are refined, too.
  const double allowed = params.tolerance * magnitude / (4 * std::numbers::pi);
  std::vector<char> is_wrong(estimates.size());
  for_cells([&](Pixel cell, auto&) {
    const std::size_t i = index(cell.x, cell.y);
    is_wrong[i] = estimates[i].change > allowed * cells.solid_angle(cell);
  });
  const auto is_near_wrong = [&](Pixel cell) {
    for (int y = std::max(cell.y - 1, 0); y <= std::min(cell.y + 1, height - 1); ++y)
      for (int x = cell.x - 1; x <= cell.x + 1; ++x)
        if (is_wrong[index((x + width) % width, y)]) return true;
    return false;
  };
  for_cells([&](Pixel cell, std::vector<WeightedDirection>& nodes) {
    if (!is_near_wrong(cell)) return;
    Estimate& estimate = estimates[index(cell.x, cell.y)];
    for (std::size_t rule = 2; rule < kNodesASide.size(); ++rule) {
      const Rgb finer = cells.integrate(cell, rule, nodes);
      estimate = {finer, largest(finer - estimate.value)};
      constexpr std::size_t kLeastRule = 3;  // 8 nodes a side
      if (rule >= kLeastRule && estimate.change <= allowed * cells.solid_angle(cell)) break;
    }
  });

  BruteForceResult result;
  for (int y = 0; y < height; ++y) {
    Estimate row;
    for (int x = 0; x < width; ++x) {
      row.value += estimates[index(x, y)].value;
      row.change += estimates[index(x, y)].change;
    }
    result.value += row.value;
    result.error += row.change;
  }
  return result;
}

BruteForceResult reference_irradiance(const Light& light, Vec3d normal, const BruteForceParams& params) {
  return integrate_light(
      light,
      [normal](Vec3d s) {
        const double cosine = std::max(0.0, dot(normal, s));
        return Rgb{cosine, cosine, cosine};
      },
      params);
}

BruteForceResult reference_radiance(const Light& light, const Brdf& brdf, const Rotation& to_local, Vec3d view,
                                    const BruteForceParams& params) {
  const Vec3d v = to_local(view);
  return integrate_light(
      light,
      [&](Vec3d direction) {
        const Vec3d s = to_local(direction);
        return std::max(0.0, s.z) * brdf.eval(s, v);
      },
      params);
}

}  // namespace shlight
