#include "shlight/scene/balloon.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "shlight/scene/normals.h"
#include "shlight/scene/shapes.h"
#include "shlight/sh/basis.h"

namespace shlight {
namespace {

constexpr Vec3f kNegative = {0.7f, 0.03f, 0.5f};

// Its hue, as bright as a colour can be.
Vec3f hue_of(Rgb c) {
  const Rgb positive = {std::max(c.r, 0.0), std::max(c.g, 0.0), std::max(c.b, 0.0)};
  const double largest = std::max({positive.r, positive.g, positive.b, 1e-30});
  const Rgb hue = 1 / largest * positive;
  return {static_cast<float>(hue.r), static_cast<float>(hue.g), static_cast<float>(hue.b)};
}

}  // namespace

Scene make_balloon(const RgbCoefficients& radiance, int rings) {
  Mesh mesh = make_sphere(1, rings);
  std::vector<double> basis(radiance.size()), distance;
  double largest = 0;
  for (const Vec3f& position : mesh.positions) {
    eval_basis<double>(radiance.bands(), vec_cast<double>(position), basis);
    Rgb sum;
    for (std::size_t i = 0; i < basis.size(); ++i) sum += basis[i] * radiance[i];
    distance.push_back(std::abs(luminance(sum)));
    largest = std::max(largest, distance.back());
    mesh.colors.push_back(luminance(sum) < 0 ? kNegative : hue_of(sum));
  }
  constexpr float kLeast = 0.01f;  // of the radius: so that no triangle is without area
  for (std::size_t i = 0; i < distance.size(); ++i) {
    const float r = largest > 0 ? static_cast<float>(distance[i] / largest) : 0;
    mesh.positions[i] = std::max(r, kLeast) * mesh.positions[i];
  }
  // Each vertex has one position, and so one normal: that of any of its corners.
  const std::vector<Vec3f> normals = make_corner_normals(mesh.positions, mesh.indices, 180);
  for (std::size_t corner = 0; corner < mesh.indices.size(); ++corner)
    mesh.normals[mesh.indices[corner]] = normals[corner];
  Scene scene;
  scene.meshes.push_back(std::move(mesh));
  scene.instances.push_back({});
  scene.materials.push_back({"balloon", {1, 1, 1}, {}, {}});
  return scene;
}

}  // namespace shlight
