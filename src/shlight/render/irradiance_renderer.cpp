#include "shlight/render/irradiance_renderer.h"

#include <string>

#include "shaders.h"
#include "shlight/render/sh_glsl.h"

namespace shlight {

IrradianceRenderer::IrradianceRenderer(const RgbCoefficients& radiance)
    : program_(shaders::mesh_vert, shaders::surface_frag,
               std::string(shaders::seen_normal_glsl) + std::string(shaders::irradiance_frag) +
                   make_irradiance_glsl(radiance.bands())) {
  set_radiance(radiance);
}

void IrradianceRenderer::set_radiance(const RgbCoefficients& radiance) {
  program_.use();
  set_irradiance_uniforms(program_, radiance);
}

void IrradianceRenderer::mark_negative(Vec3f radiance) {
  program_.use();
  program_.set("u_negative", radiance);
}

void IrradianceRenderer::draw(const GpuScene& scene, const View& view, const Rotation& light_to_world) const {
  scene.draw(program_, view, light_to_world);
}

}  // namespace shlight
