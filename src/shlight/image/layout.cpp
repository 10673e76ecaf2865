#include "shlight/image/layout.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <vector>

#include "shlight/sh/project.h"

namespace shlight {
namespace {

using std::numbers::pi;

struct LayoutName {
  Layout layout;
  std::string_view name;
};
constexpr LayoutName kNames[] = {{Layout::kLatLong, "lat-long"}, {Layout::kAngularMap, "angular-map"}};
constexpr Layout kAll[] = {Layout::kLatLong, Layout::kAngularMap};

// With radius r in [0, 1] the angular map has dω = sin θ dθ dφ = π sin(πr)/r · dx dy for x, y in [−1, 1].
double angular_map_density(double x, double y) {
  const double r = std::hypot(x, y);
  if (r >= 1) return 0;
  return r < 1e-8 ? pi * pi : pi * std::sin(pi * r) / r;
}

// Nodes over [y0, y1] x [x0, x1] of the square [−1, 1]², cut off at the circle. Rows of Gauss nodes, each over the part
// of the row inside; a pixel that the circle enters or leaves through its top or bottom is cut there first, so that
// every piece is smooth up to the square root at the circle's own top and bottom, where the density is zero.
void angular_map_nodes(double x0, double x1, double y0, double y1, std::vector<WeightedDirection>& nodes) {
  const double near_x = x0 * x1 < 0 ? 0 : std::min(std::abs(x0), std::abs(x1));
  const double near_y = y0 * y1 < 0 ? 0 : std::min(std::abs(y0), std::abs(y1));
  if (std::hypot(near_x, near_y) >= 1) return;

  static const GaussLegendre kFine = make_gauss_legendre(6), kCoarse = make_gauss_legendre(3);
  const GaussLegendre& rule = x1 - x0 > 1.0 / 16 ? kFine : kCoarse;
  const auto add_rows = [&](double a, double b) {
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
      const double y = a + (b - a) * 0.5 * (1 + rule.nodes[i]);
      const double reach = std::sqrt(std::max(0.0, 1 - y * y));
      const double left = std::clamp(x0, -reach, reach), right = std::clamp(x1, -reach, reach);
      for (std::size_t j = 0; j < rule.nodes.size(); ++j) {
        const double x = left + (right - left) * 0.5 * (1 + rule.nodes[j]);
        const double weight = rule.weights[i] * rule.weights[j] * 0.25 * (b - a) * (right - left);
        if (const auto direction = direction_at(Layout::kAngularMap, {0.5 + 0.5 * x, 0.5 - 0.5 * y}))
          nodes.push_back({*direction, weight * angular_map_density(x, y)});
      }
    }
  };
  const double far = std::hypot(std::max(std::abs(x0), std::abs(x1)), std::max(std::abs(y0), std::abs(y1)));
  if (far <= 1) return add_rows(y0, y1);

  // Heights at which the circle crosses the pixel's left and right side, and where it ends.
  std::vector<double> cuts = {y0, y1};
  for (const double x : {x0, x1})
    if (std::abs(x) < 1)
      for (const double y : {-std::sqrt(1 - x * x), std::sqrt(1 - x * x)})
        if (y > y0 && y < y1) cuts.push_back(y);
  for (const double y : {-1.0, 1.0})
    if (y > y0 && y < y1) cuts.push_back(y);
  std::sort(cuts.begin(), cuts.end());
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) add_rows(cuts[i], cuts[i + 1]);
}

// Gauss nodes in both angles, over which a lat-long pixel is a rectangle with the density sin θ.
void lat_long_nodes(int width, int height, int x, int y, std::vector<WeightedDirection>& nodes) {
  static const GaussLegendre kFine = make_gauss_legendre(6), kCoarse = make_gauss_legendre(3);
  const GaussLegendre& rule = height < 64 ? kFine : kCoarse;
  for (std::size_t i = 0; i < rule.nodes.size(); ++i)
    for (std::size_t j = 0; j < rule.nodes.size(); ++j) {
      const double v = (y + 0.5 * (1 + rule.nodes[i])) / height, u = (x + 0.5 * (1 + rule.nodes[j])) / width;
      const double area = 2 * pi / width * pi / height;
      nodes.push_back({*direction_at(Layout::kLatLong, {u, v}),
                       0.25 * rule.weights[i] * rule.weights[j] * area * std::sin(pi * v)});
    }
}

// The pixel index of a coordinate in [0, 1]; 1 itself belongs to the last pixel.
int pixel_index(double coordinate, int size) {
  return std::clamp(static_cast<int>(coordinate * size), 0, size - 1);
}

// The pixel (x, y) of a lat-long map continued over its borders: round about, and over a pole to the other side.
Rgb wrapped_lat_long(const Image& image, int x, int y) {
  if (y < 0 || y >= image.height) {
    y = y < 0 ? -1 - y : 2 * image.height - 1 - y;
    x += image.width / 2;
  }
  return image.rgb((x % image.width + image.width) % image.width, std::clamp(y, 0, image.height - 1));
}

}  // namespace

std::string_view layout_name(Layout layout) {
  for (const LayoutName& entry : kNames)
    if (entry.layout == layout) return entry.name;
  return "";
}

std::optional<Layout> layout_from_name(std::string_view name) {
  for (const LayoutName& entry : kNames)
    if (entry.name == name) return entry.layout;
  return std::nullopt;
}

std::span<const Layout> all_layouts() {
  return kAll;
}

std::optional<Layout> layout_from_shape(int width, int height) {
  if (width == 2 * height) return Layout::kLatLong;
  if (width == height) return Layout::kAngularMap;
  return std::nullopt;
}

std::optional<Vec3d> direction_at(Layout layout, ImagePoint point) {
  if (layout == Layout::kLatLong) {
    const double phi = 2 * pi * (point.u - 0.5), theta = pi * point.v;
    return Vec3d{std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi)};
  }
  const double x = 2 * point.u - 1, y = 1 - 2 * point.v, r = std::hypot(x, y);
  if (r > 1) return std::nullopt;
  const double scale = r < 1e-12 ? pi : std::sin(pi * r) / r;
  return Vec3d{scale * x, scale * y, -std::cos(pi * r)};
}

ImagePoint point_of(Layout layout, Vec3d d) {
  if (layout == Layout::kLatLong) {
    // atan2 twice: acos loses half of its digits toward the poles.
    return {0.5 + std::atan2(d.x, -d.z) / (2 * pi), std::atan2(std::hypot(d.x, d.z), d.y) / pi};
  }
  const double s = std::hypot(d.x, d.y);
  const double r = std::atan2(s, -d.z) / pi;
  if (s == 0) return {0.5 + 0.5 * r, 0.5};
  return {0.5 + 0.5 * r * d.x / s, 0.5 - 0.5 * r * d.y / s};
}

void pixel_nodes(Layout layout, int width, int height, int x, int y, std::vector<WeightedDirection>& nodes) {
  assert(x >= 0 && x < width && y >= 0 && y < height);
  nodes.clear();
  if (layout == Layout::kLatLong) return lat_long_nodes(width, height, x, y, nodes);
  angular_map_nodes(2.0 * x / width - 1, 2.0 * (x + 1) / width - 1, 1 - 2.0 * (y + 1) / height, 1 - 2.0 * y / height,
                    nodes);
}

double pixel_solid_angle(Layout layout, int width, int height, int x, int y) {
  assert(x >= 0 && x < width && y >= 0 && y < height);
  if (layout == Layout::kLatLong) {
    // cos θ0 − cos θ1 as a product, which keeps its digits at the poles.
    const double middle = pi * (y + 0.5) / height, half = pi / (2.0 * height);
    return 2 * pi / width * 2 * std::sin(middle) * std::sin(half);
  }
  std::vector<WeightedDirection> nodes;
  pixel_nodes(layout, width, height, x, y, nodes);
  double sum = 0;
  for (const WeightedDirection& node : nodes) sum += node.solid_angle;
  return sum;
}

Rgb eval_nearest(const Environment& environment, Vec3d direction) {
  const Image& image = environment.image;
  const ImagePoint point = point_of(environment.layout, direction);
  return image.rgb(pixel_index(point.u, image.width), pixel_index(point.v, image.height));
}

Rgb eval_bilinear(const Environment& environment, Vec3d direction) {
  const Image& image = environment.image;
  const ImagePoint point = point_of(environment.layout, direction);
  const double x = point.u * image.width - 0.5, y = point.v * image.height - 0.5;
  const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
  Rgb sum;
  double weights = 0;
  for (const int dy : {0, 1})
    for (const int dx : {0, 1}) {
      const double weight = std::abs(1 - dx - (x - x0)) * std::abs(1 - dy - (y - y0));
      if (environment.layout == Layout::kLatLong) {
        sum += weight * wrapped_lat_long(image, x0 + dx, y0 + dy);
        weights += weight;
        continue;
      }
      // Pixels of the angular map whose centre lies outside of the circle hold nothing.
      const int px = std::clamp(x0 + dx, 0, image.width - 1), py = std::clamp(y0 + dy, 0, image.height - 1);
      if (!direction_at(Layout::kAngularMap, {(px + 0.5) / image.width, (py + 0.5) / image.height})) continue;
      sum += weight * image.rgb(px, py);
      weights += weight;
    }
  return weights > 0 ? 1 / weights * sum : eval_nearest(environment, direction);
}

}  // namespace shlight
