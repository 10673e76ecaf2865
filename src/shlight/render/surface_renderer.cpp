#include "shlight/render/surface_renderer.h"

#include <cmath>
#include <numbers>
#include <type_traits>
#include <utility>

namespace shlight {

void draw_surfaces(const SurfaceRenderer& renderer, const GpuScene& scene, const View& view,
                   const Rotation& light_to_world) {
  std::visit(
      [&]<class Renderer>(const Renderer& r) {
        if constexpr (std::is_same_v<Renderer, NormalRenderer>)
          r.draw(scene, view);
        else
          r.draw(scene, view, light_to_world);
      },
      renderer);
}

void set_radiance(SurfaceRenderer& renderer, const RgbCoefficients& radiance) {
  std::visit(
      [&]<class Renderer>(Renderer& r) {
        if constexpr (!std::is_same_v<Renderer, NormalRenderer>) r.set_radiance(radiance);
      },
      renderer);
}

void mark_negative(SurfaceRenderer& renderer, Vec3f radiance) {
  std::visit(
      [&]<class Renderer>(Renderer& r) {
        if constexpr (!std::is_same_v<Renderer, NormalRenderer>) r.mark_negative(radiance);
      },
      renderer);
}

bool needs_tangents(const SurfaceRenderer& renderer) {
  const auto* reflectance = std::get_if<ReflectanceRenderer>(&renderer);
  return reflectance && reflectance->needs_tangents();
}

RgbCoefficients visibility_light(int bands) {
  RgbCoefficients light(bands);
  const double l00 = std::sqrt(4 * std::numbers::pi);
  light[0] = {l00, l00, l00};
  return light;
}

Scene without_colors(Scene scene) {
  for (Material& material : scene.materials) material = {material.name, {1, 1, 1}, {}, {}};
  for (Mesh& mesh : scene.meshes) mesh.colors.clear();
  scene.textures.clear();
  return scene;
}

}  // namespace shlight
