#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "shlight/scene/scene.h"
#include "shlight/transfer/tracer.h"
#include "shlight/transfer/world_mesh.h"

namespace shlight {

// A point of a triangle's front, as light that bounces sees it.
struct SurfacePoint {
  std::array<std::uint32_t, 3> vertices = {};  // of the world's mesh
  std::array<float, 3> weights = {};           // add up to 1
  Vec3f reflectance;                           // in [0, 1]
};

// What rays find where they meet a scene's surfaces. Both live as long as this.
class Surfaces {
 public:
  Surfaces(const Scene& scene, const WorldMesh& world);

  // The point that a ray of this direction meets. Nothing where it meets a back, which reflects no light. Where a
  // double-sided sheet is made of pairs of triangles that face away from each other, the one that faces the ray is it,
  // whichever of the two the tracer named.
  std::optional<SurfacePoint> meet(const Hit& hit, Vec3f direction) const;

 private:
  bool faces(std::size_t triangle, Vec3f direction) const;
  Vec3f reflectance(const SurfacePoint& point, std::size_t triangle) const;

  const Scene& scene_;
  const WorldMesh& world_;
  std::vector<std::uint32_t> twins_;  // of each triangle, or Hit::kNone; empty where no triangle has one
  std::array<float, 256> linear_;     // what an sRGB-encoded byte stands for
};

}  // namespace shlight
