#include "shlight/scene/mend_mesh.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "shlight/scene/normals.h"
#include "shlight/scene/weld.h"

namespace shlight {
namespace {

bool is_finite(Vec3f v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// Exact enough to say zero only of triangles whose float positions do lie in a line or a point.
bool has_area(Vec3f a, Vec3f b, Vec3f c) {
  const Vec3d p = vec_cast<double>(a);
  return cross(vec_cast<double>(b) - p, vec_cast<double>(c) - p) != Vec3d{};
}

std::vector<std::uint32_t> drawable_triangles(const Mesh& mesh, MeshFaults& faults) {
  std::vector<std::uint32_t> kept;
  kept.reserve(mesh.indices.size());
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const Vec3f a = mesh.positions[mesh.indices[i]];
    const Vec3f b = mesh.positions[mesh.indices[i + 1]];
    const Vec3f c = mesh.positions[mesh.indices[i + 2]];
    if (!is_finite(a) || !is_finite(b) || !is_finite(c))
      ++faults.non_finite_triangles;
    else if (!has_area(a, b, c))
      ++faults.degenerate_triangles;
    else
      kept.insert(kept.end(), mesh.indices.begin() + i, mesh.indices.begin() + i + 3);
  }
  return kept;
}

// The file's normal of unit length; nothing where it is none.
std::optional<Vec3f> unit_normal(Vec3f normal) {
  if (!is_finite(normal)) return {};
  const Vec3d n = vec_cast<double>(normal);
  const double length = std::sqrt(dot(n, n));
  if (length == 0) return {};
  return vec_cast<float>((1 / length) * n);
}

// One normal for each corner: the file's where it has a good one, else a new one.
std::vector<Vec3f> corner_normals(const Mesh& mesh, std::span<const std::uint32_t> indices, float crease_degrees,
                                  MeshFaults& faults) {
  if (mesh.normals.empty()) return make_corner_normals(mesh.positions, indices, crease_degrees);
  std::vector<Vec3f> normals(indices.size());
  std::vector<std::size_t> bad;
  for (std::size_t corner = 0; corner < indices.size(); ++corner) {
    const std::optional<Vec3f> normal = unit_normal(mesh.normals[indices[corner]]);
    if (normal)
      normals[corner] = *normal;
    else
      bad.push_back(corner);
  }
  if (!bad.empty()) {
    const std::vector<Vec3f> made = make_corner_normals(mesh.positions, indices, crease_degrees);
    for (const std::size_t corner : bad) normals[corner] = made[corner];
  }
  faults.bad_normals += bad.size();
  return normals;
}

Vec2f mend_texcoord(Vec2f t, MeshFaults& faults) {
  if (std::isfinite(t.u) && std::isfinite(t.v)) return t;
  ++faults.bad_attributes;
  return {};
}

Vec3f mend_color(Vec3f c, MeshFaults& faults) {
  if (is_finite(c)) return {std::clamp(c.x, 0.0f, 1.0f), std::clamp(c.y, 0.0f, 1.0f), std::clamp(c.z, 0.0f, 1.0f)};
  ++faults.bad_attributes;
  return {1, 1, 1};
}

}  // namespace

Mesh mend_mesh(const Mesh& mesh, float crease_degrees, MeshFaults& faults) {
  const std::vector<std::uint32_t> indices = drawable_triangles(mesh, faults);
  const std::vector<Vec3f> normals = corner_normals(mesh, indices, crease_degrees, faults);

  // A row of all that a corner has: position, normal, texture coordinates, colour.
  const bool has_texcoords = !mesh.texcoords.empty(), has_colors = !mesh.colors.empty();
  const std::size_t stride = 6 + (has_texcoords ? 2 : 0) + (has_colors ? 3 : 0);
  std::vector<float> rows;
  rows.reserve(stride * indices.size());
  for (std::size_t corner = 0; corner < indices.size(); ++corner) {
    const std::uint32_t i = indices[corner];
    const Vec3f p = mesh.positions[i], n = normals[corner];
    rows.insert(rows.end(), {p.x, p.y, p.z, n.x, n.y, n.z});
    if (has_texcoords) {
      const Vec2f t = mend_texcoord(mesh.texcoords[i], faults);
      rows.insert(rows.end(), {t.u, t.v});
    }
    if (has_colors) {
      const Vec3f c = mend_color(mesh.colors[i], faults);
      rows.insert(rows.end(), {c.x, c.y, c.z});
    }
  }

  Weld weld = weld_rows(rows, stride);
  Mesh mended;
  mended.name = mesh.name;
  mended.material = mesh.material;
  for (const std::uint32_t corner : weld.first) {
    const float* row = &rows[stride * corner];
    mended.positions.push_back({row[0], row[1], row[2]});
    mended.normals.push_back({row[3], row[4], row[5]});
    if (has_texcoords) mended.texcoords.push_back({row[6], row[7]});
    const float* color = row + stride - 3;
    if (has_colors) mended.colors.push_back({color[0], color[1], color[2]});
  }
  mended.indices = std::move(weld.group);
  return mended;
}

Mesh mirror_mesh(Mesh mesh) {
  for (Vec3f& p : mesh.positions) p.x = -p.x;
  for (Vec3f& n : mesh.normals) n.x = -n.x;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
  return mesh;
}

}  // namespace shlight
