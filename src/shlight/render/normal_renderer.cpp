#include "shlight/render/normal_renderer.h"

#include "shaders.h"

namespace shlight {

NormalRenderer::NormalRenderer()
    : program_(shaders::mesh_vert, shaders::surface_frag,
               std::string(shaders::seen_normal_glsl) + std::string(shaders::normals_frag)) {}

void NormalRenderer::draw(const GpuScene& scene, const View& view) const {
  program_.use();
  program_.set("u_negative", Vec3f{});
  scene.draw(program_, view, {});
}

}  // namespace shlight
