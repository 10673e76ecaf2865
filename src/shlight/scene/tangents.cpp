#include "shlight/scene/tangents.h"

#include <cmath>
#include <cstddef>

namespace shlight {
namespace {

// The part of `v` along the surface, at unit length; nothing is left of what is shorter than `least`.
bool along_surface(Vec3d v, Vec3d normal, double least, Vec3f& tangent) {
  v = v - dot(v, normal) * normal;
  const double length = std::sqrt(dot(v, v));
  if (!(length > least)) return false;
  tangent = vec_cast<float>((1 / length) * v);
  return true;
}

}  // namespace

std::vector<Vec3f> make_tangents(const Mesh& mesh) {
  std::vector<Vec3d> along_u(mesh.positions.size());
  for (std::size_t i = 0; i + 2 < mesh.indices.size() && !mesh.texcoords.empty(); i += 3) {
    const std::uint32_t corners[3] = {mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]};
    const auto edge = [&](int k) {
      return vec_cast<double>(mesh.positions[corners[k]]) - vec_cast<double>(mesh.positions[corners[0]]);
    };
    const auto du = [&](int k) { return double(mesh.texcoords[corners[k]].u) - mesh.texcoords[corners[0]].u; };
    const auto dv = [&](int k) { return double(mesh.texcoords[corners[k]].v) - mesh.texcoords[corners[0]].v; };
    // dP/du = (dv2 e1 - dv1 e2) / det, at unit length times the triangle's area.
    const double det = du(1) * dv(2) - du(2) * dv(1);
    const Vec3d t = (det < 0 ? -1.0 : 1.0) * (dv(2) * edge(1) - dv(1) * edge(2)), across = cross(edge(1), edge(2));
    const double length = std::sqrt(dot(t, t));
    if (!(length > 0) || det == 0) continue;
    const Vec3d share = (std::sqrt(dot(across, across)) / length) * t;
    for (const std::uint32_t corner : corners) along_u[corner] = along_u[corner] + share;
  }

  // Unit normals of floats: shorter than this, a horizontal direction is rounding.
  constexpr double kVertical = 1e-6;
  std::vector<Vec3f> tangents(mesh.positions.size());
  for (std::size_t v = 0; v < tangents.size(); ++v) {
    const Vec3d n = vec_cast<double>(mesh.normals[v]), u = along_u[v];
    // Texture coordinates that cancel each other around a vertex have no direction.
    if (dot(u, u) > 0 && along_surface((1 / std::sqrt(dot(u, u))) * u, n, 1e-3, tangents[v])) continue;
    if (along_surface(cross(Vec3d{0, 1, 0}, n), n, kVertical, tangents[v])) continue;
    along_surface({1, 0, 0}, n, 0, tangents[v]);
  }
  return tangents;
}

}  // namespace shlight
