#include "shlight/image/pixels.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <span>

namespace shlight {
namespace {

using std::numbers::pi;

// --- along one side of the picture: a row of faces, or one, of equally many pixels each

class Side {
 public:
  Side(int length, int faces, bool on_border) : faces_(faces), pixels_(length / faces), on_border_(on_border) {}

  PixelSide pixel(int index) const {
    const int face = index / pixels_, i = index % pixels_;
    if (!on_border_ || pixels_ == 1) return {2.0 * i / pixels_ - 1, 2.0 * (i + 1) / pixels_ - 1, face};
    const double last = pixels_ - 1;
    return {std::max(-1.0, (2 * i - 1) / last - 1), std::min(1.0, (2 * i + 1) / last - 1), face};
  }
  // In [0, 1] over the picture, as is the coordinate below.
  double centre(int pixel) const {
    const int face = pixel / pixels_, i = pixel % pixels_;
    if (!on_border_ || pixels_ == 1) return (face + (i + 0.5) / pixels_) / faces_;
    // Just inside: the border itself is the next face's in the picture.
    return (face + std::min(i / (pixels_ - 1.0), faces_ == 1 ? 1 : 1 - 1e-12)) / faces_;
  }
  int index(double coordinate) const {
    const int face = std::clamp(static_cast<int>(coordinate * faces_), 0, faces_ - 1);
    const double t = coordinate * faces_ - face;
    const double i = on_border_ ? t * (pixels_ - 1) + 0.5 : t * pixels_;
    return face * pixels_ + std::clamp(static_cast<int>(i), 0, pixels_ - 1);
  }

 private:
  int faces_, pixels_;
  bool on_border_;
};

Side horizontal(Layout layout, PictureSize size) {
  return {size.width, face_grid(layout).columns, centres_on_border(layout)};
}
Side vertical(Layout layout, PictureSize size) {
  return {size.height, face_grid(layout).rows, centres_on_border(layout)};
}

struct Interval {
  double from = 0, to = 0;
  double length() const { return to - from; }
  double at(double node) const { return from + length() * 0.5 * (1 + node); }
};
Interval across(const PixelSide& column) {
  return {column.from, column.to};
}
Interval upward(const PixelSide& row) {
  return {-row.to, -row.from};
}

// Calls f(x, y, weight) at the nodes of the product rule.
template <class F>
void over_rectangle(const GaussLegendre& rule, Interval x, Interval y, F&& f) {
  const double area = 0.25 * x.length() * y.length();
  for (std::size_t i = 0; i < rule.nodes.size(); ++i)
    for (std::size_t j = 0; j < rule.nodes.size(); ++j)
      f(x.at(rule.nodes[j]), y.at(rule.nodes[i]), area * rule.weights[i] * rule.weights[j]);
}

using Nodes = std::vector<WeightedDirection>;

// --- lat-long: a rectangle in both angles, of density sin θ = cos(latitude); half the picture is π wide, π/2 high

void lat_long_nodes(const GaussLegendre& rule, Interval x, Interval y, Nodes& nodes) {
  const double area = 0.25 * pi * x.length() * (pi / 2) * y.length();
  for (std::size_t j = 0; j < rule.nodes.size(); ++j) {
    const double azimuth = pi * x.at(rule.nodes[j]);
    const double right = std::sin(azimuth), back = -std::cos(azimuth);
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
      const double latitude = pi / 2 * y.at(rule.nodes[i]), c = std::cos(latitude);
      nodes.push_back({{c * right, std::sin(latitude), c * back}, area * rule.weights[i] * rule.weights[j] * c});
    }
  }
}

double lat_long_solid_angle(Interval x, Interval y) {
  // The difference of two sines as a product, which keeps its digits at the poles.
  return pi * x.length() * 2 * std::cos(pi / 4 * (y.from + y.to)) * std::sin(pi / 4 * y.length());
}

// --- cubes: (x, y) in [−1, 1]² on a face at distance 1 has dω = dx dy / (1+x²+y²)^(3/2)

void face_nodes(const GaussLegendre& rule, const CubeFace& face, Interval x, Interval y, Nodes& nodes) {
  over_rectangle(rule, x, y, [&](double right, double up, double weight) {
    const double scale = 1 / std::sqrt(1 + right * right + up * up);
    nodes.push_back({scale * (face.forward + right * face.right - up * face.down), weight * scale * scale * scale});
  });
}

double face_solid_angle(Interval x, Interval y) {
  // Of the rectangle from (0, 0) to (right, up).
  const auto corner = [](double right, double up) {
    return std::atan2(right * up, std::sqrt(1 + right * right + up * up));
  };
  return corner(x.to, y.to) - corner(x.from, y.to) - corner(x.to, y.from) + corner(x.from, y.from);
}

// --- discs: x right, y up, in the circle of radius 1

// dω = π sin(πr)/r dx dy in the angular map, 4 dx dy in the mirror ball.
void add_disc_node(Layout layout, double x, double y, double weight, Nodes& nodes) {
  const double r2 = x * x + y * y;
  if (layout == Layout::kMirrorBall) {
    const double scale = 2 * std::sqrt(std::max(0.0, 1 - r2));
    nodes.push_back({{scale * x, scale * y, 2 * r2 - 1}, 4 * weight});
    return;
  }
  const double r = std::sqrt(r2), scale = r < 1e-8 ? pi : std::sin(pi * r) / r;
  nodes.push_back({{scale * x, scale * y, -std::cos(pi * r)}, weight * pi * scale});
}

// The part of a rectangle inside of the circle. In y = sin ψ, x = cos ψ sin φ the circle is φ = ±π/2, and what goes
// like √(1−r²) there, as everything on a mirror ball does, is the smooth cos ψ cos φ. The heights at which the circle
// crosses the rectangle's left and right side are cut apart, so that every piece is smooth.
void disc_edge_nodes(Layout layout, const GaussLegendre& rule, Interval x, Interval y, Nodes& nodes) {
  std::vector<double> cuts = {std::clamp(y.from, -1.0, 1.0), std::clamp(y.to, -1.0, 1.0)};
  for (const double side : {x.from, x.to})
    if (std::abs(side) < 1)
      for (const double height : {-std::sqrt(1 - side * side), std::sqrt(1 - side * side)})
        if (height > cuts[0] && height < cuts[1]) cuts.push_back(height);
  std::sort(cuts.begin(), cuts.end());

  for (std::size_t piece = 0; piece + 1 < cuts.size(); ++piece) {
    const Interval psi = {std::asin(cuts[piece]), std::asin(cuts[piece + 1])};
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
      const double p = psi.at(rule.nodes[i]), reach = std::cos(p);
      const Interval phi = {std::asin(std::clamp(x.from / reach, -1.0, 1.0)),
                            std::asin(std::clamp(x.to / reach, -1.0, 1.0))};
      for (std::size_t j = 0; j < rule.nodes.size(); ++j) {
        const double q = phi.at(rule.nodes[j]);
        const double weight = 0.25 * rule.weights[i] * rule.weights[j] * psi.length() * phi.length();
        if (weight > 0)
          add_disc_node(layout, reach * std::sin(q), std::sin(p), weight * reach * reach * std::cos(q), nodes);
      }
    }
  }
}

// How far from the centre a rectangle begins and ends.
double nearest(Interval x, Interval y) {
  const auto near = [](Interval i) { return i.from * i.to < 0 ? 0 : std::min(std::abs(i.from), std::abs(i.to)); };
  return std::hypot(near(x), near(y));
}
double farthest(Interval x, Interval y) {
  return std::hypot(std::max(std::abs(x.from), std::abs(x.to)), std::max(std::abs(y.from), std::abs(y.to)));
}

// Where the edge of a disc begins that a plain rule does not do: for the mirror ball, whose square root at the circle
// bends a plain rule nearby too, eight pixels within.
double disc_edge(Layout layout, PictureSize size) {
  return layout == Layout::kMirrorBall ? std::max(0.5, 1 - 16.0 / size.width) : 1;
}

// --- octahedral: x right, y up. A face of the octahedron is flat, so that dω = dx dy / |p|³ for its point p.

struct PlanePoint {
  double x = 0, y = 0;
};
using Polygon = std::vector<PlanePoint>;

void add_octahedron_node(double x, double y, double weight, Nodes& nodes) {
  const Vec3d direction = *direction_at(Layout::kOctahedral, {0.5 + 0.5 * x, 0.5 - 0.5 * y});
  // |p| = 1 / (|dx| + |dy| + |dz|), because p lies on |x| + |y| + |z| = 1.
  const double inverse = std::abs(direction.x) + std::abs(direction.y) + std::abs(direction.z);
  nodes.push_back({direction, weight * inverse * inverse * inverse});
}

// The part of a convex polygon where a x + b y >= c.
Polygon clip(const Polygon& polygon, double a, double b, double c) {
  Polygon result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const PlanePoint p = polygon[i], q = polygon[(i + 1) % polygon.size()];
    const double dp = a * p.x + b * p.y - c, dq = a * q.x + b * q.y - c;
    if (dp >= 0) result.push_back(p);
    if ((dp > 0 && dq < 0) || (dp < 0 && dq > 0)) {
      const double t = dp / (dp - dq);
      result.push_back({p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)});
    }
  }
  return result;
}

// A triangle is a square with one side drawn together into its first corner.
void triangle_nodes(const GaussLegendre& rule, PlanePoint a, PlanePoint b, PlanePoint c, Nodes& nodes) {
  const double area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
  if (std::abs(area) < 1e-18) return;
  over_rectangle(rule, {0, 1}, {0, 1}, [&](double s, double t, double weight) {
    const PlanePoint far = {b.x + t * (c.x - b.x), b.y + t * (c.y - b.y)};
    add_octahedron_node(a.x + s * (far.x - a.x), a.y + s * (far.y - a.y), weight * s * std::abs(area), nodes);
  });
}

void octahedral_nodes(const GaussLegendre& rule, Interval x, Interval y, Nodes& nodes) {
  // The creases: both axes and the diamond's four sides, a x + b y = c.
  constexpr double kCreases[6][3] = {{1, 0, 0}, {0, 1, 0}, {1, 1, 1}, {1, 1, -1}, {1, -1, 1}, {1, -1, -1}};
  std::vector<Polygon> pieces = {{{x.from, y.from}, {x.to, y.from}, {x.to, y.to}, {x.from, y.to}}};
  for (const auto& [a, b, c] : kCreases) {
    std::vector<Polygon> split;
    for (const Polygon& piece : pieces)
      for (const double side : {1.0, -1.0})
        if (Polygon part = clip(piece, side * a, side * b, side * c); part.size() > 2) split.push_back(std::move(part));
    pieces = std::move(split);
  }
  for (const Polygon& piece : pieces)
    for (std::size_t i = 1; i + 1 < piece.size(); ++i) triangle_nodes(rule, piece[0], piece[i], piece[i + 1], nodes);
}

bool is_creased(Interval x, Interval y) {
  if (x.from * x.to < 0 || y.from * y.to < 0) return true;
  const auto [x0, x1] = std::minmax({std::abs(x.from), std::abs(x.to)});
  const auto [y0, y1] = std::minmax({std::abs(y.from), std::abs(y.to)});
  return x0 + y0 < 1 && x1 + y1 > 1;
}

GaussLegendre make_rule(int count, PixelQuadrature::Nodes kind) {
  if (kind == PixelQuadrature::Nodes::kGauss) return make_gauss_legendre(count);
  GaussLegendre rule;
  for (int i = 0; i < count; ++i) {
    rule.nodes.push_back((2 * i + 1.0) / count - 1);
    rule.weights.push_back(2.0 / count);
  }
  return rule;
}

}  // namespace

ImagePoint pixel_centre(Layout layout, PictureSize size, Pixel pixel) {
  return {horizontal(layout, size).centre(pixel.x), vertical(layout, size).centre(pixel.y)};
}

Pixel pixel_at(Layout layout, PictureSize size, ImagePoint point) {
  return {horizontal(layout, size).index(point.u), vertical(layout, size).index(point.v)};
}

PixelQuadrature::PixelQuadrature(Layout layout, PictureSize size, int nodes_a_side, Nodes kind)
    : layout_(layout),
      rule_(make_rule(nodes_a_side, kind)),
      edge_rule_(make_rule(nodes_a_side + 2, kind)),
      disc_edge_(disc_edge(layout, size)),
      grid_(face_grid(layout)) {
  assert(fits(layout, size));
  for (int x = 0; x < size.width; ++x) columns_.push_back(horizontal(layout, size).pixel(x));
  for (int y = 0; y < size.height; ++y) rows_.push_back(vertical(layout, size).pixel(y));
  if (cube_faces(layout).empty()) return;
  faces_.resize(static_cast<std::size_t>(grid_.columns * grid_.rows));
  for (const CubeFace& face : cube_faces(layout))
    faces_[static_cast<std::size_t>(face.row * grid_.columns + face.column)] = &face;
}

void PixelQuadrature::nodes(Pixel pixel, std::vector<WeightedDirection>& nodes) const {
  const PixelSide& column = columns_[static_cast<std::size_t>(pixel.x)];
  const PixelSide& row = rows_[static_cast<std::size_t>(pixel.y)];
  const Interval x = across(column), y = upward(row);
  nodes.clear();
  if (!faces_.empty()) {
    if (const CubeFace* face = faces_[static_cast<std::size_t>(row.face * grid_.columns + column.face)])
      face_nodes(rule_, *face, x, y, nodes);
    return;
  }
  switch (layout_) {
    case Layout::kAngularMap:
    case Layout::kMirrorBall:
      if (nearest(x, y) >= 1) return;
      if (farthest(x, y) > disc_edge_) return disc_edge_nodes(layout_, edge_rule_, x, y, nodes);
      over_rectangle(rule_, x, y,
                     [&](double right, double up, double weight) { add_disc_node(layout_, right, up, weight, nodes); });
      return;
    case Layout::kOctahedral:
      if (is_creased(x, y)) return octahedral_nodes(rule_, x, y, nodes);
      over_rectangle(rule_, x, y,
                     [&](double right, double up, double weight) { add_octahedron_node(right, up, weight, nodes); });
      return;
    default:
      lat_long_nodes(rule_, x, y, nodes);
  }
}

bool PixelQuadrature::covers(Pixel pixel) const {
  const PixelSide& column = columns_[static_cast<std::size_t>(pixel.x)];
  const PixelSide& row = rows_[static_cast<std::size_t>(pixel.y)];
  if (!faces_.empty()) return faces_[static_cast<std::size_t>(row.face * grid_.columns + column.face)] != nullptr;
  if (layout_ != Layout::kAngularMap && layout_ != Layout::kMirrorBall) return true;
  return nearest(across(column), upward(row)) < 1;
}

double PixelQuadrature::solid_angle(Pixel pixel) const {
  const Interval x = across(columns_[static_cast<std::size_t>(pixel.x)]);
  const Interval y = upward(rows_[static_cast<std::size_t>(pixel.y)]);
  if (!faces_.empty()) return covers(pixel) ? face_solid_angle(x, y) : 0;
  if (is_lat_long(layout_)) return lat_long_solid_angle(x, y);
  if (layout_ == Layout::kMirrorBall && farthest(x, y) <= 1) return 4 * x.length() * y.length();
  std::vector<WeightedDirection> all;
  nodes(pixel, all);
  double sum = 0;
  for (const WeightedDirection& node : all) sum += node.solid_angle;
  return sum;
}

double pixel_solid_angle(Layout layout, PictureSize size, Pixel pixel) {
  return PixelQuadrature(layout, size, nodes_a_side_for(layout, size, 6)).solid_angle(pixel);
}

int nodes_a_side_for(Layout layout, PictureSize size, int bands) {
  // Half the angle that a pixel covers where it covers the most, but for the very edge of a mirror ball.
  const double n = size.width / face_grid(layout).columns;
  double half = 1 / n;  // cube, at the middle of a face
  if (is_lat_long(layout)) half = std::max(pi / n, pi / (2 * size.height));
  if (layout == Layout::kAngularMap) half = pi / n;
  if (layout == Layout::kMirrorBall) half = 2 / std::sqrt(1 - std::pow(disc_edge(layout, size), 2)) / n;
  if (layout == Layout::kOctahedral) half = std::sqrt(3.0) / n;
  // A wave of `bands` radians a radian, over 2a with k Gauss nodes, is missed by (2a·bands)^2k (k!)⁴ / ((2k+1) (2k)!³)
  // of itself.
  const double reach = 2 * half * bands;
  double error = 1;
  for (int k = 1; k < 64; ++k) {
    const double pair = 2.0 * k * (2 * k - 1);
    error *= reach * reach * k * k * k * k / (pair * pair * pair);
    if (k >= 2 && error / (2 * k + 1) < 1e-8) return k;
  }
  return 64;
}

}  // namespace shlight
