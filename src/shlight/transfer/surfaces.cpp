#include "shlight/transfer/surfaces.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "shlight/scene/weld.h"

namespace shlight {
namespace {

// Triangles in pairs that have the same three corners in opposite sequence.
std::vector<std::uint32_t> find_twins(const WorldMesh& world) {
  const Weld weld = weld_positions(world.positions);
  const std::size_t triangles = world.indices.size() / 3;
  struct Key {
    std::array<std::uint32_t, 3> corners;  // ascending
    bool is_odd = false;                   // in which sequence they stood
    std::uint32_t triangle = 0;
  };
  std::vector<Key> keys(triangles);
  for (std::size_t t = 0; t < triangles; ++t) {
    Key& key = keys[t];
    key.triangle = static_cast<std::uint32_t>(t);
    for (std::size_t k = 0; k < 3; ++k) key.corners[k] = weld.group[world.indices[3 * t + k]];
    for (const auto& [a, b] : {std::pair{0, 1}, std::pair{1, 2}, std::pair{0, 1}})
      if (key.corners[a] > key.corners[b]) {
        std::swap(key.corners[a], key.corners[b]);
        key.is_odd = !key.is_odd;
      }
  }
  std::ranges::sort(keys, [](const Key& a, const Key& b) {
    return std::tie(a.corners, a.is_odd, a.triangle) < std::tie(b.corners, b.is_odd, b.triangle);
  });

  std::vector<std::uint32_t> twins(triangles, Hit::kNone);
  bool has_any = false;
  for (std::size_t begin = 0, end = 0; begin < triangles; begin = end) {
    std::size_t middle = begin;
    while (end < triangles && keys[end].corners == keys[begin].corners) middle += !keys[end++].is_odd;
    if (middle == begin || middle == end) continue;
    for (std::size_t i = begin; i < end; ++i) twins[keys[i].triangle] = keys[i < middle ? middle : begin].triangle;
    has_any = true;
  }
  return has_any ? twins : std::vector<std::uint32_t>{};
}

// Between texels as OpenGL's linear filter reads them; the picture repeats. Linear values of red, green, blue.
Vec3f sample_texture(const Image8& image, Vec2f texcoord, const std::array<float, 256>& linear) {
  if (image.width <= 0 || image.height <= 0) return {1, 1, 1};
  const auto texel = [&](long x, long y) {
    const std::size_t k =
        4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x));
    return Vec3f{linear[image.values[k]], linear[image.values[k + 1]], linear[image.values[k + 2]]};
  };
  const auto wrap = [](long i, long size) { return ((i % size) + size) % size; };
  // Whole repeats go first, so that large coordinates keep their fraction; NaN is 0.
  const auto unit = [](float v) { return std::isfinite(v) ? v - std::floor(v) : 0.0f; };
  const float x = unit(texcoord.u) * static_cast<float>(image.width) - 0.5f;
  const float y = unit(texcoord.v) * static_cast<float>(image.height) - 0.5f;
  const long x0 = static_cast<long>(std::floor(x)), y0 = static_cast<long>(std::floor(y));
  const float fx = x - static_cast<float>(x0), fy = y - static_cast<float>(y0);
  const long xs[2] = {wrap(x0, image.width), wrap(x0 + 1, image.width)};
  const long ys[2] = {wrap(y0, image.height), wrap(y0 + 1, image.height)};
  const Vec3f top = (1 - fx) * texel(xs[0], ys[0]) + fx * texel(xs[1], ys[0]);
  const Vec3f bottom = (1 - fx) * texel(xs[0], ys[1]) + fx * texel(xs[1], ys[1]);
  return (1 - fy) * top + fy * bottom;
}

Vec3f times(Vec3f a, Vec3f b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z};
}

}  // namespace

Surfaces::Surfaces(const Scene& scene, const WorldMesh& world)
    : scene_(scene), world_(world), twins_(find_twins(world)) {
  for (std::size_t k = 0; k < linear_.size(); ++k) {
    const double v = static_cast<double>(k) / 255;
    linear_[k] = static_cast<float>(v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4));
  }
}

bool Surfaces::faces(std::size_t triangle, Vec3f direction) const {
  const std::uint32_t* v = world_.indices.data() + 3 * triangle;
  const Vec3f p = world_.positions[v[0]];
  const Vec3f geometric = cross(world_.positions[v[1]] - p, world_.positions[v[2]] - p);
  // Normals say which side is the front; of an inside-out mesh, corners do not.
  const Vec3f normals = world_.normals[v[0]] + world_.normals[v[1]] + world_.normals[v[2]];
  return dot(geometric, normals) * dot(geometric, direction) < 0;
}

std::optional<SurfacePoint> Surfaces::meet(const Hit& hit, Vec3f direction) const {
  std::size_t triangle = hit.triangle;
  std::array<float, 3> weights = {1 - hit.u - hit.v, hit.u, hit.v};
  SurfacePoint point;
  if (!faces(triangle, direction)) {
    if (twins_.empty() || twins_[triangle] == Hit::kNone || !faces(twins_[triangle], direction)) return {};
    // The weights go with the corners' positions.
    const std::uint32_t* before = world_.indices.data() + 3 * triangle;
    const std::uint32_t* after = world_.indices.data() + 3 * twins_[triangle];
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t j = 0; j < 3; ++j)
        if (world_.positions[after[k]] == world_.positions[before[j]]) point.weights[k] = weights[j];
    triangle = twins_[triangle];
  } else {
    point.weights = weights;
  }
  for (std::size_t k = 0; k < 3; ++k) point.vertices[k] = world_.indices[3 * triangle + k];
  point.reflectance = reflectance(point, triangle);
  return point;
}

Vec3f Surfaces::reflectance(const SurfacePoint& point, std::size_t triangle) const {
  const std::size_t instance = world_.instance_of(triangle);
  const Mesh& mesh = scene_.meshes[scene_.instances[instance].mesh];
  const Material& material = scene_.materials[mesh.material];
  const std::size_t first = world_.first_vertex[instance];
  Vec3f color = material.base_color;
  if (!mesh.colors.empty()) {
    Vec3f c;
    for (std::size_t k = 0; k < 3; ++k) c = c + point.weights[k] * mesh.colors[point.vertices[k] - first];
    color = times(color, c);
  }
  if (material.texture && !mesh.texcoords.empty()) {
    Vec2f t;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2f corner = mesh.texcoords[point.vertices[k] - first];
      t.u += point.weights[k] * corner.u;
      t.v += point.weights[k] * corner.v;
    }
    color = times(color, sample_texture(scene_.textures[*material.texture], t, linear_));
  }
  // fmax takes the number where the other is NaN: nothing bad comes out of a bad colour.
  const auto clamp = [](float v) { return std::fmin(std::fmax(v, 0.0f), 1.0f); };
  return {clamp(color.x), clamp(color.y), clamp(color.z)};
}

}  // namespace shlight
