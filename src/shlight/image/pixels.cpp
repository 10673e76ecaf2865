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

struct Interval {
  double from = 0, to = 0;
};

class Side {
 public:
  Side(int length, int faces, bool on_border) : faces_(faces), pixels_(length / faces), on_border_(on_border) {}

  // In [0, 1], as are all of these.
  Interval interval(int pixel) const {
    const int face = pixel / pixels_, i = pixel % pixels_;
    if (!on_border_ || pixels_ == 1)
      return {(face + i / double(pixels_)) / faces_, (face + (i + 1) / double(pixels_)) / faces_};
    const double last = pixels_ - 1;
    return {(face + std::max(0.0, (i - 0.5) / last)) / faces_, (face + std::min(1.0, (i + 0.5) / last)) / faces_};
  }
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

struct Rectangle {
  Interval u, v;
};

Rectangle rectangle_of(Layout layout, PictureSize size, Pixel pixel) {
  assert(pixel.x >= 0 && pixel.x < size.width && pixel.y >= 0 && pixel.y < size.height);
  return {horizontal(layout, size).interval(pixel.x), vertical(layout, size).interval(pixel.y)};
}

double length(Interval i) {
  return i.to - i.from;
}
double at(Interval i, double node) {
  return i.from + length(i) * 0.5 * (1 + node);
}

// Calls f(x, y, weight) at the nodes of the product rule.
template <class F>
void over_rectangle(const GaussLegendre& rule, Interval x, Interval y, F&& f) {
  const double area = 0.25 * length(x) * length(y);
  for (std::size_t i = 0; i < rule.nodes.size(); ++i)
    for (std::size_t j = 0; j < rule.nodes.size(); ++j)
      f(at(x, rule.nodes[j]), at(y, rule.nodes[i]), area * rule.weights[i] * rule.weights[j]);
}

using Nodes = std::vector<WeightedDirection>;

// --- lat-long: a rectangle in both angles, of density sin θ

void lat_long_nodes(Layout layout, const GaussLegendre& rule, const Rectangle& pixel, Nodes& nodes) {
  const double area = 0.25 * 2 * pi * length(pixel.u) * pi * length(pixel.v);
  for (std::size_t j = 0; j < rule.nodes.size(); ++j) {
    const Vec3d horizon = *direction_at(layout, {at(pixel.u, rule.nodes[j]), 0.5});
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
      const double theta = pi * at(pixel.v, rule.nodes[i]), s = std::sin(theta);
      nodes.push_back({{s * horizon.x, std::cos(theta), s * horizon.z}, area * rule.weights[i] * rule.weights[j] * s});
    }
  }
}

double lat_long_solid_angle(const Rectangle& pixel) {
  // cos θ0 − cos θ1 as a product, which keeps its digits at the poles.
  const double middle = 0.5 * pi * (pixel.v.from + pixel.v.to), half = 0.5 * pi * length(pixel.v);
  return 2 * pi * length(pixel.u) * 2 * std::sin(middle) * std::sin(half);
}

// --- cubes: (s, t) in [−1, 1]² on a face at distance 1 has dω = ds dt / (1+s²+t²)^(3/2)

struct FaceRectangle {
  const CubeFace* face = nullptr;
  Interval s, t;
};

FaceRectangle on_face(Layout layout, PictureSize size, Pixel pixel) {
  const auto [columns, rows] = face_grid(layout);
  const int column = pixel.x / (size.width / columns), row = pixel.y / (size.height / rows);
  for (const CubeFace& face : cube_faces(layout))
    if (face.column == column && face.row == row) {
      const auto [u, v] = rectangle_of(layout, size, pixel);
      return {&face,
              {2 * (u.from * columns - column) - 1, 2 * (u.to * columns - column) - 1},
              {2 * (v.from * rows - row) - 1, 2 * (v.to * rows - row) - 1}};
    }
  return {};
}

void face_nodes(const GaussLegendre& rule, const FaceRectangle& pixel, Nodes& nodes) {
  over_rectangle(rule, pixel.s, pixel.t, [&](double s, double t, double weight) {
    const double scale = 1 / std::sqrt(1 + s * s + t * t);
    nodes.push_back(
        {scale * (pixel.face->forward + s * pixel.face->right + t * pixel.face->down), weight * scale * scale * scale});
  });
}

double face_solid_angle(const FaceRectangle& pixel) {
  // Of the rectangle from (0, 0) to (s, t).
  const auto corner = [](double s, double t) { return std::atan2(s * t, std::sqrt(1 + s * s + t * t)); };
  const auto [s, t] = std::pair(pixel.s, pixel.t);
  return corner(s.to, t.to) - corner(s.from, t.to) - corner(s.to, t.from) + corner(s.from, t.from);
}

// --- discs: x, y in [−1, 1], x right, y up

// Of a radius r, dω = density · dx dy: angular map π sin(πr)/r, mirror ball 4.
double disc_density(Layout layout, double r) {
  if (layout == Layout::kMirrorBall) return 4;
  return r < 1e-8 ? pi * pi : pi * std::sin(pi * r) / r;
}

void add_disc_node(Layout layout, double x, double y, double weight, Nodes& nodes) {
  if (const auto direction = direction_at(layout, {0.5 + 0.5 * x, 0.5 - 0.5 * y}))
    nodes.push_back({*direction, weight * disc_density(layout, std::hypot(x, y))});
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
      const double p = at(psi, rule.nodes[i]), reach = std::cos(p);
      const Interval phi = {std::asin(std::clamp(x.from / reach, -1.0, 1.0)),
                            std::asin(std::clamp(x.to / reach, -1.0, 1.0))};
      for (std::size_t j = 0; j < rule.nodes.size(); ++j) {
        const double q = at(phi, rule.nodes[j]);
        const double weight = 0.25 * rule.weights[i] * rule.weights[j] * length(psi) * length(phi);
        if (weight > 0)
          add_disc_node(layout, reach * std::sin(q), std::sin(p), weight * reach * reach * std::cos(q), nodes);
      }
    }
  }
}

struct DiscRectangle {
  Interval x, y;
  double nearest = 0, farthest = 0;  // from the centre
};

DiscRectangle on_disc(const Rectangle& pixel) {
  const Interval x = {2 * pixel.u.from - 1, 2 * pixel.u.to - 1}, y = {1 - 2 * pixel.v.to, 1 - 2 * pixel.v.from};
  const auto near = [](Interval i) { return i.from * i.to < 0 ? 0 : std::min(std::abs(i.from), std::abs(i.to)); };
  const auto far = [](Interval i) { return std::max(std::abs(i.from), std::abs(i.to)); };
  return {x, y, std::hypot(near(x), near(y)), std::hypot(far(x), far(y))};
}

// Where the square roots at the circle are no longer harmless to a plain rule.
constexpr double kDiscEdge = 0.8;

// --- octahedral: X, Y in [−1, 1], Y up. A face of the octahedron is flat, so that dω = dX dY / |p|³ for its point p.

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

void octahedral_nodes(const GaussLegendre& rule, const Rectangle& pixel, Nodes& nodes) {
  const Interval x = {2 * pixel.u.from - 1, 2 * pixel.u.to - 1}, y = {1 - 2 * pixel.v.to, 1 - 2 * pixel.v.from};
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

bool is_creased(const Rectangle& pixel) {
  const Interval x = {2 * pixel.u.from - 1, 2 * pixel.u.to - 1}, y = {2 * pixel.v.from - 1, 2 * pixel.v.to - 1};
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
      size_(size),
      rule_(make_rule(nodes_a_side, kind)),
      edge_rule_(make_rule(nodes_a_side + 2, kind)) {
  assert(fits(layout, size));
}

void PixelQuadrature::nodes(Pixel pixel, std::vector<WeightedDirection>& nodes) const {
  nodes.clear();
  if (!cube_faces(layout_).empty()) {
    if (const FaceRectangle part = on_face(layout_, size_, pixel); part.face) face_nodes(rule_, part, nodes);
    return;
  }
  const Rectangle part = rectangle_of(layout_, size_, pixel);
  switch (layout_) {
    case Layout::kAngularMap:
    case Layout::kMirrorBall: {
      const DiscRectangle disc = on_disc(part);
      if (disc.nearest >= 1) return;
      if (disc.farthest > kDiscEdge) return disc_edge_nodes(layout_, edge_rule_, disc.x, disc.y, nodes);
      over_rectangle(rule_, disc.x, disc.y,
                     [&](double x, double y, double weight) { add_disc_node(layout_, x, y, weight, nodes); });
      return;
    }
    case Layout::kOctahedral:
      if (is_creased(part)) return octahedral_nodes(rule_, part, nodes);
      over_rectangle(rule_, part.u, part.v, [&](double u, double v, double weight) {
        add_octahedron_node(2 * u - 1, 1 - 2 * v, 4 * weight, nodes);
      });
      return;
    default:
      lat_long_nodes(layout_, rule_, part, nodes);
  }
}

int nodes_a_side_for(Layout layout, PictureSize size, int bands) {
  // Half the angle that a pixel covers where it covers the most, but for the very edge of a mirror ball.
  const double n = size.width / face_grid(layout).columns;
  double half = 1 / n;  // cube, at the middle of a face
  if (is_lat_long(layout)) half = std::max(pi / n, pi / (2 * size.height));
  if (layout == Layout::kAngularMap) half = pi / n;
  if (layout == Layout::kMirrorBall) half = 2 / std::sqrt(1 - kDiscEdge * kDiscEdge) / n;
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

bool PixelQuadrature::covers(Pixel pixel) const {
  if (!cube_faces(layout_).empty()) return on_face(layout_, size_, pixel).face != nullptr;
  if (layout_ != Layout::kAngularMap && layout_ != Layout::kMirrorBall) return true;
  return on_disc(rectangle_of(layout_, size_, pixel)).nearest < 1;
}

double PixelQuadrature::solid_angle(Pixel pixel) const {
  if (!cube_faces(layout_).empty()) {
    const FaceRectangle part = on_face(layout_, size_, pixel);
    return part.face ? face_solid_angle(part) : 0;
  }
  const Rectangle part = rectangle_of(layout_, size_, pixel);
  if (is_lat_long(layout_)) return lat_long_solid_angle(part);
  if (layout_ == Layout::kMirrorBall && on_disc(part).farthest <= 1) return 16 * length(part.u) * length(part.v);
  std::vector<WeightedDirection> all;
  nodes(pixel, all);
  double sum = 0;
  for (const WeightedDirection& node : all) sum += node.solid_angle;
  return sum;
}

double pixel_solid_angle(Layout layout, PictureSize size, Pixel pixel) {
  return PixelQuadrature(layout, size, nodes_a_side_for(layout, size, 6)).solid_angle(pixel);
}

}  // namespace shlight
